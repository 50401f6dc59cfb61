// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/btf_reader.h"
#include "stages/read/file_source.h"
#include "tests/support/fault_of.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

SyntheticBtf smallBtf(const std::string& extension) {
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(2, 3), regularDirections(3, 2));
    btf.width = 4;
    btf.height = 2;
    btf.extension = extension;
    btf.value = [](const LightAndView& p, int x, int y) {
        return Rgb{static_cast<float>(p.light.theta) / 2, static_cast<float>(x) / 8,
                   static_cast<float>(y) / 8};
    };
    return btf;
}

/// What opening and reading all images says; empty where nothing is wrong.
std::string faultOf(const fs::path& path) {
    return abrdf::faultOf([&] {
        const auto reader = openBtf(path);
        for (std::size_t pair = 0; pair < reader->description().present.size(); ++pair) {
            if (reader->description().present[pair] != 0) reader->read(pair);
        }
    });
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a stack is read back, whatever the images' format") {
    for (const char* extension : {"exr", "png", "jpg"}) {
        const TemporaryFolder folder;
        const SyntheticBtf btf = smallBtf(extension);
        writeSyntheticBtf(folder.path(), btf);
        std::ofstream(folder.path() / "README.txt") << "tl0 pl0 tv0 pv0";
        const auto reader = openBtf(folder.path());
        const BtfDescription& d = reader->description();
        CHECK(d.format == "UBO2003");
        CHECK(d.width == 4);
        CHECK(d.height == 2);
        // The pole stands once for each azimuth of these regular grids, as names say.
        CHECK(d.grid.pairCount() == btf.grid.pairCount());
        CHECK(d.missingPairs().empty());
        CHECK(d.colorSpace ==
              (std::string(extension) == "exr" ? "Linear Rec.709 (sRGB)" : "sRGB - Texture"));
        const EncodedImage image = reader->read(d.grid.pairCount() - 1);
        if (const auto* values = std::get_if<std::vector<float>>(&image.rgb)) {
            CHECK((*values)[1 + 3 * 3] == doctest::Approx(3.0 / 8));
        } else {
            CHECK(std::get<std::vector<std::uint8_t>>(image.rgb).size() == 24);
        }
    }
}

TEST_CASE("faults are sentences that name the file") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = smallBtf("jpg");
    writeSyntheticBtf(folder.path(), btf);
    const fs::path file = folder.path() / syntheticFile(btf, 20);
    const std::string whole = bytesOf(file);
    CHECK(faultOf(folder.path()).empty());

    std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() / 2);
    CHECK(contains(faultOf(folder.path()), file.filename().string() + ": is not a whole image"));
    std::ofstream(file, std::ios::binary) << "";
    CHECK(contains(faultOf(folder.path()), file.filename().string()));

    const TemporaryFolder other;
    SyntheticBtf larger = btf;
    larger.width = 5;
    writeSyntheticBtf(other.path(), larger);
    fs::copy_file(other.path() / syntheticFile(btf, 20), file,
                  fs::copy_options::overwrite_existing);
    CHECK(contains(faultOf(folder.path()), "is 5 x 2 pixels"));

    std::ofstream(file, std::ios::binary) << whole;
    fs::copy_file(file, folder.path() / "tl195 pl0 tv0 pv0.jpg");
    CHECK(contains(faultOf(folder.path()), "tl195 pl0 tv0 pv0.jpg"));
    CHECK(contains(faultOf(folder.path()), "above the surface"));
    CHECK(contains(faultOf(folder.path() / "nothing"), "there is no such"));
    CHECK(contains(faultOf(file), "is not a database"));
}

TEST_CASE("images from below the horizon are counted and left out") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = smallBtf("jpg");
    writeSyntheticBtf(folder.path(), btf);
    const fs::path file = folder.path() / syntheticFile(btf, 20);
    fs::copy_file(file, folder.path() / "tl95 pl0 tv0 pv0.jpg");
    fs::copy_file(file, folder.path() / "tl30 pl0 tv90 pv0.jpg");
    const auto reader = openBtf(folder.path());
    CHECK(reader->description().belowHorizon == 2);
    CHECK(reader->description().grid.pairCount() == btf.grid.pairCount());
}

TEST_CASE("missing and double images are found") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = smallBtf("png");
    writeSyntheticBtf(folder.path(), btf);
    const fs::path file = folder.path() / syntheticFile(btf, 20);
    fs::copy_file(file, file.string() + ".again " + file.filename().string());
    CHECK(openBtf(folder.path())->description().duplicates.size() == 1);
    fs::remove(file.string() + ".again " + file.filename().string());
    fs::remove(file);
    CHECK(openBtf(folder.path())->description().missingPairs() == std::vector<std::size_t>{20});
}

TEST_CASE("the real view of UBO2003 has its 81 lights") {
    const fs::path real = fs::path(ABRDF_SHARED_DATA) / "ubo2003";
    if (!fs::exists(real)) {
        MESSAGE("skipped: ../shared/data/ubo2003 is absent");
        return;
    }
    const auto reader = openBtf(real);
    CHECK(reader->description().grid.lights().size() == 81);
    CHECK(reader->description().grid.views().size() == 1);
    for (std::size_t i = 0; i < 81; ++i) {
        CHECK(angleBetween(reader->description().grid.lights()[i], ubo81Directions()[i]) < 1e-9);
    }
    CHECK(reader->read(40).width == 256);
}

TEST_SUITE_END();
