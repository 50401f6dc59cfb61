// SPDX-License-Identifier: BSD-3-Clause
//
// Atlases whose headers lie, models and reports that are none.
#include "tests/bad/bad_images.h"
#include "tests/bad/bad_input.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <limits>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

std::string atlasBytes() {
    const TemporaryFolder folder;
    writeAtlas(folder.path() / "a.exr", syntheticAtlas(AngularGrid(regularDirections(2, 3)), 2, 2,
                                                       [](const LightAndView&, int, int) {
                                                           return Rgb{0.5F, 0.25F, 1};
                                                       }));
    return bytesOf(folder.path() / "a.exr");
}

/// Bytes of an attribute's value replaced, `offset` from its begin.
std::string patchedIn(std::string bytes, const char* name, const char* type, std::size_t offset,
                      const std::string& value) {
    const std::string head = std::string(name) + '\0' + type + '\0';
    const std::size_t place = bytes.find(head);
    REQUIRE(place != std::string::npos);
    return bytes.replace(place + head.size() + 4 + offset, value.size(), value);
}

std::string patched(const char* name, const char* type, std::size_t offset,
                    const std::string& value) {
    return patchedIn(atlasBytes(), name, type, offset, value);
}

std::string renamed(const std::string& from, const std::string& to) {
    std::string bytes = atlasBytes();
    return bytes.replace(bytes.find(from), from.size(), to);
}

template <typename T>
std::string number(T value) {
    return ByteWriter().put(value).bytes();
}

/// 78000 x 900 pixels in 20 tiles, all of which agree, and no more than 40 kB.
std::string bomb() {
    std::string bytes = atlasBytes();
    bytes = patchedIn(bytes, "abrdf:texels", "v2i", 0, number(13000) + number(150));
    bytes = patchedIn(bytes, "dataWindow", "box2i", 8, number(77999) + number(899));
    bytes = patchedIn(bytes, "tiles", "tiledesc", 0, number(4096) + number(900));
    return bytes + std::string(40000, '\1');
}

BadInput atlas(const std::string& what, const std::string& bytes, const std::string& says,
               const std::string& arguments = "inspect a.exr") {
    return {what, [=](const fs::path& folder) { put(folder / "a.exr", bytes); }, arguments, 1,
            says};
}

BadInput report(const std::string& what, const std::string& text, const std::string& says) {
    return {what, [=](const fs::path& folder) { put(folder / "r" / "a.json", text); },
            "report r -o page.html", 1, says};
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("bad input: atlases") {
    const std::string whole = atlasBytes();
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    checkBadInputs({
        atlas("an atlas of tomorrow", patched("abrdf:version", "int", 0, number(2)),
              "is an atlas of version 2; this program reads 1"),
        atlas("without its views", renamed("abrdf:views", "abrdf:veiws"),
              "lacks the attribute abrdf:views"),
        atlas("another layout", renamed("angular", "triangl"), "there is no layout 'triangl'"),
        atlas("a light of NaN", patched("abrdf:lights", "floatvector", 0, number(kNaN)),
              "has a damaged header.*not above the surface"),
        atlas("a light below the surface", patched("abrdf:lights", "floatvector", 0, number(3.0F)),
              "not above the surface"),
        atlas("2^31 - 1 texels", patched("abrdf:texels", "v2i", 0, number(0x7fffffff)),
              "are not its image of"),
        atlas("no texels", patched("abrdf:texels", "v2i", 0, number(0)), "are not its image of"),
        atlas("an image of 2^31 columns", patched("dataWindow", "box2i", 8, number(0x7fffffff)),
              "declares"),
        atlas("a tile without a size", patched("tiles", "tiledesc", 0, number(0)),
              "tiles without a size"),
        atlas("a tile of gigabytes", patched("tiles", "tiledesc", 0, number(1 << 30)), "declares"),
        atlas("without green",
              renamed(std::string("G\0", 2) + number(2), std::string("Q\0", 2) + number(2)),
              "unreadable +1"),
        atlas("without its end", whole.substr(0, whole.size() - 100), "unreadable +1"),
        atlas("half of it", whole.substr(0, whole.size() / 2), "a.exr: is damaged or cut"),
        atlas("preview of what is cut", whole.substr(0, whole.size() - 100),
              "a.exr: cannot be read as OpenEXR.*end of file", "preview a.exr -o out.exr"),
        atlas("export of what is cut", whole.substr(0, whole.size() - 100),
              "a.exr: cannot be read as OpenEXR.*end of file",
              "export a.exr -o out.exr --to utia-exr"),
        atlas("preview of a bomb", bomb(),
              "is no atlas to be believed: it declares 70200000 pixels in",
              "preview a.exr -o out.exr"),
        atlas("preview of a photograph", bytesOf(OddImage{}),
              "a.exr: is not an abrdf atlas: its header lacks", "preview a.exr -o out.exr"),
        atlas("merge of whole atlases", whole, "a.exr: is a whole atlas and no part of one",
              "merge a.exr a.exr -o out.exr"),
        atlas("convert of what is cut", whole.substr(0, whole.size() - 100),
              "a.exr: cannot be read as OpenEXR.*end of file",
              "convert a.exr -o out.exr --method measured"),
    });
}

TEST_CASE("bad input: environments, models and reports") {
    const auto environment = [](const std::string& what, const std::string& name,
                                const std::string& bytes, const std::string& says) {
        return BadInput{what,
                        [=](const fs::path& folder) {
                            put(folder / "a.exr", atlasBytes());
                            put(folder / name, bytes);
                        },
                        "preview a.exr -o out.exr --environment " + name, 1, says};
    };
    const auto model = [](const std::string& what, const std::string& bytes) {
        return BadInput{what,
                        [=](const fs::path& folder) {
                            put(folder / stackImage("png"), blackPng(2));
                            put(folder / "model", bytes);
                        },
                        "convert stack -o out.exr --method prior --missing fill --model model", 1,
                        "model: is not a whole model of the prior"};
    };
    const std::string deepest = R"({"command":"evaluate","results":)" + std::string(200000, '[') +
                                std::string(200000, ']') + "}";
    checkBadInputs({
        environment("an environment of text", "sky.hdr", "blue", "sky.hdr: is no environment"),
        environment("an environment of 2^31 rows", "sky.hdr", hdrBytes("-Y 2147483647 +X 2", 6),
                    "sky.hdr"),
        environment("an environment of 30000 x 30000 in 100 bytes", "sky.hdr",
                    hdrBytes("-Y 30000 +X 30000", 6), "declares 30000 x 30000 pixels"),
        environment(
            "a grey environment", "sky.exr",
            [] {
                OddImage grey;
                grey.channels = {"Y"};
                return bytesOf(grey);
            }(),
            "it has 1 channels"),
        model("an empty model", ""),
        model("a text as a model", "a model"),
        model("a model's head alone", std::string("abrdf prior 003\0", 16) + std::string(8, 'x')),
        report("a report that is no JSON", "{", "is no JSON"),
        report("a report of nothing", "", "is no JSON"),
        report("a report without results", R"({"command":"evaluate"})", "is no whole report"),
        report("a report of texts", R"({"command":"stress","results":[7]})", "is no whole report"),
        report("a report 200000 deep", deepest, "nested more than 100 deep"),
    });
}

TEST_SUITE_END();
