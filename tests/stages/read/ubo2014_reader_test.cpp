// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/btf_reader.h"
#include "tests/support/reader_faults.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

std::unique_ptr<BtfReader> opened(const TemporaryFolder& folder, const SmallBtf& btf) {
    writeFile(folder.path() / "small.btf", btfBytes(btf));
    return openBtf(folder.path() / "small.btf");
}

float valueAt(const BtfReader& reader, std::size_t light, std::size_t view, std::size_t texel,
              std::size_t channel) {
    const BtfDescription& d = reader.description();
    const EncodedImage image = reader.read(d.grid.pairIndex(light, view));
    return std::get<std::vector<float>>(image.rgb)[3 * texel + channel];
}

/// Sum over two components of a row of pairs and one of texels.
double product(std::size_t pairRow, std::size_t texelRow) {
    return pairFactor(pairRow, 0) * texelFactor(texelRow, 0) +
           pairFactor(pairRow, 1) * texelFactor(texelRow, 1);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a DFMF is what its factors say, in either form and any scalar size") {
    const TemporaryFolder folder;
    for (const unsigned bytes : {2U, 4U, 8U}) {
        for (const bool images : {false, true}) {
            SmallBtf btf;
            btf.scalarBytes = bytes;
            btf.imagesAsColumns = images;
            btf.rotations = 1;
            const auto reader = opened(folder, btf);
            const BtfDescription& d = reader->description();
            CHECK(d.format == "UBO2014");
            CHECK(d.width == 3);
            CHECK(d.height == 2);
            CHECK(d.cosine == Cosine::kKept);
            CHECK(d.cosineFrom == "header");
            CHECK(d.grid.lights().size() == 6);
            CHECK(angleBetween(d.grid.lights()[5], regularDirections(2, 3)[5]) < 1e-6);
            // Light 4 of view 3, texel (2, 1).
            CHECK(valueAt(*reader, 4, 3, 5, 1) ==
                  doctest::Approx(product(4 + 6 * 3, 5)).epsilon(1e-6));
        }
    }
}

TEST_CASE("colours are decoded by the model, nothing is cut at 1, and the cosine flag is heeded") {
    const TemporaryFolder folder;
    SmallBtf btf;
    btf.cosineFlag = 0;
    const double v = product(2, 1);
    const auto at = [&](std::int32_t model, std::size_t channel) {
        btf.colorModel = model;
        const auto reader = opened(folder, btf);
        CHECK(reader->description().cosine == Cosine::kAbsent);
        return doctest::Approx(valueAt(*reader, 2, 0, 1, channel)).epsilon(1e-5);
    };
    CHECK(v == at(0, 2));
    CHECK(v + 1.13983 * v == at(1, 0));
    CHECK(v + v - v == at(4, 0));
    CHECK(std::exp(v) - 1e-5 == at(12, 1));
    CHECK(std::exp(v) - 1e-5 > 1);
    CHECK(std::exp(v) - 1e-5 + 2.03211 * v * std::exp(v) == at(11, 2));
    CHECK(std::exp(v) - 1e-5 + 1.13983 * v == at(9, 0));
    CHECK(std::exp(v) - 1e-5 + 1.13983e-5 * std::exp(v) == at(10, 0));
    btf.mean = {1, 2, 3};
    btf.matrix = {1, 0, 0, 0, 1, 0, 2, 0, 1};
    CHECK(1 + v + 2 * v == at(3, 0));
}

TEST_CASE("an FMF interleaves its channels, and may hold logarithms") {
    const TemporaryFolder folder;
    for (const bool images : {false, true}) {
        SmallBtf btf;
        btf.signature = "!FMF12FCER";
        btf.imagesAsColumns = images;
        const std::size_t a = 4 + 6 * 3;
        const double expected = images ? product(a, 2 + 3 * 5) : product(2 + 3 * a, 5);
        CHECK(valueAt(*opened(folder, btf), 4, 3, 5, 2) == doctest::Approx(expected));
        btf.logarithm = 1;
        CHECK(valueAt(*opened(folder, btf), 4, 3, 5, 2) ==
              doctest::Approx(std::exp(expected) - 1e-5));
        btf.signature = "!FMF06FC";
        CHECK(valueAt(*opened(folder, btf), 4, 3, 5, 2) == doctest::Approx(expected));
    }
}

