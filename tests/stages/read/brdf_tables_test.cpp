// SPDX-License-Identifier: BSD-3-Clause
//
// The readers of tabulated BRDFs: MERL, UTIA, RGL, MBSDF.
#include "abrdf/merl_table.h"
#include "stages/read/btf_reader.h"
#include "tests/support/reader_faults.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A UTIA .bin of value(pair, channel).
template <typename Value>
std::string utiaBytes(const Value& value) {
    const AngularGrid grid(regularDirections(6, 48));
    ByteWriter out;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < grid.pairCount(); ++i) out.put(double{value(grid.pair(i), c)});
    }
    return out.bytes();
}

double lambertian(const LightAndView& pair, std::size_t channel) {
    return std::cos(pair.light.theta) * static_cast<double>(channel + 1) / 4;
}

/// A MERL file of value(entry, channel), already divided by the scales.
template <typename Value>
std::string merlBytes(const Value& value) {
    ByteWriter out;
    out.put(90).put(90).put(180);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < merl::kEntries; ++i) out.put(double{value(i, c)});
    }
    return out.bytes();
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a MERL table is exact at the middle of its entries, and NaN where it has no data") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.binary";
    writeFile(path, merlBytes([](std::size_t i, std::size_t c) {
                  return i == 0 ? -1.0 : static_cast<double>(i % 1009 + 500 * c);
              }));
    const auto reader = openBtf(path);
    CHECK(reader->description().format == "MERL");
    CHECK(reader->description().grid == AngularGrid(ubo81Directions()));
    REQUIRE(reader->table() != nullptr);
    for (std::size_t i = 90 * 180 + 7; i < merl::kEntries; i += 7919) {
        const LightAndView pair = pairFromHalfAngles(merl::anglesOfEntry(i));
        if (pair.light.theta > 1.5 || pair.view.theta > 1.5) continue;
        CAPTURE(i);
        const double factor = kPi * std::cos(pair.light.theta);
        const Rgb value = reader->table()->evaluate(pair);
        CHECK(value.r == doctest::Approx(factor * static_cast<double>(i % 1009) / 1500));
        CHECK(value.b ==
              doctest::Approx(factor * 1.66 * static_cast<double>(i % 1009 + 1000) / 1500));
    }
    CHECK(std::isnan(reader->table()->evaluate(pairFromHalfAngles(merl::anglesOfEntry(0))).r));
}

TEST_CASE("MERL files that lie, are cut, big-endian or too long are refused by name") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.binary";
    const auto fault = [&](const std::string& bytes) {
        writeFile(path, bytes);
        return readFault(path);
    };
    const std::string zeros(24 * merl::kEntries, '\0');
    const std::string sizes = ByteWriter().put(90).put(90).put(180).bytes();
    CHECK(fault(sizes + zeros).empty());
    CHECK(fault(sizes + zeros + "x").find("1 bytes follow") != std::string::npos);
    CHECK(fault(sizes + zeros.substr(1)).find("m.binary") != std::string::npos);
    CHECK(fault(sizes).find("m.binary") != std::string::npos);
    CHECK(fault(ByteWriter().put(-90).put(90).put(180).bytes() + zeros).find("-90 x 90") !=
          std::string::npos);
    CHECK(fault(ByteWriter().put(1 << 30).put(1 << 30).put(1 << 30).bytes()).find("1073741824") !=
          std::string::npos);
    const std::string swapped("\0\0\0\x5a\0\0\0\x5a\0\0\0\xb4", 12);
    CHECK(fault(swapped + zeros).find("big-endian") != std::string::npos);
}

TEST_CASE("a UTIA .bin is exact at its directions, its cosine is told from its reciprocity") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "u.bin";
    writeFile(path, utiaBytes(lambertian));
    auto reader = openBtf(path);
    CHECK(reader->description().format == "UTIA BRDF .bin");
    CHECK(reader->description().grid == AngularGrid(regularDirections(6, 48)));
    CHECK(reader->description().cosine == Cosine::kKept);
    CHECK(reader->description().cosineFrom.starts_with("guess from the data"));
    for (std::size_t i = 0; i < reader->description().grid.pairCount(); i += 997) {
        const LightAndView pair = reader->description().grid.pair(i);
        CHECK(reader->table()->evaluate(pair).b == static_cast<float>(lambertian(pair, 2)));
    }
    writeFile(path, utiaBytes([](const LightAndView& p, std::size_t) {
                  return 1 + std::cos(p.light.phi - p.view.phi) / 2;
              }));
    CHECK(openBtf(path)->description().cosine == Cosine::kAbsent);
}

