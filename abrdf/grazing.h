// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/angular_grid.h"
#include "abrdf/cosine.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What stands at elevations past the last measured one.
enum class Grazing {
    kHold,         ///< The last elevation's BRDF: the values go as cos(theta_i), where that is in.
    kFade,         ///< The same, going smoothly to 0 at the horizon, for light and view each.
    kExtrapolate,  ///< The BRDF goes on as it went over the last 15 degrees; never below 0.
};

/// "hold", "fade" or "extrapolate"; the inverse throws std::invalid_argument for other names.
std::string nameOf(Grazing grazing);
Grazing grazingFromName(const std::string& name);

/// A direction within the measured elevations, and its share in one past them.
struct GrazingTerm {
    Direction direction;
    double weight = 0;
};

/// What a direction past `maxTheta` is made of: one or two terms; itself alone where it is not
/// past. hasCosine: for lights, where cos(theta_i) is in the values.
std::vector<GrazingTerm> grazingTerms(Direction direction, Radians maxTheta, Grazing policy,
                                      bool hasCosine);

/// From an atlas's grid to the measured elevations and back: methods reconstruct inner(), which has
/// no elevation past the measured ones, and apply() makes the rest of it.
class GrazingMap {
  public:
    GrazingMap() = default;

    /// cosine: whether cos(theta_i) is in the values.
    GrazingMap(const AngularGrid& outer, Radians maxMeasuredTheta, Grazing policy, Cosine cosine);

    const AngularGrid& inner() const { return inner_; }

    /// True where nothing of the outer grid lies past the measured elevations.
    bool isIdentity() const { return extrapolatedPairs_ == 0; }

    /// Pairs of the outer grid with light or view past the measured elevations.
    std::uint64_t extrapolatedPairs() const { return extrapolatedPairs_; }

    /// How much each pair of the inner grid matters where those of the outer one do so by
    /// `weights`: the adjoint of apply(), where no share is negative.
    std::vector<double> innerWeights(std::span<const double> weights) const;

    /// All pairs of the outer grid for each texel, from all pairs of the inner one.
    AbrdfTile apply(const AbrdfTile& inner) const;

    /// The same of one texel, where something does lie past them.
    void apply(std::span<const Rgb> inner, std::span<Rgb> outer) const;

  private:
    struct Term {
        std::size_t index;
        float weight;
    };
    /// What a direction of the outer grid is made of: one or two of the inner grid's.
    using Terms = std::vector<Term>;

    static std::vector<Terms> split(const std::vector<Direction>& outer, Radians maxTheta,
                                    Grazing policy, bool hasCosine, std::vector<Direction>& inner);
    Rgb value(std::span<const Rgb> inner, const Terms& light, const Terms& view) const;

    AngularGrid inner_;
    std::vector<Terms> lights_;
    std::vector<Terms> views_;
    std::uint64_t extrapolatedPairs_ = 0;
};

}  // namespace abrdf
