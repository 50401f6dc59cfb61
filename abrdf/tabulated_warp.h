// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace abrdf {

/// A place in the unit square.
struct SquarePlace {
    double x = 0;
    double y = 0;
};

/// Tables of a stack, and their shares: the blend that stands for parameters between theirs.
struct TableBlend {
    std::array<std::size_t, 4> tables{};
    std::array<double, 4> weights{};  ///< Sum 1.
};

/// Tables of width x height nodes over the unit square, row by row, table after table; bilinear
/// between the nodes.
class TableStack {
  public:
    /// width, height >= 2; values: a multiple of width * height.
    TableStack(std::size_t width, std::size_t height, std::vector<float> values)
        : width_(width), height_(height), values_(std::move(values)) {}

    std::size_t count() const { return values_.size() / (width_ * height_); }
    double at(SquarePlace place, const TableBlend& blend) const;
    const std::vector<float>& values() const { return values_; }

  private:
    friend class TabulatedWarp;
    std::size_t width_;
    std::size_t height_;
    std::vector<float> values_;
};

/// The area-preserving map between the unit square and a tabulated density, as RGL's measurements
/// use it [Dupuy and Jakob 2018]: columns by their conditional, rows by their marginal integral.
class TabulatedWarp {
  public:
    /// density: not negative; each table is scaled to integral 1.
    explicit TabulatedWarp(TableStack density);

    /// The place whose image under the warp is `place`.
    SquarePlace invert(SquarePlace place, const TableBlend& blend) const;

    /// The inverse: the image of `place`, in one table.
    SquarePlace warp(SquarePlace place, std::size_t table) const;

    /// The density at a place, of integral 1 over the square.
    double density(SquarePlace place, const TableBlend& blend) const;

  private:
    double nodeDensity(std::size_t x, std::size_t y, std::size_t table) const;

    TableStack density_;
    std::vector<float> conditional_;  ///< Integral along x from 0 to each node.
    std::vector<float> marginal_;     ///< Integral along y of whole rows, from 0 to each node.
};

}  // namespace abrdf
