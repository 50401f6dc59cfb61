// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/brdf_table.h"
#include "abrdf/tabulated_warp.h"

#include <optional>
#include <vector>

namespace abrdf {

/// The square's coordinates of an angle from the normal and of an azimuth of -pi .. pi, and back.
double rglFromTheta(Radians theta);
double rglFromPhi(Radians phi);
Radians thetaFromRgl(double x);
Radians phiFromRgl(double y);

/// A material of EPFL's Realistic Graphics Lab, measured where its micronormals say [Dupuy and
/// Jakob 2018, "An adaptive parameterization for efficient material acquisition and rendering"].
struct RglData {
    std::vector<float> phiIn;    ///< Ascending radians, -pi .. pi; one or two: isotropic.
    std::vector<float> thetaIn;  ///< Ascending radians, 0 .. pi/2.
    TableStack ndf;              ///< One table: density of micronormals.
    TableStack sigma;            ///< One table: projected area.
    TableStack vndf;             ///< A table for each (phiIn, thetaIn): visible micronormals.
    TableStack rgb;              ///< Three tables for each: the measurement, warped by vndf.
    bool jacobian = true;        ///< False: rgb holds f cos already.
};

class RglTable : public BrdfTable {
  public:
    explicit RglTable(RglData data);

    Rgb evaluate(const LightAndView& pair) const override;
    std::vector<Radians> viewElevations() const override {
        return {data_.thetaIn.begin(), data_.thetaIn.end()};
    }

  private:
    /// Where an incident direction lies between the measured ones.
    TableBlend blendOf(double phiIn, double thetaIn) const;

    RglData data_;
    TabulatedWarp warp_;
    bool isotropic_;
    int reduction_ = 1;  ///< phiIn covers 2 pi / reduction: 2 and 4 are symmetries of the sample.
};

}  // namespace abrdf
