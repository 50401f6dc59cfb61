// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/angular_grid.h"
#include "stages/export/export_brdf.h"
#include "stages/export/tensor_tree.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tensor_tree_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A Lambertian of a colour and a lobe around the mirror direction, longer along x by `stretch`;
/// half as bright for a light of azimuth pi .. 2 pi where `oneSided`.
struct Lobed : BrdfTable {
    Rgb albedo = {0.5F, 0.5F, 0.5F};
    double lobe = 0;
    double stretch = 1;
    bool oneSided = false;

    Rgb evaluate(const LightAndView& p) const override {
        const Imath::V3d light = vectorFromDirection(p.light);
        const Imath::V3d m = (light + vectorFromDirection(p.view)).normalized();
        const double x = m.x / stretch;
        const double f = lobe * std::exp(-(x * x + m.y * m.y) / 0.02);
        const double side = oneSided && p.light.phi >= kPi ? 0.5 : 1;
        const auto cosine = static_cast<float>(light.z * side);
        const auto white = static_cast<float>(f);
        return cosine * (albedo + Rgb{white, white, white});
    }
};

ExportReport writeTree(const fs::path& path, const BrdfTable& brdf, double cull,
                       double tolerance = 1, int resolution = 0) {
    const GrazingBrdf source(brdf, kPi / 2, Grazing::kHold, Cosine::kKept);
    ExportOptions options;
    options.cull = cull;
    options.tolerance = tolerance;
    options.resolution = resolution;
    return exportFormatFromName("radiance")
        .write(path, {source, Cosine::kKept, "a<b>&c", true}, options);
}

Direction directionOf(double x, double y) {
    return {std::asin(std::hypot(x, y)), wrappedAzimuth(std::atan2(y, x))};
}

/// Integral of f cos(theta_v) in Y over the views, through 96 x 96 equal areas.
template <typename Brdf>
double reflectance(Direction light, const Brdf& y) {
    constexpr int kSide = 96;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const DiskPlace place =
            diskFromSquare((i / kSide + 0.5) / kSide, (i % kSide + 0.5) / kSide);
        sum += y({light, directionOf(place.x, place.y)});
    }
    return sum * kPi / (kSide * kSide);
}

/// The light in the middle of a tree's cell: in rank 3 all azimuths are of one cell.
Direction cellLight(int rank, int i, int j) {
    if (rank == 3) return {std::asin((i + 0.5) / 16), 2 * kPi * (j + 0.3) / 16};
    const DiskPlace place = diskFromSquare((i + 0.5) / 16, (j + 0.5) / 16);
    return directionOf(place.x, place.y);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("Shirley and Chiu's map: corners, axes, and equal areas") {
    CHECK(diskFromSquare(1, 0.5).x == doctest::Approx(1));
    CHECK(diskFromSquare(0.5, 1).y == doctest::Approx(1));
    CHECK(diskFromSquare(0, 0.5).x == doctest::Approx(-1));
    CHECK(diskFromSquare(1, 1).x == doctest::Approx(std::sqrt(0.5)));
    CHECK(diskFromSquare(0, 0).y == doctest::Approx(-std::sqrt(0.5)));
    CHECK(diskFromSquare(0.5, 0.5).x == 0);
    for (const auto& [a, b] : {std::pair(0.1, 0.3), {0.7, 0.6}, {0.4, 0.9}}) {
        constexpr double kStep = 1e-5;
        const DiskPlace here = diskFromSquare(a, b);
        const DiskPlace right = diskFromSquare(a + kStep, b);
        const DiskPlace up = diskFromSquare(a, b + kStep);
        const double area =
            (right.x - here.x) * (up.y - here.y) - (right.y - here.y) * (up.x - here.x);
        CHECK(area / (kStep * kStep) == doctest::Approx(kPi).epsilon(1e-3));
    }
}

TEST_CASE(
    "a tree of cells: branches count the first dimension, grids the last; equal cells merge") {
    std::vector<float> cells(64, 1);
    for (std::size_t i = 0; i < 8; ++i) {
        cells[(i & 4U ? 16U : 0U) + (i & 2U ? 4U : 0U) + (i & 1U)] = static_cast<float>(i);
    }
    TreeOptions options{3, 2, 0, 0, 64};
    const TensorTree tree = tensorTree(cells, {}, options);
    CHECK(tree.text == "{{0 1 2 3 4 5 6 7}\n{1}\n{1}\n{1}\n{1}\n{1}\n{1}\n{1}}");
    CHECK(tree.leaves == 15);
    CHECK(tree.bound <= 1e-5);
    options.cull = 1;
    CHECK(tensorTree(cells, {}, options).leaves == 1);
    std::vector<float> weights(64, 0);
    weights[21] = 1;  // 7.
    CHECK(tensorTree(cells, weights, options).text == "{7}");
}

TEST_CASE("colours come back from a Radiance tree of rank 3, greys as greys of equal energy") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.xml";
    Lobed brdf;
    const LightAndView pair = {{0.4, 1.2}, {0.7, 2.9}};
    CHECK(writeTree(path, brdf, 0).details["rank"] == 3);
    const auto grey = TensorTreeFile(path).evaluate(pair);
    for (const double x : grey) CHECK(x == doctest::Approx(0.5 / kPi).epsilon(1e-4));
    brdf.albedo = {0.8F, 0.1F, 0};
    writeTree(path, brdf, 0);
    const auto red = TensorTreeFile(path).evaluate(pair);
    CHECK(red[0] > red[1]);
    CHECK(red[1] > 2 * red[2]);
    CHECK(red[1] * kPi == doctest::Approx(0.2465).epsilon(0.1));
    CHECK(TensorTreeFile(path).numbers() < 20);
}

