// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/angular_interpolation.h"
#include "color/rgb.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// One measured pair and its share in a value.
struct WeightedPair {
    std::size_t pair = 0;
    float weight = 0;
};

/// The one way between angular grids: values at the pairs of a grid, wanted at any pair. Exact at
/// the grid's pairs, periodic in azimuth, continuous at the pole, reproduces constants; past the
/// last elevation its value is held.
///
/// Two estimates. The linear one turns both directions together: a highlight depends on the
/// difference of the azimuths, and two lights half a step beside the wanted one, each with its view
/// turned by as much, both see it where it is. So too in theta: the cells of (theta_i, theta_v) are
/// cut along theta_i = theta_v. The smooth one is cubic in each direction alone. Where the two
/// agree the smooth one is the better by far, where they do not there is a highlight, and the
/// linear one is (figures in tests/bench/README.md).
class PairInterpolation {
  public:
    explicit PairInterpolation(const AngularGrid& grid);

    /// The linear estimate alone: at most 16 pairs of a grid of rings,
    /// with weights above 0 whose sum is 1.
    std::vector<WeightedPair> weights(const LightAndView& target) const;

    /// A direction as seen from one of the grid's lists; made once, used for many pairs.
    struct Place {
        Direction direction;
        DirectionWeights linear;
        DirectionWeights smooth;
    };
    Place lightPlace(Direction light) const { return placeIn(lights_, light); }
    Place viewPlace(Direction view) const { return placeIn(views_, view); }

    /// values: one a pair of the grid.
    Rgb value(const Place& light, const Place& view, std::span<const Rgb> values) const;
    Rgb value(const LightAndView& target, std::span<const Rgb> values) const {
        return value(lightPlace(target.light), viewPlace(target.view), values);
    }

    /// The pairs whose values value() looks at for any pair of another grid, ascending.
    std::vector<std::size_t> pairsFor(const AngularGrid& targets) const;

    /// True past the last elevation of either list.
    static bool isExtrapolated(const Place& light, const Place& view) {
        return light.linear.extrapolated || view.linear.extrapolated;
    }

  private:
    static bool isNode(const Place& light, const Place& view) {
        return light.linear.terms.size() == 1 && view.linear.terms.size() == 1 &&
               !isExtrapolated(light, view);
    }
    static Place placeIn(const AngularInterpolation& list, Direction direction);

    /// Calls add(pair, weight) for each term of the linear estimate.
    template <typename Add>
    void forEachLinearTerm(const Place& light, const Place& view, const Add& add) const;
    template <typename Add>
    void addTurned(std::size_t lightRing, std::size_t viewRing, const LightAndView& target,
                   double weight, const Add& add) const;

    std::size_t viewCount_ = 0;
    AngularInterpolation lights_;
    AngularInterpolation views_;
    bool sameRings_ = false;  ///< Lights and views lie at the same elevations.
};

}  // namespace abrdf
