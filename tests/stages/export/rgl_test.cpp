// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/rgl_table.h"
#include "stages/export/export_brdf.h"
#include "stages/export/normal_distribution.h"
#include "stages/export/smooth_spectra.h"
#include "stages/read/btf_reader.h"
#include "tests/support/brdf_comparison.h"
#include "tests/support/rgl_samples.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A white Lambertian times `albedo` and, where `gloss` is above 0, GGX facets over it that are
/// rougher along x by `stretch`. Reciprocal, but for the share `oneWay` of a sine of the light.
struct Glossy : BrdfTable {
    double albedo = 0.5;
    double gloss = 0;
    double roughness = 0.2;
    double stretch = 1;
    double oneWay = 0;

    Rgb evaluate(const LightAndView& p) const override {
        const Imath::V3d in = vectorFromDirection(p.light);
        const Imath::V3d out = vectorFromDirection(p.view);
        const Imath::V3d m = (in + out).normalized();
        const double x = m.x / (roughness * stretch);
        const double y = m.y / roughness;
        const double shape = x * x + y * y + m.z * m.z;
        const double d = 1 / (kPi * roughness * roughness * stretch * shape * shape);
        // Kelemen's masking: f = D / (4 <l, m>^2).
        const double l = in.dot(m);
        const double f =
            albedo / kPi * (1 + oneWay * std::sin(p.light.theta)) + gloss * d / (4 * l * l + 1e-3);
        const auto v = static_cast<float>(kPi * f * in.z);
        return {v, 0.5F * v, 0.25F * v};
    }
};

ExportReport writeRglFile(const fs::path& path, const BrdfTable& brdf, ExportOptions options = {}) {
    const GrazingBrdf source(brdf, kPi / 2, Grazing::kHold, Cosine::kKept);
    options.resolution = options.resolution == 0 ? 48 : options.resolution;
    return exportFormatFromName("rgl").write(path, {source, Cosine::kKept, "test"}, options);
}

/// Mean of |a - b| over the mean of b, over lights and views up to 75 degrees.
double differenceOf(const BrdfTable& a, const BrdfTable& b) {
    double difference = 0;
    double sum = 0;
    for (const LightAndView& pair : pairsOf(AngularGrid(regularDirections(7, 17)))) {
        const auto w = std::sin(pair.light.theta) * std::sin(pair.view.theta);
        const auto x = static_cast<double>(a.evaluate(pair).g);
        const auto y = static_cast<double>(b.evaluate(pair).g);
        difference += w * std::abs(x - y);
        sum += w * y;
    }
    return difference / sum;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a Lambertian comes back from an RGL file, isotropic, and nothing is lost") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    const ExportReport report = writeRglFile(path, Glossy());
    CHECK(report.details["isotropic"] == true);
    CHECK(report.details["symmetry"]["share_over_azimuth"].get<double>() < 1e-9);
    CHECK(report.details["symmetry"]["share_not_reciprocal"].get<double>() < 1e-9);
    const auto reader = openBtf(path);
    CHECK(reader->description().format == "RGL");
    CHECK(differenceOf(*reader->table(), Glossy()) < 2e-3);
    const RglSamples file(path);
    CHECK(file.fields().at("phi_i").values.size() == 2);
    CHECK(file.fields().at("jacobian").bytes == std::string(1, '\1'));
    CHECK(file.fields().at("description").bytes == "test");
    CHECK(file.fields().count("spectra") == 0);
}

TEST_CASE("gloss comes back, round and stretched; the latter is anisotropic without symmetry") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    Glossy brdf;
    brdf.gloss = 0.3;
    CHECK(writeRglFile(path, brdf).details["isotropic"] == true);
    CHECK(differenceOf(*openBtf(path)->table(), brdf) < 0.01);
    brdf.stretch = 2;
    CHECK(writeRglFile(path, brdf).details["isotropic"] == false);
    CHECK(differenceOf(*openBtf(path)->table(), brdf) < 0.02);
    const RglSamples file(path);
    const auto& phis = file.fields().at("phi_i").values;
    CHECK(static_cast<double>(phis.back() - phis.front()) == doctest::Approx(2 * kPi));
    ExportOptions any;
    any.tolerance = 100;
    CHECK(writeRglFile(path, brdf, any).details["isotropic"] == true);
}

