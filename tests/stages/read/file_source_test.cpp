// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/file_source.h"

#include "abrdf/for_each_texel.h"
#include "stages/read/btf_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_zip.h"

#include <doctest/doctest.h>

#include <atomic>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

void writeSomeFiles(const fs::path& folder) {
    fs::create_directories(folder / "b" / "deep");
    std::ofstream(folder / "z.txt") << "last";
    std::ofstream(folder / "b" / "deep" / "x y.bin") << std::string(100000, 'q');
    std::ofstream(folder / "a.txt") << "";
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a folder and its zip, stored or deflated, are the same files") {
    const TemporaryFolder folder;
    writeSomeFiles(folder.path() / "data");
    const FileSource plain(folder.path() / "data");
    CHECK(plain.names() == std::vector<std::string>{"a.txt", "b/deep/x y.bin", "z.txt"});
    for (const bool deflate : {false, true}) {
        const fs::path zip = folder.path() / "data.zip";
        writeZip(zip, folder.path() / "data", deflate);
        CHECK(isZip(zip));
        const FileSource zipped(zip);
        REQUIRE(zipped.names() == plain.names());
        for (std::size_t i = 0; i < plain.names().size(); ++i) {
            CHECK(zipped.read(i) == plain.read(i));
            CHECK((deflate || zipped.sizeOf(i) == plain.sizeOf(i)));
        }
        CHECK(zipped.fullName(2) == zip.string() + ": z.txt");
    }
    CHECK_FALSE(isZip(folder.path() / "data" / "z.txt"));
    CHECK_FALSE(isZip(folder.path() / "data" / "a.txt"));
}

TEST_CASE("a database in a zip is the one in the folder") {
    const TemporaryFolder folder;
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(2, 3), regularDirections(2, 2));
    btf.width = 3;
    btf.height = 2;
    btf.value = [](const LightAndView& p, int x, int y) {
        return Rgb{static_cast<float>(p.light.phi), static_cast<float>(p.view.theta),
                   static_cast<float>(x + 10 * y)};
    };
    writeSyntheticBtf(folder.path() / "btf", btf);
    writeZip(folder.path() / "btf.zip", folder.path() / "btf", true);
    const auto plain = openBtf(folder.path() / "btf");
    const auto zipped = openBtf(folder.path() / "btf.zip");
    CHECK(zipped->description().grid == plain->description().grid);
    CHECK(zipped->description().source == "btf.zip");
    for (std::size_t pair = 0; pair < btf.grid.pairCount(); ++pair) {
        CHECK(zipped->read(pair).rgb == plain->read(pair).rgb);
    }
}

TEST_CASE("a damaged or cut archive is an error that names it") {
    const TemporaryFolder folder;
    writeSomeFiles(folder.path() / "data");
    const fs::path zip = folder.path() / "data.zip";
    writeZip(zip, folder.path() / "data", false);
    const std::string whole = bytesOf(zip);

    std::string damaged = whole;
    damaged[damaged.find("qqqqqqqq") + 5000] = 'X';
    std::ofstream(zip, std::ios::binary) << damaged;
    const FileSource source(zip);
    const std::string fault = faultOf([&] { source.read(1); });
    CHECK(contains(fault, "data.zip"));
    CHECK(contains(fault, "b/deep/x y.bin"));
    CHECK(source.read(2) == std::vector<char>{'l', 'a', 's', 't'});

    std::ofstream(zip, std::ios::binary) << whole.substr(0, whole.size() / 2);
    CHECK(contains(faultOf([&] { FileSource cut(zip); }), "data.zip"));
    std::ofstream(zip, std::ios::binary) << "no archive";
    CHECK(contains(faultOf([&] { FileSource none(zip); }), "data.zip"));
}

TEST_CASE("a file that went away since the listing is an error that names it") {
    const TemporaryFolder folder;
    writeSomeFiles(folder.path());
    const FileSource source(folder.path());
    fs::remove(folder.path() / "z.txt");
    CHECK(contains(faultOf([&] { source.read(2); }), "z.txt"));
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("threads");

TEST_CASE("many threads read one archive at once") {
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "data");
    for (int i = 0; i < 100; ++i) {
        std::ofstream(folder.path() / "data" / std::to_string(1000 + i))
            << std::string(20000, static_cast<char>('a' + i % 26));
    }
    writeZip(folder.path() / "data.zip", folder.path() / "data", true);
    const FileSource source(folder.path() / "data.zip");
    const ThreadLimit limit(7);
    std::atomic<int> wrong = 0;
    forEachImage(1000, [&](std::size_t i) {
        const std::size_t file = i % 100;
        if (source.read(file) != std::vector<char>(20000, static_cast<char>('a' + file % 26))) {
            ++wrong;
        }
    });
    CHECK(wrong == 0);
}

TEST_SUITE_END();
