// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/snap_plan.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using namespace abrdf;

namespace {

LightAndView pairAt(double thetaLight, double phiLight, double thetaView, double phiView) {
    return {{radiansFromDegrees(thetaLight), radiansFromDegrees(phiLight)},
            {radiansFromDegrees(thetaView), radiansFromDegrees(phiView)}};
}

const AngularGrid& grid() {
    static const AngularGrid kGrid(regularDirections(6, 24));
    return kGrid;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("samples of a plan go to the nearest pair, and one too far in either direction is told") {
    const SamplePlan plan{"p", {pairAt(29, 1, 61, 179), pairAt(45, 90, 45, 0)}, {}};
    const SnappedPlan snapped = snapPlan(plan, grid(), {}, radiansFromDegrees(2));
    CHECK(squaredDistance(snapped.plan.samples[0], pairAt(30, 0, 60, 180)) < 1e-12);
    CHECK(squaredDistance(snapped.plan.samples[1], plan.samples[1]) < 1e-12);
    for (const LightAndView& far : {pairAt(30, 0, 82, 0), pairAt(82, 0, 30, 0)}) {
        SamplePlan bad = plan;
        for (int i = 0; i < 7; ++i) bad.samples.push_back(far);
        try {
            snapPlan(bad, grid(), {}, radiansFromDegrees(5));
            FAIL("nothing was thrown");
        } catch (const std::runtime_error& error) {
            const std::string text = error.what();
            CHECK(text.find("7 of its 9 samples") != std::string::npos);
            CHECK(text.find("7.0 away") != std::string::npos);
            CHECK(text.find("--snap") != std::string::npos);
            CHECK(text.find("; ...") != std::string::npos);
        }
        CHECK(snapPlan(bad, grid(), {}, radiansFromDegrees(7)).plan.samples.size() == 9);
    }
}

TEST_CASE("a present neighbour within the bound stands in for a missing image, none beyond it") {
    const LightAndView wanted = pairAt(30, 0, 30, 45);
    const NearestDirection nearest(grid().lights());
    const std::size_t pair =
        grid().pairIndex(nearest.indexOf(wanted.light), nearest.indexOf(wanted.view));
    std::vector<std::uint8_t> present(grid().pairCount(), 1);
    present[pair] = 0;
    const SamplePlan plan{"p", {wanted}, {}};
    // Azimuths are 15 degrees apart, at 30 degrees 7.5 on the sphere.
    const SnappedPlan other = snapPlan(plan, grid(), present, radiansFromDegrees(8));
    CHECK(other.stoodIn == 1);
    CHECK(squaredDistance(other.plan.samples[0], wanted) > 1e-3);
    const SnappedPlan same = snapPlan(plan, grid(), present, radiansFromDegrees(7));
    CHECK(same.stoodIn == 0);
    CHECK(same.plan.samples[0] == grid().pair(pair));
}

TEST_SUITE_END();