TEST_CASE("what a renderer draws integrates to 1, follows the values, and keeps the energy") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    Glossy brdf;
    for (const double stretch : {1.0, 2.0}) {
        brdf.gloss = 0.3;
        brdf.stretch = stretch;
        writeRglFile(path, brdf);
        const RglSamples file(path);
        const auto& thetas = file.fields().at("theta_i").values;
        const auto& phis = file.fields().at("phi_i").values;
        for (const std::size_t theta : {std::size_t{0}, thetas.size() / 3, 3 * thetas.size() / 4}) {
            const std::size_t phi = phis.size() / 3;
            CAPTURE(thetas[theta]);
            const RglSamples::Integral found = file.integral(phi, theta, 600);
            CHECK(std::abs(found.density - 1) < 1e-3);
            CHECK(found.weight < 1.2);  // 1: every sample would carry the same.
            // The truth: over the lights of the hemisphere, evenly in (cos^2 theta, phi).
            double truth = 0;
            const Direction view = {static_cast<double>(thetas[theta]),
                                    static_cast<double>(phis[phi])};
            constexpr int kSide = 400;
            for (int i = 0; i < kSide * kSide; ++i) {
                const double sine = std::sqrt((i / kSide + 0.5) / kSide);
                const Direction light = {std::asin(sine), 2 * kPi * (i % kSide + 0.5) / kSide};
                truth += static_cast<double>(brdf.evaluate({light, view}).g) /
                         (std::cos(light.theta) * kSide * kSide);
            }
            CHECK(std::abs(found.energy / truth - 1) < 5e-3);
        }
    }
}

TEST_CASE("a white furnace stays white: no reflectance above 1") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    Glossy white;
    white.albedo = 1;
    CHECK(writeRglFile(path, white).details["largest_reflectance"].get<double>() <= 1);
    const auto reader = openBtf(path);
    for (const double theta : {0.0, 0.4, 0.83, 1.21, 1.5}) {
        double sum = 0;
        constexpr int kSide = 200;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double sine = std::sqrt((i / kSide + 0.5) / kSide);
            const Direction light = {std::asin(sine), 2 * kPi * (i % kSide + 0.5) / kSide};
            sum += static_cast<double>(reader->table()->evaluate({light, {theta, 1}}).r) /
                   (std::cos(light.theta) * kSide * kSide);
        }
        CHECK(sum <= 1);
        CHECK(sum > 0.99);
    }
}

TEST_CASE("what is not reciprocal is kept for the viewer's side, and its share is told") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    Glossy brdf;
    brdf.oneWay = 0.5;
    const ExportReport report = writeRglFile(path, brdf);
    CHECK(report.details["symmetry"]["share_not_reciprocal"].get<double>() > 1e-3);
    CHECK(differenceOf(*openBtf(path)->table(), brdf) < 3e-3);
    CHECK(report.details["notes"].dump().find("not reciprocal") != std::string::npos);
}

TEST_CASE("an atlas that reflects more than it receives is told so, and kept") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    Glossy brdf;
    for (const double albedo : {0.9, 1.5}) {
        brdf.albedo = albedo;
        const GrazingBrdf source(brdf, kPi / 2, Grazing::kHold, Cosine::kKept);
        const ExportReport report = exportFormatFromName("rgl").write(
            path, {source, Cosine::kKept, "test", true}, ExportOptions());
        const double largest = report.details["largest_reflectance"];
        CHECK(std::abs(largest / albedo - 1) < 0.01);
        const std::string notes = report.details["notes"].dump();
        CHECK((notes.find("reflects up to 1.5") != std::string::npos) == (albedo > 1));
    }
}

TEST_CASE("black is drawn from evenly") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    Glossy black;
    black.albedo = 0;
    writeRglFile(path, black);
    const RglSamples file(path);
    CHECK(std::abs(file.integral(0, 3, 300).density - 1) < 1e-3);
    CHECK(openBtf(path)->table()->evaluate({{0.3, 1}, {0.5, 2}}) == Rgb{});
}

TEST_CASE("the distribution from a Lambertian's retro-reflection has area 1 seen from above") {
    for (const std::size_t phis : {std::size_t{2}, std::size_t{33}}) {
        const NormalDistribution d =
            distributionFromRetro(phis, [](Direction m) { return std::cos(m.theta); });
        CHECK(d.area[0] == doctest::Approx(1).epsilon(2e-3));
        for (std::size_t t = 1; t < d.nodes.thetas; ++t) {
            CHECK(d.area[t] <= d.area[t - 1] + 1e-9);
            CHECK(d.density[t] > 0);
        }
    }
}

