// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace abrdf {

/// A place of the unit square as the point of the unit disk that Shirley and Chiu's map of equal
/// areas gives it [1997, "A low distortion map between disk and square"], in the orientation of
/// Radiance: a = 1 lies at azimuth 0, b = 1 at 90 degrees.
struct DiskPlace {
    double x = 0;
    double y = 0;
};
DiskPlace diskFromSquare(double a, double b);

/// Values of 2^(rank levels) cells of the unit cube, the last coordinate fastest, as a tree whose
/// cells are merged into their mean where they are nearly the same.
struct TensorTree {
    std::string text;        ///< "{ ... }", as Radiance reads it.
    std::size_t leaves = 0;  ///< Of the live cells.
    double bound = 0;        ///< No live cell is off by more than this, times the mean of its leaf
                             ///< plus `floor`.
};

struct TreeOptions {
    int rank = 3;          ///< 3 or 4.
    int levels = 5;        ///< 1 ..
    double cull = 0.9;     ///< Share of the live leaves that goes, 0 .. 1; equal ones always do.
    double floor = 0;      ///< Differences are meant relative to the mean plus this; >= 0.
    std::size_t live = 0;  ///< Cells that programs look up, the first ones: all or half of them.
};

/// cells: not negative. weights: of each cell in a mean, none: even.
TensorTree tensorTree(const std::vector<float>& cells, const std::vector<float>& weights,
                      const TreeOptions& options);

}  // namespace abrdf
