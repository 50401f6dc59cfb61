// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/brdf_table.h"
#include "abrdf/half_angles.h"

#include <array>
#include <cstddef>
#include <vector>

namespace abrdf {

/// The table of the MERL database [Matusik et al. 2003]: 90 theta_h, square-root spaced, by 90
/// theta_d by 180 phi_d (0 .. pi: reciprocity gives the rest). Entry (h, d, p) stands for the cell
/// whose corner is theta_h = (pi/2) (h / 90)^2, theta_d = (pi/2) d / 90, phi_d = pi p / 180: the
/// database's own reader takes the whole part of each, so a value belongs to the cell's middle.
namespace merl {

constexpr std::size_t kThetaHalf = 90;
constexpr std::size_t kThetaDifference = 90;
constexpr std::size_t kPhiDifference = 180;
constexpr std::size_t kEntries = kThetaHalf * kThetaDifference * kPhiDifference;

/// A stored number times this is the BRDF: red, green, blue.
constexpr std::array<double, 3> kScales = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

constexpr std::size_t entry(std::size_t half, std::size_t difference, std::size_t phi) {
    return phi + kPhiDifference * (difference + kThetaDifference * half);
}

/// The middle of a cell, in the table's own spacing. Where theta_h + theta_d passes 90 degrees a
/// direction may lie below the horizon.
HalfAngles anglesOfEntry(std::size_t entry);

}  // namespace merl

/// Evaluates such a table, linearly between the cells' middles, cells without data left out.
class MerlTable : public BrdfTable {
  public:
    /// brdf: kEntries values, NaN where there is no data.
    explicit MerlTable(std::vector<Rgb> brdf) : brdf_(std::move(brdf)) {}

    Rgb evaluate(const LightAndView& pair) const override;

  private:
    std::vector<Rgb> brdf_;
};

}  // namespace abrdf