TEST_CASE("smooth spectra are seen under D65 as their colours") {
    // The colour matching functions of Wyman, Sloan and Shirley 2013, and D65 each 20 nm.
    const auto lobe = [](double l, double at, double below, double above) {
        const double t = (l - at) * (l < at ? below : above);
        return std::exp(-0.5 * t * t);
    };
    constexpr std::array kD65 = {82.75,  93.43,  104.87, 117.81, 115.92, 109.35,
                                 104.79, 104.41, 100.0,  95.79,  90.01,  87.70,
                                 83.70,  80.21,  78.28,  71.61,  61.60};
    std::array sums = {Imath::V3d(0), Imath::V3d(0), Imath::V3d(0)};
    Imath::V3d white(0);
    for (double l = 400; l <= 720; l += 5) {
        const double place = (l - 400) / 20;
        const auto k = std::min(static_cast<std::size_t>(place), std::size_t{15});
        const double share = place - static_cast<double>(k);
        const double light = (1 - share) * kD65[k] + share * kD65[k + 1];
        const Imath::V3d matching(
            1.056 * lobe(l, 599.8, 0.0264, 0.0323) + 0.362 * lobe(l, 442, 0.0624, 0.0374) -
                0.065 * lobe(l, 501.1, 0.0490, 0.0382),
            0.821 * lobe(l, 568.8, 0.0213, 0.0247) + 0.286 * lobe(l, 530.9, 0.0613, 0.0322),
            1.217 * lobe(l, 437, 0.0845, 0.0278) + 0.681 * lobe(l, 459, 0.0385, 0.0725));
        white += light * matching;
        for (std::size_t c = 0; c < 3; ++c) {
            const Rgb color = {c == 0 ? 1.0F : 0, c == 1 ? 1.0F : 0, c == 2 ? 1.0F : 0};
            const double value = (1 - share) * static_cast<double>(spectra::at(color, k)) +
                                 share * static_cast<double>(spectra::at(color, k + 1));
            sums[c] += value * light * matching;
        }
    }
    // Rec.709's primaries, as X, Y and Z over those of D65 white.
    const std::array<Imath::V3d, 3> truth = {Imath::V3d(0.4339, 0.2126, 0.0178),
                                             Imath::V3d(0.3762, 0.7152, 0.1095),
                                             Imath::V3d(0.1899, 0.0722, 0.8728)};
    for (std::size_t c = 0; c < 3; ++c) {
        for (int k = 0; k < 3; ++k) CHECK(std::abs(sums[c][k] / white[k] - truth[c][k]) < 0.01);
    }
    for (std::size_t k = 0; k < spectra::kCount; ++k) {
        CHECK(spectra::at({1, 1, 1}, k) == doctest::Approx(1).epsilon(1e-4));
        CHECK(spectra::at({5, 5, 5}, k) == doctest::Approx(5).epsilon(1e-4));
    }
}

TEST_CASE("an RGL file holds spectra where they are asked for") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.bsdf";
    ExportOptions options;
    options.spectra = true;
    options.resolution = 16;
    const ExportReport report = writeRglFile(path, Glossy(), options);
    CHECK(
        report.details["layout"].get<std::string>().ends_with("rgb wavelengths spectra jacobian"));
    const RglSamples file(path);
    const auto& spectra = file.fields().at("spectra");
    const auto& rgb = file.fields().at("rgb");
    CHECK(spectra.sizes == std::vector<std::size_t>{2, rgb.sizes[1], 17, 16, 16});
    CHECK(file.fields().at("wavelengths").values.front() == 400);
    CHECK(file.fields().at("wavelengths").values.back() == 720);
    // Red at long waves, blue at 460 nm.
    const std::size_t place = 8 * 16 + 5;
    CHECK(spectra.values[15 * 256 + place] == rgb.values[place]);
    CHECK(spectra.values[3 * 256 + place] == rgb.values[2 * 256 + place]);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow");

TEST_CASE("the measured RGL files beside the checkout come back from ours") {
    const fs::path data = fs::path(ABRDF_SHARED_DATA) / "rgl";
    if (!fs::exists(data)) {
        MESSAGE("skipped: ../shared/data/rgl is absent");
        return;
    }
    const TemporaryFolder folder;
    for (const auto& entry : fs::directory_iterator(data)) {
        CAPTURE(entry.path().filename().string());
        const auto measured = openBtf(entry.path());
        const BrdfTable& before = *measured->table();
        const GrazingBrdf source(before, kPi / 2, Grazing::kHold, Cosine::kKept);
        const fs::path path = folder.path() / "m.bsdf";
        const ExportReport report = exportFormatFromName("rgl").write(
            path, {source, Cosine::kKept, "test"}, ExportOptions());
        CHECK(report.details["isotropic"] == true);
        const auto again = openBtf(path);
        const BrdfComparison found = compareBrdfs(before, *again->table());
        CHECK(found.error < 0.01);
        CHECK(found.energy < 5e-3);
        CHECK(found.allEnergy < 2e-3);
        CHECK(found.highlight < 0.03);
        CHECK(found.reflectance <= std::max(1.0, found.trueReflectance));
        const RglSamples file(path);
        CHECK(std::abs(file.integral(0, 7, 700).density - 1) < 1e-3);
        MESSAGE(entry.path().filename().string(), ": ", 100 * found.error, " % mean error");
    }
}

TEST_SUITE_END();
