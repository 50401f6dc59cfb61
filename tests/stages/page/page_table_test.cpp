// SPDX-License-Identifier: BSD-3-Clause
#include "stages/page/page_table.h"

#include "tests/support/linear_look_up.h"
#include "tests/support/synthetic_atlas.h"

#include <doctest/doctest.h>
#include <half.h>

#include <cmath>
#include <limits>

using namespace abrdf;

namespace {

double valueOf(std::uint16_t bits) {
    half value;
    value.setBits(bits);
    return static_cast<double>(static_cast<float>(value));
}

/// B(light, view) as the page's shader finds it: rings of even azimuths.
struct Place {
    int index;
    double weight;
};
std::vector<Place> placesOf(const std::vector<PageRing>& rings, Direction d) {
    std::size_t above = 0;
    while (above < rings.size() && rings[above].theta < d.theta) ++above;
    const PageRing& lower = rings[above > 0 ? above - 1 : 0];
    const PageRing& upper = rings[std::min(above, rings.size() - 1)];
    const double gap = upper.theta - lower.theta;
    const double t = gap > 0 ? (d.theta - lower.theta) / gap : 0;
    std::vector<Place> places;
    for (const auto& [ring, share] : {std::pair{lower, 1 - t}, std::pair{upper, t}}) {
        const double turns = (d.phi - ring.phi0) / (2 * kPi);
        const double place = (turns - std::floor(turns)) * ring.count;
        const int before = std::min(static_cast<int>(place), ring.count - 1);
        places.push_back({ring.first + before, share * (1 - (place - before))});
        places.push_back({ring.first + (before + 1) % ring.count, share * (place - before)});
    }
    return places;
}

Rgb wavy(const LightAndView& p, int, int) {
    const auto value = [&](double k) {
        return static_cast<float>(2 + std::cos(k * p.light.phi) * std::sin(p.light.theta) -
                                  std::sin(p.view.phi + k) * std::sin(p.view.theta));
    };
    return {value(1), value(2), value(3)};
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the page's table, looked up as its shader does, says what linear interpolation says") {
    for (const AngularGrid& grid :
         {AngularGrid(ubo81Directions()), AngularGrid(dome151Directions()),
          AngularGrid(regularDirections(6, 48))}) {
        const Atlas atlas = syntheticAtlas(grid, 1, 1, wavy);
        const PageTable table = pageTableOf(atlas);
        CHECK_FALSE(table.resampled);
        CHECK(table.halves.size() == 3 * grid.pairCount());
        for (int k = 0; k < 300; ++k) {
            const Direction light{radiansFromDegrees(0.26 * k), wrappedAzimuth(0.83 * k)};
            const Direction view{radiansFromDegrees(78 - 0.26 * k), wrappedAzimuth(2.1 * k)};
            double sum = 0;
            for (const Place& l : placesOf(table.lightRings, light)) {
                for (const Place& v : placesOf(table.viewRings, view)) {
                    const int at = 3 * (l.index * table.views + v.index) + 1;
                    sum +=
                        l.weight * v.weight * valueOf(table.halves[static_cast<std::size_t>(at)]);
                }
            }
            CHECK(sum == doctest::Approx(linearLookUp(atlas, light, view).g).epsilon(2e-3));
        }
    }
}

TEST_CASE("rings in any order are found; azimuths that are not even are not taken for such") {
    std::vector<Direction> directions = ubo81Directions();
    std::reverse(directions.begin(), directions.end());
    const auto rings = evenRings(directions);
    REQUIRE(rings);
    CHECK(rings->rings.size() == 6);
    CHECK(rings->rings[5].count == 24);
    CHECK(directions[rings->order[0]].theta == 0);
    directions[0].phi += 0.01;
    CHECK_FALSE(evenRings(directions));
}

TEST_CASE("other directions are resampled, and numbers that are none do not spread") {
    std::vector<Direction> scattered;
    for (int k = 0; k < 40; ++k) {
        scattered.push_back({radiansFromDegrees(1.8 * k), wrappedAzimuth(2.4 * k)});
    }
    const Atlas atlas =
        syntheticAtlas(AngularGrid(scattered), 1, 1, [](const LightAndView& p, int, int) {
            constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
            return p.light.theta > 1 ? Rgb{kNaN, 1e9F, -1e9F} : Rgb{1, 2, 3};
        });
    const PageTable table = pageTableOf(atlas);
    CHECK(table.resampled);
    CHECK(table.lightRings.size() == 11);
    for (const std::uint16_t bits : table.halves) CHECK(std::isfinite(valueOf(bits)));
    CHECK(valueOf(table.halves[1]) == doctest::Approx(2));
}

TEST_SUITE_END();
