// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace abrdf {

/// A Radiance BSDF file, read and looked up as the description of the format says: a small reader
/// of its own that shares nothing with the writer.
class TensorTreeFile {
  public:
    explicit TensorTreeFile(const std::filesystem::path& file);

    int rank() const { return rank_; }

    /// BRDF as CIE XYZ (white of equal energy), for the light and the view above the surface.
    std::array<double, 3> evaluate(const LightAndView& pair) const;

    /// Numbers in the tree of Y.
    std::size_t numbers() const { return numbers_; }

  private:
    struct Node {
        std::vector<Node> branches;
        std::vector<double> grid;
    };
    Node parsed(const std::string& text, std::size_t& at);
    double look(const Node& node, std::vector<double> place) const;

    int rank_ = 0;
    std::size_t numbers_ = 0;
    std::array<Node, 3> trees_;
};

}  // namespace abrdf
