// SPDX-License-Identifier: BSD-3-Clause
//
// Archives that lie, bombs, names that climb out of a folder, and files that are none.
#include "tests/bad/bad_images.h"
#include "tests/bad/bad_input.h"
#include "tests/bad/zip_bytes.h"
#include "tests/support/synthetic_btf.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

const std::string kName = "tv000_pv000/00001 tl000 pl000 tv000 pv000.png";

ZipMember image() {
    return {kName, blackPng(2)};
}

BadInput archive(const std::string& what, const std::string& bytes, const std::string& says,
                 int status = 1, const std::string& options = "") {
    return {what, [=](const fs::path& folder) { put(folder / "a.zip", bytes); },
            "inspect a.zip " + options, status, says};
}

/// The archive with one member that was changed.
template <typename Change>
std::string changed(const Change& change) {
    ZipMember member = image();
    change(member);
    return zipBytes({member});
}

std::string named(const std::string& name) {
    return changed([&](ZipMember& m) { m.name = name; });
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("bad input: archives") {
    const std::string whole = zipBytes({image()});
    const std::string bomb = zipBytes(
        {{"tv000_pv000/00001 tl000 pl000 tv000 pv000.png", std::string(16 << 20, '\0'), true}});
    std::string damaged = whole;
    damaged[60 + kName.size()] ^= 1;
    checkBadInputs({
        archive("a good one, for comparison", whole, "complete +true", 0),
        archive("an empty file", "", "is not a database"),
        archive("the end of an empty archive alone", zipBytes({}), "is not a database"),
        archive("a directory that is cut off", whole.substr(0, whole.size() - 30),
                "is not a readable zip archive.*fetch it again"),
        archive("the first bytes alone", whole.substr(0, 40), "is not a readable zip archive"),
        archive("a member that unpacks to 16 MB of 16 kB, and 1 MB is allowed", bomb,
                "too large for an image: 16777216 bytes, and 1048576 are allowed", 1,
                "--max-file-size 1M"),
        archive("a member that claims 4 GB",
                changed([](ZipMember& m) { m.claimedSize = 0xfffffff0; }),
                "too large for an image: 4294967280 bytes.*--max-file-size"),
        archive("a member that claims a gigabyte and holds a hundred bytes",
                changed([](ZipMember& m) { m.claimedSize = 1U << 30; }), "cut or damaged"),
        archive("a member that claims less than it holds",
                changed([](ZipMember& m) { m.claimedSize = 9; }), "cut or damaged there"),
        archive("a checksum that is wrong", changed([](ZipMember& m) { m.claimedCrc = 1; }),
                "cut or damaged there; fetch it again"),
        archive("a byte that is wrong", damaged, "cut or damaged there"),
        archive("an encrypted member", changed([](ZipMember& m) { m.flags = 1; }),
                "cannot be read: No password provided"),
        archive("a method of packing that nobody knows",
                changed([](ZipMember& m) { m.method = 77; }), "cannot be read"),
        archive("an archive in the archive", zipBytes({{"inner.zip", whole}}), "is not a database"),
        archive("no image in it", zipBytes({{"readme.txt", "hello"}}), "is not a database"),
        archive("a member of nothing", changed([](ZipMember& m) { m.bytes.clear(); }), "is empty"),
        archive("the same member twice", zipBytes({image(), image()}), "duplicate +1"),
        archive("two members for one pair",
                zipBytes({image(), {"b/2 tl000 pl000 tv000 pv000.png", blackPng(2)}}),
                "duplicate +1"),
        archive("images of two sizes",
                zipBytes({image(), {"b/2 tl015 pl000 tv000 pv000.png", blackPng(3)}}),
                "is 3 x 3 pixels, the database's first image 2 x 2; all must have one size"),
    });
}

TEST_CASE("bad input: names of members climb out of nothing, for nothing is unpacked") {
    checkBadInputs({
        archive("../../", named("../../" + kName), "complete +true", 0),
        archive("an absolute path", named("/tmp/" + kName), "complete +true", 0),
        archive("a drive and backslashes", named("C:\\x\\tl000 pl000 tv000 pv000.png"),
                "complete +true", 0),
        archive("a folder with an image's name", named("tl000 pl000 tv000 pv000.png/"),
                "is not a database"),
        archive("a new line and an escape sequence in the name of a text",
                changed([](ZipMember& m) {
                    m.name = "x\n\x1b[31m/tl000 pl000 tv000 pv000.png";
                    m.bytes = "text";
                }),
                "31m/tl000.*not a whole image"),
    });
}

TEST_CASE("bad input: what is no file") {
    checkBadInputs({
        {"nothing", [](const fs::path&) {}, "inspect a.zip", 1, "there is no such file or folder"},
        {"an empty name", [](const fs::path&) {}, "inspect ''", 1, "there is no such file"},
        {"a name of 5000 characters", [](const fs::path&) {}, "inspect " + std::string(5000, 'a'),
         1, "cannot be opened: File name too long"},
        {"an empty folder", [](const fs::path& f) { fs::create_directory(f / "a"); }, "inspect a",
         1, "is not a database"},
        {"a folder that is called a.zip",
         [](const fs::path& f) { fs::create_directory(f / "a.zip"); }, "inspect a.zip", 1,
         "is not a database"},
        {"a folder in place of an image",
         [](const fs::path& f) { fs::create_directories(f / stackImage("jpg")); }, "inspect stack",
         1, "is not a database"},
        {"a pipe that nobody fills", [](const fs::path& f) { mkfifo((f / "a.zip").c_str(), 0600); },
         "inspect a.zip", 1, "neither a file nor a folder"},
        {"a device without an end", [](const fs::path&) {}, "inspect /dev/zero", 1,
         "neither a file nor a folder"},
        {"a link to nothing", [](const fs::path& f) { fs::create_symlink("nowhere", f / "a.zip"); },
         "inspect a.zip", 1, "there is no such file"},
        {"a link to itself", [](const fs::path& f) { fs::create_symlink("a.zip", f / "a.zip"); },
         "inspect a.zip", 1, "a.zip: cannot be opened: Too many levels of symbolic links"},
        {"an image that is a link to nothing",
         [](const fs::path& f) {
             fs::create_directories((f / stackImage("jpg")).parent_path());
             fs::create_symlink("nowhere", f / stackImage("jpg"));
         },
         "inspect stack", 1, "is not a database"},
        {"a folder that holds a link to itself",
         [](const fs::path& f) {
             put(f / stackImage("png"), blackPng(2));
             fs::create_directory_symlink("..", f / "stack" / "round");
         },
         "inspect stack", 0, "complete +true"},
        {"control characters in a folder's name",
         [](const fs::path& f) { put(f / "x\n\x1b[31m" / "tl000 pl000 tv000 pv000.png", "text"); },
         "inspect x*", 1, "x\\\\n\\\\x1b\\[31m/tl000.*not a whole image"},
        {"an output that is a folder",
         [](const fs::path& f) {
             put(f / stackImage("png"), blackPng(2));
             fs::create_directory(f / "out.exr");
         },
         "convert stack -o out.exr --method measured", 1, "out.exr"},
        {"an output in no folder",
         [](const fs::path& f) { put(f / stackImage("png"), blackPng(2)); },
         "convert stack -o no/such/out.exr --method measured", 1, "does not exist"},
        {"an output over the input",
         [](const fs::path& f) { put(f / "a.zip", zipBytes({image()})); },
         "convert a.zip -o a.zip --method measured", 1, "a.zip"},
    });
}

TEST_CASE("odd names that are right: UTF-8, blanks, quotes, new lines") {
    std::vector<BadInput> inputs;
    for (const char* name :
         {"Stoff \xc3\xa4\xe2\x82\xac\xf0\x9f\xa7\xb6.zip", " a b .zip", "it's.zip",
          "say \"hi\".zip", "two\nlines.zip", "{name}%s$HOME.zip", "#.zip", "\xff\xfe.zip"}) {
        inputs.push_back({name, [=](const fs::path& f) { put(f / name, zipBytes({image()})); },
                          "convert *.zip -o out.exr --method measured", 0, "1 images"});
        inputs.push_back({std::string("no archive: ") + name,
                          [=](const fs::path& f) { put(f / name, "PK\3\4 and nothing"); },
                          "convert *.zip -o out.exr --method measured", 1,
                          "is not a readable zip archive"});
    }
    inputs.push_back({"a name that begins as an option",
                      [](const fs::path& f) { put(f / "-a.zip", zipBytes({image()})); },
                      "inspect -- -a.zip", 0, "complete +true"});
    checkBadInputs(inputs);
}

TEST_SUITE_END();
