// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/angular_grid.h"

#include "abrdf/number_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace {

/// One elevation of a dome: `count` azimuths, evenly, from `start`; all in degrees.
struct Ring {
    double theta;
    int count;
    double start = 0;
};

std::vector<Direction> directionsOnRings(const std::vector<Ring>& rings) {
    std::vector<Direction> directions;
    for (const Ring& ring : rings) {
        for (int k = 0; k < ring.count; ++k) {
            directions.push_back({radiansFromDegrees(ring.theta),
                                  radiansFromDegrees(ring.start + 360.0 * k / ring.count)});
        }
    }
    return directions;
}

void checkDirections(const std::vector<Direction>& directions, const char* what) {
    if (directions.empty()) throw std::invalid_argument(fmt::format("a grid needs a {}", what));
    for (const Direction& d : directions) {
        if (!std::isfinite(d.phi) || !(d.theta >= 0 && d.theta < kPi / 2)) {
            throw std::invalid_argument(
                fmt::format("the {} direction theta {} phi {} degrees is not above the surface: "
                            "theta must be at least 0 and below 90",
                            what, degreesFromRadians(d.theta), degreesFromRadians(d.phi)));
        }
    }
}

/// "regular:6x48" -> its grid; anything else of that form is an error.
AngularGrid regularGridFromName(const std::string& name) {
    std::istringstream text(name.substr(name.find(':') + 1));
    int thetas = 0;
    int phis = 0;
    char by = 0;
    if (!(text >> thetas >> by >> phis) || by != 'x' || !text.eof() || thetas < 1 || phis < 1 ||
        thetas > 1000 || phis > 1000) {
        throw std::invalid_argument(fmt::format(
            "the grid '{}' is not understood: write regular:THETASxPHIS, as regular:6x48", name));
    }
    return AngularGrid(regularDirections(thetas, phis));
}

}  // namespace

AngularGrid::AngularGrid(std::vector<Direction> lights, std::vector<Direction> views)
    : lights_(std::move(lights)), views_(std::move(views)) {
    checkDirections(lights_, "light");
    checkDirections(views_, "view");
}

Radians AngularGrid::maxTheta() const {
    Radians theta = 0;
    for (const Direction& d : lights_) theta = std::max(theta, d.theta);
    for (const Direction& d : views_) theta = std::max(theta, d.theta);
    return theta;
}

std::vector<LightAndView> pairsOf(const AngularGrid& grid) {
    std::vector<LightAndView> pairs;
    pairs.reserve(grid.pairCount());
    for (std::size_t i = 0; i < grid.pairCount(); ++i) pairs.push_back(grid.pair(i));
    return pairs;
}

std::vector<Direction> ubo81Directions() {
    return directionsOnRings({{0, 1}, {15, 6}, {30, 12}, {45, 18}, {60, 20}, {75, 24}});
}

std::vector<Direction> dome151Directions() {
    return directionsOnRings({{0, 1},
                              {11, 6, 15},
                              {23.5, 12},
                              {30, 12, 15},
                              {37.5, 12},
                              {45, 18},
                              {52.5, 18, 7.5},
                              {60, 24},
                              {67.5, 24, 7.5},
                              {75, 24}});
}

std::vector<Direction> regularDirections(int thetas, int phis) {
    std::vector<Ring> rings;
    for (int ring = 0; ring < thetas; ++ring) {
        rings.push_back({thetas > 1 ? 75.0 * ring / (thetas - 1) : 0.0, phis});
    }
    return directionsOnRings(rings);
}

NearestDirection::NearestDirection(const std::vector<Direction>& directions) {
    for (const Direction& d : directions) vectors_.push_back(vectorFromDirection(d));
}

std::size_t NearestDirection::indexOf(Direction target) const {
    const Imath::V3d wanted = vectorFromDirection(target);
    std::size_t nearest = 0;
    double best = -2;
    for (std::size_t i = 0; i < vectors_.size(); ++i) {
        const double cosine = vectors_[i] ^ wanted;
        // Nodes as far away as the nearest within rounding do not displace an earlier one.
        if (cosine > best + 1e-12) {
            best = cosine;
            nearest = i;
        }
    }
    return nearest;
}

std::size_t nearestDirection(const std::vector<Direction>& directions, Direction target) {
    return NearestDirection(directions).indexOf(target);
}

AngularGrid gridFromName(const std::string& nameOrFile) {
    if (nameOrFile == "ubo81") return AngularGrid(ubo81Directions());
    if (nameOrFile == "dome151") return AngularGrid(dome151Directions());
    if (nameOrFile == "utia288") return AngularGrid(regularDirections(6, 48));
    if (nameOrFile.starts_with("regular:")) return regularGridFromName(nameOrFile);
    if (std::filesystem::exists(nameOrFile)) return AngularGrid(directionsFromCsv(nameOrFile));
    throw std::invalid_argument(fmt::format(
        "there is no grid '{}': use input, ubo81, dome151, utia288, regular:THETASxPHIS or the "
        "path of a CSV file of theta_deg,phi_deg",
        nameOrFile));
}

std::vector<Direction> directionsFromCsv(const std::filesystem::path& file) {
    constexpr const char* kShape = "theta_deg,phi_deg with theta from 0 to below 90";
    std::vector<Direction> directions;
    for (const auto& [where, numbers] : numberRowsFromFile(file, 2, 2, kShape).rows) {
        if (!(numbers[0] >= 0 && numbers[0] < 90)) {
            throw std::runtime_error(fmt::format("{}: '{:g},{:g}' is not a row {}", where,
                                                 numbers[0], numbers[1], kShape));
        }
        directions.push_back(
            {radiansFromDegrees(numbers[0]), wrappedAzimuth(radiansFromDegrees(numbers[1]))});
    }
    if (directions.empty()) {
        throw std::runtime_error(fmt::format("{}: holds no theta_deg,phi_deg row", file.string()));
    }
    return directions;
}

}  // namespace abrdf