TEST_CASE("a PVF adds the mean of its view") {
    const TemporaryFolder folder;
    for (const bool images : {false, true}) {
        SmallBtf btf;
        btf.signature = "!PVF06FCR";
        btf.width = 4;  // Not as many texels as lights, so that the form shows.
        btf.imagesAsColumns = images;
        // Component row c + 3 l and weight row t; or component row c + 3 t and weight row l.
        const double expected = 2 + (images ? product(1 + 3 * 5, 4) : product(1 + 3 * 4, 5));
        CHECK(valueAt(*opened(folder, btf), 4, 2, 5, 1) == doctest::Approx(expected));
    }
}

TEST_CASE("a BDI is read to the bit, and what its mask leaves out is no data") {
    const TemporaryFolder folder;
    SmallBtf btf;
    btf.signature = "!BDIF06R2!";
    const std::size_t a = 4 + 6 * 3;
    CHECK(valueAt(*opened(folder, btf), 4, 3, 5, 1) == static_cast<float>(pairFactor(a, 1) + 5));
    btf.mask = {1, 0, 1, 1, 0, 1};
    const auto masked = opened(folder, btf);
    CHECK(valueAt(*masked, 4, 3, 5, 1) == static_cast<float>(pairFactor(a, 1) + 3));
    CHECK(std::isnan(valueAt(*masked, 4, 3, 1, 1)));
}

TEST_CASE("directions below the horizon are left out") {
    const TemporaryFolder folder;
    SmallBtf btf;
    btf.lights[2] = {2, 0};
    const auto reader = opened(folder, btf);
    CHECK(reader->description().belowHorizon == 4);
    CHECK(reader->description().grid.lights().size() == 5);
    CHECK(valueAt(*reader, 2, 1, 0, 0) == doctest::Approx(product(3 + 6, 0)));
}

TEST_CASE("a .btf that was cut anywhere or lies is a sentence that names it") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "small.btf";
    for (const char* signature : {"!DFMF08FCR", "!FMF12FCER", "!PVF06FCR", "!BDIF06R2!"}) {
        SmallBtf btf;
        btf.signature = signature;
        checkEveryCut(path, btfBytes(btf));
    }
    SmallBtf huge;
    huge.width = 0xffffffff;
    huge.height = 0xffffffff;
    writeFile(path, btfBytes(SmallBtf()));
    CHECK(readFault(path).empty());
    std::string lie = btfBytes(SmallBtf());
    const std::size_t size = lie.find(std::string("\3\0\0\0\2\0\0\0", 8));
    for (const std::size_t place : {size, size + 4}) {
        std::string bytes = lie;
        bytes.replace(place, 4, std::string("\xff\xff\xff\x7f", 4));
        writeFile(path, bytes);
        CHECK(readFault(path).find("small.btf") != std::string::npos);
    }
    writeFile(path, "!DFMF99FCR" + btfBytes(SmallBtf()).substr(10));
    CHECK(readFault(path).find("signature") != std::string::npos);
    SmallBtf spectral;
    spectral.colorModel = 6;
    writeFile(path, btfBytes(spectral));
    CHECK(readFault(path).find("colour model 6") != std::string::npos);
}

TEST_CASE("files written by the database's own library agree with what it decodes") {
    const fs::path data = fs::path(ABRDF_SHARED_DATA) / "ubo2014";
    if (!fs::exists(data)) {
        MESSAGE("skipped: ../shared/data/ubo2014 is absent");
        return;
    }
    const std::string bytes = bytesOf(data / "woven_truth_f32.bin");
    std::vector<float> truth(bytes.size() / sizeof(float));
    std::memcpy(truth.data(), bytes.data(), bytes.size());
    const std::vector<const char*> names = {"woven_dfmf",     "woven_fmf",     "woven_bdi",
                                            "woven_dfmf_rot", "woven_fmf_f32", "woven_pvf"};
    std::vector<std::unique_ptr<BtfReader>> readers;
    for (const char* name : names) readers.push_back(openBtf(data / fmt::format("{}.btf", name)));
    for (std::size_t row = 0; row + 8 <= truth.size(); row += 8) {
        const auto number = [&](std::size_t i) { return static_cast<std::size_t>(truth[row + i]); };
        const BtfReader& reader = *readers[number(0)];
        CAPTURE(names[number(0)]);
        CHECK(reader.description().cosine == Cosine::kKept);
        CHECK(reader.description().grid.pairCount() == 151U * 151U);
        const std::size_t texel =
            number(1) + static_cast<std::size_t>(reader.description().width) * number(2);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(valueAt(reader, number(3), number(4), texel, c) ==
                  doctest::Approx(truth[row + 5 + c]).epsilon(3e-6));
        }
    }
    for (std::size_t i = 0; i < 151; ++i) {
        CHECK(angleBetween(readers[0]->description().grid.views()[i], dome151Directions()[i]) <
              1e-5);
    }
}

TEST_SUITE_END();