TEST_CASE("a UTIA .bin's encoding is chosen, or guessed from its numbers") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "u.bin";
    const auto value = [&](std::optional<UtiaEncoding> encoding) {
        ReadOptions options;
        options.utiaEncoding = encoding;
        return openBtf(path, options)->table()->evaluate({}).g;
    };
    writeFile(path, utiaBytes([](const LightAndView&, std::size_t) { return 0.5; }));
    CHECK(value({}) == 0.5F);
    CHECK(value(UtiaEncoding::kSrgb) == doctest::Approx(0.214041));
    writeFile(path, utiaBytes([](const LightAndView&, std::size_t) { return 70.0; }));
    CHECK(value({}) == doctest::Approx(0.214041));
    CHECK(value(UtiaEncoding::kSrgb140) == doctest::Approx(0.214041));
    CHECK(value(UtiaEncoding::kLinear) == 70);
    writeFile(path,
              utiaBytes([](const LightAndView&, std::size_t c) { return c == 1 ? -0.25 : 1.0; }));
    CHECK(value({}) == 0);
    CHECK(openBtf(path)->description().notes.back().find("82944 numbers below 0") !=
          std::string::npos);
}

TEST_CASE("a .bin that is no UTIA BRDF is refused with the reason") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "u.bin";
    const std::string whole = utiaBytes(lambertian);
    writeFile(path, whole.substr(0, whole.size() - 8));
    CHECK(readFault(path).find("1990648 bytes") != std::string::npos);
    std::string swapped = whole;
    for (std::size_t i = 0; i < swapped.size(); i += 8) {
        std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(i),
                     swapped.begin() + static_cast<std::ptrdiff_t>(i + 8));
    }
    writeFile(path, swapped);
    CHECK(readFault(path).find("big-endian") != std::string::npos);
    writeFile(path, std::string(1000, 'x'));
    CHECK(readFault(path).find("is not a database") != std::string::npos);
}

TEST_CASE("an RGL file: with and without the jacobian, f is what its tables say") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "r.bsdf";
    SmallRgl rgl;
    const LightAndView pair = {{0.3, 1}, {0.5, 2}};
    writeFile(path, rglBytes(rgl));
    CHECK(openBtf(path)->description().format == "RGL");
    CHECK(openBtf(path)->table()->evaluate(pair).g == doctest::Approx(kPi * 0.5));
    rgl.jacobian = true;
    writeFile(path, rglBytes(rgl));
    CHECK(openBtf(path)->table()->evaluate(pair).b == doctest::Approx(kPi * 0.75 * 2 / (4 * 0.5)));
    CHECK(openBtf(path)->description().maxMeasuredTheta == doctest::Approx(1.5));
}

TEST_CASE("an anisotropic RGL file is looked up by the azimuth of the view, by its symmetry") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "r.bsdf";
    SmallRgl rgl;
    rgl.redStep = 1;
    const auto redAt = [&](double phi) {
        return static_cast<double>(openBtf(path)->table()->evaluate({{0.3, 1}, {0.5, phi}}).r) /
               kPi;
    };
    const auto pi = static_cast<float>(kPi);
    rgl.phiIn = {-pi, 0, pi};
    writeFile(path, rglBytes(rgl));
    CHECK(redAt(0) == doctest::Approx(1.25));
    CHECK(redAt(kPi / 2) == doctest::Approx(1.75));
    CHECK(redAt(-kPi / 2) == doctest::Approx(0.75));
    rgl.phiIn = {-pi, -pi / 2, 0};  // Half of them: a turn by pi changes nothing.
    writeFile(path, rglBytes(rgl));
    CHECK(redAt(-0.75 * kPi) == doctest::Approx(0.75));
    CHECK(redAt(0.25 * kPi) == doctest::Approx(0.75));
    rgl.phiIn = {-pi, -0.75F * pi, -pi / 2};  // A quarter: mirrored in both axes.
    writeFile(path, rglBytes(rgl));
    CHECK(redAt(-0.625 * kPi) == doctest::Approx(1.75));
    CHECK(redAt(0.625 * kPi) == doctest::Approx(1.75));
    CHECK(redAt(-0.375 * kPi) == doctest::Approx(1.75));
}

