// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/demo/demo_database.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace abrdf {

namespace {

namespace fs = std::filesystem;

/// A folder of this test's own, gone with it.
class Scratch {
  public:
    Scratch() : path_(fs::temp_directory_path() / ("abrdf-demo-test-" + std::to_string(getpid()))) {
        fs::remove_all(path_);
        fs::create_directory(path_);
    }
    ~Scratch() { fs::remove_all(path_); }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    fs::path operator/(const char* name) const { return path_ / name; }
    bool isEmpty() const { return fs::is_empty(path_); }

  private:
    fs::path path_;
};

constexpr DemoOptions kTiny{.size = 4, .seed = 1, .hdr = false};

std::string bytesOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> filesBelow(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            names.push_back(entry.path().lexically_relative(folder).string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// Pixels as floats; empty where the file is no image of 4 x 4 x 3.
std::vector<float> pixelsOf(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input || input->spec().width != 4 || input->spec().nchannels != 3) return {};
    std::vector<float> pixels(4 * 4 * 3);
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data())) return {};
    return pixels;
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("the demo database has UBO2003's folders and names") {
        const Scratch scratch;
        std::atomic<std::size_t> ticks = 0;
        writeDemoDatabase(scratch / "cloth", kTiny, [&](const ProgressTick& tick) {
            ticks += tick.phase == "render" && tick.unit == "images" && tick.total == 6561 ? 1 : 0;
        });
        CHECK(ticks == 6561);
        const std::vector<std::string> names = filesBelow(scratch / "cloth");
        REQUIRE(names.size() == 6561);
        CHECK(names.front() == "tv000_pv000/00000 tl000 pl000 tv000 pv000.jpg");
        CHECK(names.back() == "tv075_pv345/06560 tl075 pl345 tv075 pv345.jpg");
        CHECK(fs::exists(scratch / "cloth/tv030_pv090/00658 tl030 pl030 tv030 pv090.jpg"));
        CHECK(pixelsOf(scratch / "cloth" / names.front()).size() == 48);
        // Only the database is there, nothing temporary.
        CHECK(std::distance(fs::directory_iterator(scratch / "."), fs::directory_iterator()) == 1);

        SUBCASE("and a folder that is not empty is left alone") {
            CHECK_THROWS_WITH_AS(writeDemoDatabase(scratch / "cloth", kTiny, {}),
                                 doctest::Contains("not empty"), std::runtime_error);
            CHECK(filesBelow(scratch / "cloth") == names);
        }
    }

    TEST_CASE("the same seed makes the same zip, another seed another one") {
        const Scratch scratch;
        DemoOptions other = kTiny;
        other.seed = 2;
        writeDemoDatabase(scratch / "a.zip", kTiny, {});
        writeDemoDatabase(scratch / "b.zip", other, {});
        const std::string first = bytesOf(scratch / "a.zip");
        CHECK(first != bytesOf(scratch / "b.zip"));
        // The second time replaces what is there.
        writeDemoDatabase(scratch / "b.zip", kTiny, {});
        CHECK(first == bytesOf(scratch / "b.zip"));

        zip_t* archive = zip_open((scratch / "a.zip").c_str(), ZIP_RDONLY, nullptr);
        REQUIRE(archive != nullptr);
        CHECK(zip_get_num_entries(archive, 0) == 6561);
        zip_stat_t entry;
        REQUIRE(zip_stat_index(archive, 6560, 0, &entry) == 0);
        CHECK(std::string(entry.name) == "tv075_pv345/06560 tl075 pl345 tv075 pv345.jpg");
        CHECK(entry.comp_method == ZIP_CM_STORE);
        zip_discard(archive);
    }

    TEST_CASE("the HDR database keeps highlights past 1, and states its colour space") {
        const Scratch scratch;
        DemoOptions hdr = kTiny;
        hdr.hdr = true;
        fs::create_directory(scratch / "empty");
        writeDemoDatabase(scratch / "empty", hdr, {});
        REQUIRE(filesBelow(scratch / "empty").size() == 6561);

        const fs::path mirror = scratch / "empty/tv075_pv180/04686 tl075 pl000 tv075 pv180.exr";
        const std::vector<float> pixels = pixelsOf(mirror);
        REQUIRE(pixels.size() == 48);
        CHECK(*std::max_element(pixels.begin(), pixels.end()) > 2);
        const auto input = OIIO::ImageInput::open(mirror.string());
        CHECK(input->spec().format == OIIO::TypeDesc::HALF);
        CHECK(input->spec().get_string_attribute("colorInteropID") == "lin_rec709_scene");
        CHECK(input->spec().get_string_attribute("DateTime") == "2020:01:01 00:00:00");
    }

    TEST_CASE("wrong options and targets are told, and leave nothing behind") {
        const Scratch scratch;
        DemoOptions wrong = kTiny;
        wrong.size = 0;
        CHECK_THROWS_AS(writeDemoDatabase(scratch / "cloth", wrong, {}), std::invalid_argument);
        CHECK_THROWS_WITH_AS(writeDemoDatabase(scratch / "no/cloth", kTiny, {}),
                             doctest::Contains("does not exist"), std::runtime_error);
        CHECK_THROWS_WITH_AS(writeDemoDatabase(scratch / "no/cloth.zip", kTiny, {}),
                             doctest::Contains("does not exist"), std::runtime_error);
        CHECK(scratch.isEmpty());
    }

    TEST_CASE("what is thrown on the way leaves nothing behind") {
        const Scratch scratch;
        const ProgressSink fails = [](const ProgressTick& tick) {
            if (tick.done == 100) throw std::runtime_error("no more");
        };
        for (const char* name : {"cloth", "cloth.zip"}) {
            CHECK_THROWS_WITH_AS(writeDemoDatabase(scratch / name, kTiny, fails), "no more",
                                 std::runtime_error);
            CHECK(scratch.isEmpty());
        }
    }
}

}  // namespace abrdf
