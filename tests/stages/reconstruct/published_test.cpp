// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/rbf_weights.h"
#include "stages/reconstruct/reconstructor.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace abrdf;

namespace {

using Material = std::function<double(const LightAndView&)>;

std::vector<Rgb> samplesOf(const SlicePlan& plan, const Material& material) {
    std::vector<Rgb> samples;
    for (const LightAndView& pair : plan.samples()) {
        const auto value = static_cast<float>(material(pair));
        samples.push_back({value, 2 * value, 0});
    }
    return samples;
}

std::vector<Rgb> published(const SlicePlan& plan, const AngularGrid& grid,
                           const std::vector<Rgb>& samples) {
    const auto reconstructor = methodFromName("published").make({plan, {}, grid, grid});
    std::vector<Rgb> abrdf(grid.pairCount());
    reconstructor->reconstruct(samples, abrdf);
    return abrdf;
}

/// A slice that closes on itself, between its samples.
double onSlice(const std::vector<double>& slice, double azimuth) {
    const auto n = static_cast<double>(slice.size());
    const double place = wrappedAzimuth(azimuth) / (2 * kPi) * n;
    const auto k = static_cast<std::size_t>(place) % slice.size();
    const double t = place - std::floor(place);
    return (1 - t) * slice[k] + t * slice[(k + 1) % slice.size()];
}

/// The slow twin: one channel, one pair, straight from method.md, in double precision.
double slowPublished(const SlicePlan& plan, const std::vector<double>& samples,
                     const LightAndView& target) {
    Eigen::MatrixX2d nodes(4, 2);
    Eigen::VectorXd values(4);
    for (std::size_t s = 0; s < 4; ++s) {
        const auto row = static_cast<Eigen::Index>(s);
        nodes.row(row) << plan.thetaLight(s), plan.thetaView(s);
        const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(s * 51);
        const std::vector<double> axial(begin, begin + 24);
        const std::vector<double> diagonal(begin + 24, begin + 51);
        const auto v = [&](double phiLight, double phiView) {
            return onSlice(axial, (phiLight + phiView - plan.alpha) / 2) +
                   onSlice(diagonal, (phiView - phiLight + plan.alpha) / 2);
        };
        double low = 1e30;
        double high = -1e30;
        for (int j = 0; j < 24; ++j) {
            for (int k = 0; k < 27; ++k) {
                const double u = 2 * kPi * j / 24;
                const double w = 2 * kPi * k / 27;
                const double at = v(wrappedAzimuth(u - w + plan.alpha), wrappedAzimuth(u + w));
                low = std::min(low, at);
                high = std::max(high, at);
            }
        }
        const auto [m, M] = std::minmax_element(begin, begin + 51);
        const double at = v(wrappedAzimuth(target.light.phi), wrappedAzimuth(target.view.phi));
        values(row) = (at - low) / (high - low) * (*M - *m) + *m;
    }
    return RbfWeights(nodes).at({target.light.theta, target.view.theta}).dot(values);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("RBF weights reproduce the nodes and every linear function") {
    Eigen::MatrixX2d nodes(4, 2);
    nodes << 0.5, 0.5, 0.5, 1.3, 1.3, 0.5, 1.3, 1.3;
    const RbfWeights rbf(nodes);
    for (Eigen::Index n = 0; n < 4; ++n) {
        CHECK((rbf.at(nodes.row(n)) - Eigen::VectorXd::Unit(4, n)).norm() < 1e-9);
    }
    const Eigen::VectorXd linear =
        (2.0 + 3.0 * nodes.col(0).array() - nodes.col(1).array()).matrix();
    for (const double ti : {0.0, 0.3, 0.9, 1.5}) {
        for (const double tv : {0.0, 0.7, 1.4}) {
            CHECK(rbf.at({ti, tv}).sum() == doctest::Approx(1));
            CHECK(rbf.at({ti, tv}).dot(linear) == doctest::Approx(2 + 3 * ti - tv));
        }
    }
    nodes << 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5;
    CHECK_THROWS_AS(RbfWeights{nodes}, std::invalid_argument);
}

TEST_CASE("the fast kernel agrees with its slow twin on random samples") {
    const AngularGrid grid(ubo81Directions());
    for (const double alpha : {0.0, 37.0, 90.0, 180.0}) {
        SlicePlan plan;
        plan.alpha = radiansFromDegrees(alpha);
        std::vector<Rgb> samples;
        std::vector<double> green;
        for (int i = 0; i < 204; ++i) {
            const double value = 0.5 + 0.5 * std::sin(12.9 * i) * std::cos(3.1 * i * i);
            samples.push_back({static_cast<float>(1 - value), static_cast<float>(value), 0.25F});
            green.push_back(static_cast<double>(samples.back().g));
        }
        const std::vector<Rgb> fast = published(plan, grid, samples);
        for (std::size_t pair = 0; pair < grid.pairCount(); pair += 7) {
            CHECK(static_cast<double>(fast[pair].g) ==
                  doctest::Approx(slowPublished(plan, green, grid.pair(pair))).epsilon(1e-4));
            CHECK(fast[pair].b == doctest::Approx(0.25));
        }
    }
}

TEST_CASE("a subspace that is a sum of one function of u and one of w comes back, affinely") {
    // Single-valued on the torus: both have period pi. No sample lies past the seam's branch.
    SlicePlan plan;
    plan.axialCount = 360;
    plan.diagonalCount = 360;
    const Material sum = [&](const LightAndView& p) {
        const double u = (p.light.phi + p.view.phi - plan.alpha) / 2;
        const double w = (p.view.phi - p.light.phi + plan.alpha) / 2;
        return 2 + 0.5 * std::cos(2 * u) + 0.7 * std::sin(2 * w + 0.3) + 0.2 * std::cos(4 * w);
    };
    std::vector<Direction> ring;
    for (int k = 0; k < 36; ++k) ring.push_back({plan.elevations[0], radiansFromDegrees(10 * k)});
    const AngularGrid grid(ring);
    const std::vector<Rgb> abrdf = published(plan, grid, samplesOf(plan, sum));
    // Fits gain and offset from two pairs; all others must follow.
    const double a = sum(grid.pair(3));
    const double b = sum(grid.pair(700));
    const double gain =
        (static_cast<double>(abrdf[3].r) - static_cast<double>(abrdf[700].r)) / (a - b);
    CHECK(gain > 0.1);
    for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
        const double expected = static_cast<double>(abrdf[3].r) + gain * (sum(grid.pair(pair)) - a);
        CHECK(static_cast<double>(abrdf[pair].r) == doctest::Approx(expected).epsilon(2e-3));
    }
}

TEST_CASE("a texel whose range is 0 comes back as itself, and black is black") {
    const SlicePlan plan;
    const AngularGrid grid(ubo81Directions());
    for (const double value : {0.0, 1e-6, 0.5, 4000.0}) {
        const std::vector<Rgb> abrdf =
            published(plan, grid, samplesOf(plan, [&](const LightAndView&) { return value; }));
        for (const Rgb& c : abrdf) {
            CHECK(static_cast<double>(c.r) == doctest::Approx(value).epsilon(1e-5));
            CHECK(static_cast<double>(c.g) == doctest::Approx(2 * value).epsilon(1e-5));
            CHECK(c.b == 0);
        }
    }
}

TEST_CASE("a Lambertian is itself in every measured subspace") {
    // Its value, cos(theta_i), is constant there: M - m = 0.
    const SlicePlan plan;
    const AngularGrid grid(ubo81Directions());
    const std::vector<Rgb> abrdf = published(
        plan, grid, samplesOf(plan, [](const LightAndView& p) { return std::cos(p.light.theta); }));
    for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
        const LightAndView p = grid.pair(pair);
        const bool measured = std::ranges::count(plan.elevations, p.light.theta) == 1 &&
                              std::ranges::count(plan.elevations, p.view.theta) == 1;
        if (measured) {
            CHECK(static_cast<double>(abrdf[pair].r) == doctest::Approx(std::cos(p.light.theta)));
        }
    }
}

