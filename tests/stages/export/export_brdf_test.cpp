// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/export_brdf.h"

#include "abrdf/merl_table.h"
#include "abrdf/sampled_brdf.h"
#include "stages/read/btf_reader.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/reader_faults.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <vector>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

constexpr Radians kMax = radiansFromDegrees(75);

/// Isotropic and reciprocal: pi f cos(theta_i), 2 + cos of the azimuths' difference in f.
struct Isotropic : BrdfTable {
    Rgb evaluate(const LightAndView& p) const override {
        const double f = (2 + std::cos(p.light.phi - p.view.phi) * std::sin(p.light.theta) *
                                  std::sin(p.view.theta)) /
                         8;
        const auto v = static_cast<float>(f * std::cos(p.light.theta));
        return {v, 2 * v, 0.5F * v};
    }
};

/// The same, and a part that turns with the sample.
struct Anisotropic : BrdfTable {
    Rgb evaluate(const LightAndView& p) const override {
        const Rgb c = Isotropic().evaluate(p);
        const auto turn =
            static_cast<float>(1 + 0.5 * std::cos(2 * p.light.phi) * std::sin(p.light.theta));
        return turn * c;
    }
};

std::vector<Rgb> valuesOn(const AngularGrid& grid, const BrdfTable& brdf) {
    std::vector<Rgb> values;
    for (const LightAndView& pair : pairsOf(grid)) values.push_back(brdf.evaluate(pair));
    return values;
}

ExportReport write(const char* format, const fs::path& path, const BrdfTable& brdf,
                   UtiaEncoding encoding = UtiaEncoding::kLinear, Radians maxTheta = kMax) {
    const GrazingBrdf source(brdf, maxTheta, Grazing::kHold, Cosine::kKept);
    ExportOptions options;
    options.utiaEncoding = encoding;
    return exportFormatFromName(format).write(path, {source, Cosine::kKept, "test"}, options);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("UTIA's files come back to the bit on the UTIA grid") {
    const TemporaryFolder folder;
    const AngularGrid grid(regularDirections(6, 48));
    const SampledBrdf brdf(grid, valuesOn(grid, Anisotropic()));
    for (const char* format : {"utia-bin", "utia-exr"}) {
        const fs::path path = folder.path() / (std::string(format).replace(4, 1, "."));
        const ExportReport report = write(format, path, brdf);
        CHECK(report.values == 82944);
        CHECK(report.extrapolated == 0);
        const auto reader = openBtf(path);
        for (std::size_t i = 0; i < grid.pairCount(); ++i) {
            CHECK(reader->table()->evaluate(grid.pair(i)) == brdf.values()[i]);
        }
    }
    CHECK(fs::file_size(folder.path() / "utia.bin") == 288 * 288 * 3 * 8);
}

TEST_CASE("UTIA's encodings are undone by reading") {
    const TemporaryFolder folder;
    for (const auto encoding : {UtiaEncoding::kSrgb, UtiaEncoding::kSrgb140}) {
        write("utia-bin", folder.path() / "u.bin", Isotropic(), encoding);
        ReadOptions options;
        options.utiaEncoding = encoding;
        const auto reader = openBtf(folder.path() / "u.bin", options);
        const LightAndView pair = reader->description().grid.pair(70000);
        CHECK(reader->table()->evaluate(pair).g ==
              doctest::Approx(Isotropic().evaluate(pair).g).epsilon(1e-6));
    }
}

TEST_CASE("a grid of the database's own is resampled onto UTIA's") {
    const TemporaryFolder folder;
    const AngularGrid grid(ubo81Directions());
    const SampledBrdf brdf(grid, valuesOn(grid, Isotropic()));
    write("utia-bin", folder.path() / "u.bin", brdf);
    const auto reader = openBtf(folder.path() / "u.bin");
    for (std::size_t i = 0; i < 82944; i += 61) {
        const LightAndView pair = reader->description().grid.pair(i);
        CHECK(reader->table()->evaluate(pair).r ==
              doctest::Approx(Isotropic().evaluate(pair).r).epsilon(0.02));
    }
}

TEST_CASE("an isotropic material comes back from a MERL file within 1e-6, and nothing is lost") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.binary";
    const ExportReport report = write("merl", path, Isotropic(), {}, kPi / 2);
    CHECK(report.extrapolated == 0);
    CHECK(report.details["lost"]["share_of_energy"].get<double>() < 1e-9);
    const auto reader = openBtf(path);
    CHECK(reader->description().belowHorizon > 0);
    for (std::size_t i = 0; i < merl::kEntries; i += 1009) {
        const LightAndView pair = pairFromHalfAngles(merl::anglesOfEntry(i));
        if (pair.light.theta >= kPi / 2 || pair.view.theta >= kPi / 2) continue;
        CHECK(reader->table()->evaluate(pair).g ==
              doctest::Approx(Isotropic().evaluate(pair).g).epsilon(1e-6));
    }
}