TEST_CASE("an MBSDF is linear between its cells' middles, and mirrored in the azimuth") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "m.mbsdf";
    writeFile(path, mbsdfBytes(4, 6));
    const auto reader = openBtf(path);
    CHECK(reader->description().format == "NVIDIA MBSDF");
    const double cell = kPi / 8;
    const Direction light = {1.2 * cell, 5};
    const double factor = kPi * std::cos(light.theta);
    for (const double sign : {-1.0, 1.0}) {
        const Rgb c = reader->table()->evaluate({light, {2.75 * cell, 5 + sign * 2.9 * kPi / 6}});
        CHECK(c.r == doctest::Approx(factor * 1.7));
        CHECK(c.g == doctest::Approx(factor * 3.25));
        CHECK(c.b == doctest::Approx(factor * 3.4));
    }
    writeFile(path, mbsdfBytes(4, 6, 0));
    CHECK(openBtf(path)->table()->evaluate({light, {0.5, 1}}).b == doctest::Approx(factor * 1.7));
}

TEST_CASE("tables that were cut or whose headers lie are sentences that name them") {
    const TemporaryFolder folder;
    checkEveryCut(folder.path() / "r.bsdf", rglBytes({}));
    checkEveryCut(folder.path() / "m.mbsdf", mbsdfBytes(4, 6));
    std::string lie = mbsdfBytes(4, 6);
    lie.replace(47, 8, std::string(8, '\x7f'));
    writeFile(folder.path() / "m.mbsdf", lie);
    CHECK(readFault(folder.path() / "m.mbsdf").find("declares") != std::string::npos);
    lie = rglBytes({});
    lie.replace(lie.find("vndf") + 4 + 3 + 8, 8, std::string(8, '\x7f'));
    writeFile(folder.path() / "r.bsdf", lie);
    CHECK(readFault(folder.path() / "r.bsdf").find("r.bsdf") != std::string::npos);
}

TEST_CASE("the measured materials beside the checkout agree with the tables made of them") {
    const fs::path data = ABRDF_SHARED_DATA;
    if (!fs::exists(data / "rgl")) {
        MESSAGE("skipped: ../shared/data/rgl is absent");
        return;
    }
    std::vector<std::pair<fs::path, std::string>> files = {
        {data / "mbsdf/carpaint_red.mbsdf", "mbsdf_carpaint_red"}};
    for (const auto& entry : fs::directory_iterator(data / "rgl")) {
        const std::string stem = entry.path().stem().string();
        files.emplace_back(entry.path(), "rgl_" + stem.substr(0, stem.rfind("_rgb")));
    }
    for (const auto& [file, name] : files) {
        const std::string path = file.string();  // clang 14's lambdas cannot take a binding.
        CAPTURE(path);
        const std::vector<Rgb> truth = sharedTable("measured81/" + name + "_f32.bin");
        REQUIRE(truth.size() == 6561);
        const auto reader = openBtf(file);
        std::vector<double> errors;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const LightAndView pair = reader->description().grid.pair(i);
            // Where one of the three is the normal, or the half vector lies half a turn from the
            // view, the place in the table is anybody's choice.
            const Imath::V3d sum = vectorFromDirection(pair.light) + vectorFromDirection(pair.view);
            if (pair.light.theta == 0 || pair.view.theta == 0) continue;
            if (std::hypot(sum.x, sum.y) < 1e-6) continue;
            if (std::cos(std::atan2(sum.y, sum.x) - pair.view.phi) < -1 + 1e-9) continue;
            const auto g = static_cast<double>(reader->table()->evaluate(pair).g);
            const auto t = static_cast<double>(truth[i].g);
            errors.push_back(std::abs(g - t) / (t + 1e-5));
        }
        std::ranges::sort(errors);
        CHECK(errors[errors.size() / 2] < 3e-6);
        CHECK(errors.back() < 1e-3);  // They were made in single precision.
    }
}

TEST_SUITE_END();
