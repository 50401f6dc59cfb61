// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <array>
#include <cstddef>
#include <vector>

namespace abrdf {

/// Directions of a list and their weights, which sum to 1.
struct DirectionWeights {
    struct Term {
        std::size_t index = 0;
        double weight = 0;
    };
    std::vector<Term> terms;
    bool extrapolated = false;  ///< The target lies past the last ring: the ring's value is held.

    void add(std::size_t index, double weight);
};

/// The one or two directions of a ring around an azimuth.
struct RingWeights {
    std::array<DirectionWeights::Term, 2> terms{};
    std::size_t count = 0;
};

/// Two neighbouring rings and the share of the upper one, 0 .. 1. Equal where one ring says all.
struct RingCell {
    std::size_t below = 0;
    std::size_t above = 0;
    double share = 0;
    bool extrapolated = false;
};

/// Interpolation among directions that lie on rings of equal theta, as goniometers and domes
/// measure them. Exact at the directions, periodic, reproduces constants, continuous at the pole:
/// where a list has no direction there, the mean of its first ring stands for it.
/// Lists that form no rings are interpolated from their nearest eight directions [Franke and
/// Nielson 1980: inverse distances that end where the next neighbour comes in].
class AngularInterpolation {
  public:
    explicit AngularInterpolation(std::vector<Direction> directions);

    /// Linear in theta between two rings, linear in phi along each: no weight is negative.
    DirectionWeights weights(Direction target) const;

    /// Cubic in both, through the pole: low spherical harmonics come out right, and no spike does.
    /// Weights can be negative. As weights() where there are no rings.
    DirectionWeights smoothWeights(Direction target) const;

    const std::vector<Direction>& directions() const { return directions_; }

    bool hasRings() const { return !rings_.empty(); }
    std::size_t ringSize(std::size_t ring) const { return rings_[ring].indices.size(); }

    /// The rings' thetas, ascending.
    std::vector<Radians> ringThetas() const;

    /// True where `theta` lies below the first ring, and that is not at the pole.
    bool isNearerPole(Radians theta) const;

    /// The rings around `theta`, which must not lie nearer the pole than the first one.
    RingCell cellOf(Radians theta) const;

    /// Linear in phi along one ring.
    RingWeights onRing(std::size_t ring, Radians phi) const;

  private:
    struct Ring {
        Radians theta = 0;
        std::vector<std::size_t> indices;  ///< Sorted by azimuth.
        std::vector<Radians> azimuths;     ///< Of `indices`, 0 .. 2 pi.
        bool isEven = true;                ///< The azimuths are evenly spaced.
    };

    /// Where an azimuth falls on a ring: the last direction at or before it, and the way on.
    struct AzimuthPlace {
        std::size_t before = 0;  ///< Index into Ring::indices.
        Radians gap = 0;         ///< To the next direction.
        Radians past = 0;        ///< Of the gap.
    };

    static AzimuthPlace placeOn(const Ring& ring, Radians phi);
    static RingWeights linearOn(const Ring& ring, Radians phi);
    static void addLinear(const Ring& ring, Radians phi, double weight, DirectionWeights& result);
    static void addCubic(const Ring& ring, Radians phi, double weight, DirectionWeights& result);
    DirectionWeights nearestEight(Direction target) const;

    std::vector<Direction> directions_;
    std::vector<Ring> rings_;  ///< Sorted by theta; empty where the list forms none.
};

}  // namespace abrdf