TEST_CASE("a MERL file holds the mean over the azimuth, and its report says what is lost") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.binary";
    const ExportReport report = write("merl", path, Anisotropic());
    CHECK(report.extrapolated > 0);
    CHECK(report.extrapolated < report.values);
    const double share = report.details["lost"]["share_of_energy"];
    CHECK(share > 0.005);
    CHECK(share < 0.1);
    const LightAndView pair = pairFromHalfAngles(merl::anglesOfEntry(merl::entry(30, 40, 50)));
    CHECK(openBtf(path)->table()->evaluate(pair).g ==
          doctest::Approx(Isotropic().evaluate(pair).g).epsilon(1e-5));
}

TEST_CASE("an ASTM file is a row a pair, angles in radians and the BRDF") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.txt";
    const ExportReport report = write("astm", path, Isotropic());
    CHECK(report.details["isotropic"] == true);
    std::istringstream text(bytesOf(path));
    std::string line;
    std::getline(text, line);
    CHECK(line == "NUM_POINTS 20808");
    std::getline(text, line);
    CHECK(line == "VARS theta_i,phi_i,theta_s,phi_s,R,G,B");
    int rows = 0;
    while (std::getline(text, line)) {
        LightAndView pair;
        Rgb c;
        REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%f,%f,%f", &pair.light.theta,
                            &pair.light.phi, &pair.view.theta, &pair.view.phi, &c.r, &c.g,
                            &c.b) == 7);
        if (pair.light.theta < kMax && pair.view.theta < kMax) {
            const auto f = static_cast<double>(Isotropic().evaluate(pair).g) /
                           (kPi * std::cos(pair.light.theta));
            CHECK(static_cast<double>(c.g) == doctest::Approx(f).epsilon(1e-4));
        }
        ++rows;
    }
    CHECK(rows == 20808);
    CHECK(write("astm", path, Anisotropic()).values == 6 * 24 * 17 * 24);
    // Readers go on past the light's last azimuth and not round: 360 degrees are there as well.
    const std::string closed = bytesOf(path);
    CHECK(closed.starts_with("NUM_POINTS 61200\n"));  // 6 x 25 x 17 x 24.
    CHECK(std::ranges::count(closed, '\n') == 61202);
    const auto valuesAt = [&](const char* place) {
        const std::size_t begin = closed.find(place) + std::string(place).size();
        return closed.substr(begin, closed.find('\n', begin) - begin);
    };
    const std::string first = valuesAt("\n0.785398,0.000000,0.523599,1.047198,");
    CHECK(std::ranges::count(first, ',') == 2);
    CHECK(valuesAt("\n0.785398,6.283185,0.523599,1.047198,") == first);
}

