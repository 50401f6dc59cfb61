// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace abrdf {

/// A tensor file as a renderer looks at it: a slow evaluator of its own, written after the
/// published description and sharing nothing with the reader. For viewers at a node of the file.
class RglSamples {
  public:
    explicit RglSamples(const std::filesystem::path& file);

    struct Field {
        std::vector<std::size_t> sizes;
        std::vector<float> values;
        std::string bytes;
    };
    const std::map<std::string, Field>& fields() const { return fields_; }

    /// What a renderer meets at a viewer at node (phi, theta), by midpoints of side x side places
    /// of the micronormal.
    struct Integral {
        double density = 0;  ///< Of the directions that it draws, over all of them: 1.
        double energy = 0;   ///< f cos(theta_o) in the second channel over the hemisphere.
        double weight = 0;   ///< Mean square of f cos(theta_o) / density over that of its mean.
    };
    Integral integral(std::size_t phi, std::size_t theta, std::size_t side) const;

  private:
    std::map<std::string, Field> fields_;
};

}  // namespace abrdf
