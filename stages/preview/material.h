// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_interpolation.h"
#include "abrdf/atlas.h"
#include "abrdf/lobe_profile.h"
#include "abrdf/zeroed_vector.h"

#include <span>

namespace abrdf {

/// An atlas put in the order of shading: for each texel and view all lights beside one another.
/// Values that are not finite are 0.
class Material {
  public:
    explicit Material(const Atlas& atlas);

    int texelsWide() const { return texelsWide_; }
    int texelsHigh() const { return texelsHigh_; }
    std::size_t lightCount() const { return lightCount_; }

    /// The views and the lights among which a direction lies.
    DirectionWeights views(Direction view) const { return views_.weights(view); }
    DirectionWeights lights(Direction light) const { return lights_.weights(light); }

    /// What a value found by lights() is to be multiplied by: past the last elevation it falls
    /// with the cosine, to 0 at the horizon; where the values lack the cosine, it is in here.
    double lightFactor(Radians thetaOfLight) const;

    /// The profile of the material's highlight, and 1 / profile at each light for a view: under a
    /// single light values are interpolated as ratios to it.
    const LobeProfile& lobe() const { return lobe_; }
    std::span<const float> inverseLobe(std::size_t view) const;

    /// One value a light.
    std::span<const Rgb> row(int texelX, int texelY, std::size_t view) const;

  private:
    AngularInterpolation lights_;
    AngularInterpolation views_;
    int texelsWide_;
    int texelsHigh_;
    std::size_t lightCount_;
    std::size_t viewCount_;
    Radians lastTheta_;
    bool cosineIsInside_;
    LobeProfile lobe_;
    std::vector<float> inverseLobes_;  ///< [view][light]
    ZeroedVector<Rgb> values_;
};

}  // namespace abrdf