TEST_CASE("a Radiance tree keeps values within the cull's bound, and reflectance within 1 %") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.xml";
    Lobed brdf;
    brdf.lobe = 3;
    for (const double stretch : {1.0, 3.0}) {
        CAPTURE(stretch);
        brdf.stretch = stretch;
        const ExportReport whole = writeTree(path, brdf, 0, 0.5);
        CHECK(whole.details["rank"] == (stretch == 1 ? 3 : 4));
        const TensorTreeFile before(path);
        const ExportReport culled = writeTree(path, brdf, 90, 0.5);
        const TensorTreeFile after(path);
        CHECK(culled.details["leaves"][0].get<double>() <=
              0.1 * static_cast<double>(culled.values) + 1);
        CHECK(after.numbers() < before.numbers() / 5);
        const double bound = culled.details["cull_bound"][0];
        CHECK(bound > 0);
        double worst = 0;
        double difference = 0;
        double sum = 0;
        for (const LightAndView& pair : pairsOf(AngularGrid(dome151Directions()))) {
            const double a = before.evaluate(pair)[1];
            const double b = after.evaluate(pair)[1];
            worst = std::max(worst, std::abs(a - b) / (b + 0.01));
            // Against the truth: a cell's mean is not the middle's value.
            const double truth =
                static_cast<double>(brdf.evaluate(pair).g) / (kPi * std::cos(pair.light.theta));
            difference += std::abs(a - truth);
            sum += truth;
        }
        CHECK(worst <= bound * 1.001);
        CHECK(difference / sum < (stretch == 1 ? 0.05 : 0.12));
        // Each light in the middle of its cell is reflected as the material does.
        double least = 10;
        double most = 0;
        for (int i = 0; i < 16 * 16; ++i) {
            const Direction light = cellLight(whole.details["rank"], i / 16, i % 16);
            const double truth = reflectance(light, [&](const LightAndView& pair) {
                return static_cast<double>(brdf.evaluate(pair).g) /
                       (kPi * std::cos(pair.light.theta));
            });
            const double found = reflectance(
                light, [&](const LightAndView& pair) { return before.evaluate(pair)[1]; });
            least = std::min(least, found / truth);
            most = std::max(most, found / truth);
        }
        CHECK(least > 0.99);
        CHECK(most < 1.01);
    }
}

TEST_CASE("a tree of one leaf tells how far it is off, and names are text of XML") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.xml";
    Lobed brdf;
    brdf.lobe = 3;
    const GrazingBrdf source(brdf, kPi / 2, Grazing::kHold, Cosine::kKept);
    ExportOptions options;
    options.cull = 100;
    const ExportReport report =
        exportFormatFromName("radiance")
            .write(path, {source, Cosine::kKept, "a\x01&\n<b>", true}, options);
    CHECK(report.details["leaves"][0] == 1);
    const TensorTreeFile file(path);
    double largest = 0;
    for (const LightAndView& pair : pairsOf(AngularGrid(dome151Directions()))) {
        const double f = static_cast<double>(brdf.evaluate(pair).g) / std::cos(pair.light.theta);
        largest = std::max(largest, f / kPi);
    }
    const double bound = report.details["cull_bound"][0];
    CHECK(bound > 0.9 * largest / file.evaluate({{0.3, 0}, {0.3, 0}})[1] - 1);
    CHECK(bound < 100);
    CHECK(bytesOf(path).find("<Name>a &amp; &lt;b&gt;</Name>") != std::string::npos);
}

TEST_CASE("light comes first in a Radiance tree, and where it comes from is told apart") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.xml";
    Lobed brdf;
    brdf.oneSided = true;
    CHECK(writeTree(path, brdf, 0).details["rank"] == 4);
    const TensorTreeFile file(path);
    CHECK(file.evaluate({{0.5, 1}, {0.5, 4}})[1] == doctest::Approx(0.5 / kPi).epsilon(1e-4));
    CHECK(file.evaluate({{0.5, 4}, {0.5, 1}})[1] == doctest::Approx(0.25 / kPi).epsilon(1e-4));
    CHECK_THROWS_AS(writeTree(path, brdf, 0, 1, 24), std::invalid_argument);
}

TEST_SUITE_END();
