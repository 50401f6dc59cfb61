// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"

#include <array>
#include <cstddef>
#include <vector>

namespace abrdf {

/// At most four directions of a list and their weights, which sum to 1.
struct DirectionWeights {
    struct Term {
        std::size_t index = 0;
        double weight = 0;
    };
    std::array<Term, 4> terms{};
    std::size_t count = 0;
    bool extrapolated = false;  ///< The target lies past the last ring: the ring's value is held.

    void add(std::size_t index, double weight);
};

/// Interpolation among directions that lie on rings of equal theta, as goniometers and domes
/// measure them: linear in theta between two rings, linear and periodic in phi along each.
/// Exact at the directions, reproduces constants, continuous at the pole.
/// Lists that form no rings are interpolated by inverse squared angle from the nearest four.
class AngularInterpolation {
  public:
    explicit AngularInterpolation(std::vector<Direction> directions);

    DirectionWeights weights(Direction target) const;

  private:
    struct Ring {
        Radians theta = 0;
        std::vector<std::size_t> indices;  ///< Sorted by azimuth.
        std::vector<Radians> phis;         ///< Their azimuths, 0 .. 2 pi.
    };

    void addRing(const Ring& ring, Radians phi, double weight, DirectionWeights& result) const;
    DirectionWeights nearestFour(Direction target) const;

    std::vector<Direction> directions_;
    std::vector<Ring> rings_;  ///< Sorted by theta; empty where the list forms none.
};

/// One measured pair and its share in a value.
struct WeightedPair {
    std::size_t pair = 0;
    float weight = 0;
};

/// The measured pairs that interpolate `target`, and their weights (their sum is 1).
std::vector<WeightedPair> pairWeights(const AngularGrid& grid, const AngularInterpolation& lights,
                                      const AngularInterpolation& views,
                                      const LightAndView& target);

}  // namespace abrdf