TEST_CASE("scaling the samples scales the answer") {
    const SlicePlan plan;
    const AngularGrid grid(ubo81Directions());
    const Material material = [](const LightAndView& p) {
        return 1 + std::cos(p.light.phi) * std::sin(2 * p.view.phi);
    };
    const std::vector<Rgb> one = published(plan, grid, samplesOf(plan, material));
    for (const double scale : {1e-4, 1e4}) {
        const std::vector<Rgb> scaled =
            published(plan, grid,
                      samplesOf(plan, [&](const LightAndView& p) { return scale * material(p); }));
        for (std::size_t pair = 0; pair < grid.pairCount(); pair += 11) {
            CHECK(static_cast<double>(scaled[pair].r) ==
                  doctest::Approx(scale * static_cast<double>(one[pair].r)).epsilon(1e-4));
        }
    }
}

TEST_CASE("no negative, infinite or NaN value leaves the stage, and each is counted") {
    const SlicePlan plan;
    const AngularGrid grid(ubo81Directions());
    AbrdfTile samples(2, 204);
    // A steep fall with elevation extrapolates below zero at the pole.
    const std::vector<Rgb> steep =
        samplesOf(plan, [&](const LightAndView& p) { return p.light.theta > 1 ? 1.0 : 0.0; });
    std::ranges::copy(steep, samples[0].begin());
    std::ranges::fill(samples[1], Rgb{1e38F, 1e38F, 1e38F});
    const auto reconstructor = methodFromName("published").make({plan, {}, grid, grid});
    const ReconstructedTexels texels = reconstructTexels(samples, grid, *reconstructor);
    CHECK(texels.unreal.clamped > 0);
    for (const Rgb& c : texels.abrdfs.values()) CHECK((isFinite(c) && !isNegative(c)));
}

TEST_CASE("methods are found by name, and unknown ones list the known") {
    CHECK(methodFromName("measured").wish == SampleWish::kEverything);
    try {
        methodFromName("magic");
        FAIL("an unknown method passed");
    } catch (const std::invalid_argument& error) {
        CHECK(std::string(error.what()).find("published") != std::string::npos);
    }
}

TEST_SUITE_END();