TEST_CASE(
    "an SSDD file is lists of angles in degrees and the BRDF, the light's elevation the fastest") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.ssdd";
    for (const bool isotropic : {true, false}) {
        CAPTURE(isotropic);
        const ExportReport report =
            isotropic ? write("ssdd", path, Isotropic()) : write("ssdd", path, Anisotropic());
        CHECK(report.details["isotropic"] == isotropic);
        std::istringstream text(bytesOf(path));
        std::string line;
        std::getline(text, line);
        CHECK(line == "VERSION 0.2");
        std::array<std::vector<double>, 4> angles;
        std::string order;
        while (std::getline(text, line) && line != "DATA ascii") {
            if (line.empty()) continue;
            std::istringstream entry(line);
            std::string key;
            entry >> key;
            order += key + " ";
            if (!key.starts_with("PARAM") || key == "PARAM_TYPE") continue;
            std::vector<double>& list = angles.at(static_cast<std::size_t>(key[5] - '0'));
            for (double angle = 0; entry >> angle;) list.push_back(angle);
            CHECK(std::ranges::is_sorted(list));
        }
        CHECK(order == std::string("SOFTWARE DATA_TYPE COLOR_MODEL PARAM_TYPE PARAM0_LIST ") +
                           (isotropic ? "" : "PARAM1_LIST ") +
                           "PARAM2_LIST PARAM3_LIST NAME SOURCE_TYPE ");
        if (isotropic) angles[1] = {0};
        CHECK(angles[3].back() == 360);
        double worst = 0;
        std::size_t rows = 0;
        for (const double pv : angles[3]) {
            for (const double tv : angles[2]) {
                for (const double pl : angles[1]) {
                    for (const double tl : angles[0]) {
                        std::array<double, 3> c{};
                        text >> c[0] >> c[1] >> c[2];
                        REQUIRE_FALSE(text.fail());
                        ++rows;
                        const LightAndView pair = {
                            {radiansFromDegrees(tl), radiansFromDegrees(std::fmod(pl, 360))},
                            {radiansFromDegrees(tv), radiansFromDegrees(std::fmod(pv, 360))}};
                        if (pair.light.theta >= kMax || pair.view.theta >= kMax) continue;
                        const Rgb value =
                            isotropic ? Isotropic().evaluate(pair) : Anisotropic().evaluate(pair);
                        const double f =
                            static_cast<double>(value.g) / (kPi * std::cos(pair.light.theta));
                        worst = std::max(worst, std::abs(c[1] / f - 1));
                    }
                }
            }
        }
        CHECK(worst < 1e-4);
        CHECK(rows == (isotropic ? 17U * 17 * 73 : 6U * 25 * 17 * 25));
        text >> line;
        CHECK(text.fail());
    }
}

TEST_CASE("what is past the range of a format's floats is refused, and leaves no file") {
    struct Huge : BrdfTable {
        Rgb evaluate(const LightAndView&) const override { return {3e38F, 3e38F, 3e38F}; }
    };
    const TemporaryFolder folder;
    for (const char* format : {"rgl", "radiance", "astm", "ssdd"}) {
        CHECK_THROWS_AS(write(format, folder.path() / "x", Huge()), std::runtime_error);
        CHECK(fs::is_empty(folder.path()));
    }
}

TEST_CASE("a format that is not there is refused with the list of those that are") {
    try {
        exportFormatFromName("png");
        FAIL("it passed");
    } catch (const std::invalid_argument& error) {
        CHECK(std::string(error.what()).find("utia-bin utia-exr merl rgl radiance astm ssdd") !=
              std::string::npos);
    }
}

TEST_CASE("an export that finds the disk full leaves the old file as it was") {
    const TemporaryFolder folder;
    for (const char* format : {"utia-bin", "utia-exr", "rgl", "radiance", "astm", "ssdd"}) {
        const fs::path path = folder.path() / "old";
        writeFile(path, "old");
        bool failed = false;
        {
            const FileSizeLimit limit(4096);
            try {
                write(format, path, Anisotropic());
            } catch (const std::runtime_error&) {
                failed = true;
            }
        }
        CHECK(failed);
        CHECK(bytesOf(path) == "old");
    }
}

TEST_SUITE_END();
