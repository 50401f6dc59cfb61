// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// A list of light directions and one of view directions. Their pairs are counted row by row:
/// pair = light * views().size() + view, everywhere in this program.
class AngularGrid {
  public:
    AngularGrid() = default;

    /// Throws std::invalid_argument where a theta is outside 0 .. 90 degrees (90 excluded), an
    /// angle is not finite, or a list is empty.
    AngularGrid(std::vector<Direction> lights, std::vector<Direction> views);

    /// The same directions for lights and views.
    explicit AngularGrid(const std::vector<Direction>& directions)
        : AngularGrid(directions, directions) {}

    const std::vector<Direction>& lights() const { return lights_; }
    const std::vector<Direction>& views() const { return views_; }

    std::size_t pairCount() const { return lights_.size() * views_.size(); }
    std::size_t pairIndex(std::size_t light, std::size_t view) const {
        return light * views_.size() + view;
    }
    std::size_t lightOf(std::size_t pair) const { return pair / views_.size(); }
    std::size_t viewOf(std::size_t pair) const { return pair % views_.size(); }
    LightAndView pair(std::size_t index) const {
        return {lights_[lightOf(index)], views_[viewOf(index)]};
    }

    /// The largest theta of any direction.
    Radians maxTheta() const;

    bool operator==(const AngularGrid&) const = default;

  private:
    std::vector<Direction> lights_;
    std::vector<Direction> views_;
};

/// All pairs of the grid, in their order.
std::vector<LightAndView> pairsOf(const AngularGrid& grid);

/// UBO2003 and UTIA BTF: theta 0, 15 .. 75 degrees with 1, 6, 12, 18, 20, 24 azimuths.
std::vector<Direction> ubo81Directions();

/// UBO2014's dome 1: ten elevations from 0 to 75 degrees, 151 directions.
std::vector<Direction> dome151Directions();

/// `thetas` elevations from 0 to 75 degrees by `phis` azimuths from 0, elevation by elevation.
/// A rectangular table: the pole is repeated. regularDirections(6, 48) is the UTIA BRDF grid.
std::vector<Direction> regularDirections(int thetas, int phis);

/// Finds the nearest of some directions; the first one of equals.
class NearestDirection {
  public:
    explicit NearestDirection(const std::vector<Direction>& directions);

    std::size_t indexOf(Direction target) const;

  private:
    std::vector<Imath::V3d> vectors_;
};

/// The same for one target.
std::size_t nearestDirection(const std::vector<Direction>& directions, Direction target);

/// ubo81 | dome151 | utia288 | regular:THETASxPHIS, or a CSV file of theta_deg,phi_deg rows.
/// Throws std::invalid_argument for an unknown name, std::runtime_error for a file (with the line).
AngularGrid gridFromName(const std::string& nameOrFile);

/// Rows theta_deg,phi_deg; a header line and lines that begin with # are passed over.
/// Throws std::runtime_error that names the file and the line.
std::vector<Direction> directionsFromCsv(const std::filesystem::path& file);

}  // namespace abrdf
