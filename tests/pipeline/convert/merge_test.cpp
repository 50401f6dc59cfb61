// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/merge.h"

#include "pipeline/convert/convert.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

ConvertOptions jobOn(const fs::path& folder) {
    ConvertOptions options;
    options.input.input = folder / "btf";
    options.method.name = "published";
    options.texels = {0, 0};
    options.grid = "regular:7x12";
    return options;
}

void writeStack(const fs::path& folder) {
    SyntheticBtf btf;
    btf.width = 6;
    btf.height = 11;
    btf.value = [](const LightAndView& p, int x, int y) {
        if (x == 2 && y == 7) return Rgb{-1, -1, -1};
        return Rgb{static_cast<float>(x), static_cast<float>(y), static_cast<float>(p.view.theta)};
    };
    writeSyntheticBtf(folder / "btf", btf);
}

std::vector<fs::path> shardsOf(ConvertOptions options, const fs::path& folder, int count) {
    std::vector<fs::path> paths;
    for (int i = 1; i <= count; ++i) {
        options.output = folder / fmt::format("part{}of{}.exr", i, count);
        options.shard = {i, count};
        const auto report = convert(options, {});
        CHECK(report["shard"] == nlohmann::ordered_json{i, count});
        paths.push_back(options.output);
    }
    return paths;
}

std::string faultOf(const MergeOptions& options) {
    return abrdf::faultOf([&] { merge(options, {}); });
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("shards, merged in any order, are the single run to the byte, in both layouts") {
    const TemporaryFolder folder;
    writeStack(folder.path());
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        ConvertOptions options = jobOn(folder.path());
        options.layout = kind;
        options.output = folder.path() / "single.exr";
        const auto single = convert(options, {});
        for (const int count : {2, 5}) {
            MergeOptions merging;
            merging.shards = shardsOf(options, folder.path(), count);
            std::ranges::reverse(merging.shards);
            merging.output = folder.path() / "merged.exr";
            const auto merged = merge(merging, {});
            CHECK(bytesOf(merging.output) == bytesOf(options.output));
            for (const char* key : {"clamped", "extrapolated", "nonfinite"}) {
                CHECK(merged["counts"][key] == single["counts"][key]);
            }
            CHECK(single["counts"]["nonfinite"] > 0);
        }
    }
}

TEST_CASE("one shard of one is the whole atlas, and merging it keeps its bytes") {
    const TemporaryFolder folder;
    writeStack(folder.path());
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        ConvertOptions options = jobOn(folder.path());
        options.layout = kind;
        options.output = folder.path() / "single.exr";
        const auto single = convert(options, {});
        options.shard = shardFromText("1/1");
        options.output = folder.path() / "part1of1.exr";
        convert(options, {});
        MergeOptions merging;
        merging.shards = {options.output};
        merging.output = folder.path() / "merged.exr";
        const auto merged = merge(merging, {});
        CHECK(bytesOf(merging.output) == bytesOf(folder.path() / "single.exr"));
        CHECK(merged["shards"] == 1);
        CHECK(merged["texels"] == nlohmann::ordered_json{6, 11});
        CHECK(merged["counts"]["nonfinite"] == single["counts"]["nonfinite"]);
        CHECK(merged["output"]["bytes"] == fs::file_size(merging.output));
        merging.output = merging.shards[0];  // Into itself.
        merge(merging, {});
        CHECK(bytesOf(merging.output) == bytesOf(folder.path() / "single.exr"));
    }
}

TEST_CASE("shards that are missing, there twice, or of another job are refused by name") {
    const TemporaryFolder folder;
    writeStack(folder.path());
    const ConvertOptions options = jobOn(folder.path());
    const std::vector<fs::path> parts = shardsOf(options, folder.path(), 3);
    MergeOptions merging;
    merging.output = folder.path() / "merged.exr";
    merging.shards = {parts[0], parts[2]};
    CHECK(faultOf(merging).find("missing: 2") != std::string::npos);
    merging.shards = {parts[0], parts[1], parts[2], parts[1]};
    CHECK(faultOf(merging).find("both part 2") != std::string::npos);
    ConvertOptions other = options;
    other.divideCosine = true;
    other.shard = {2, 3};
    other.output = folder.path() / "other.exr";
    convert(other, {});
    merging.shards = {parts[0], other.output, parts[2]};
    const std::string fault = faultOf(merging);
    CHECK(fault.find("other.exr") != std::string::npos);
    CHECK(fault.find("cosine was") != std::string::npos);
    other.shard = {};
    convert(other, {});
    merging.shards = {parts[0], other.output, parts[2]};
    CHECK(faultOf(merging).find("other.exr: is a whole atlas") != std::string::npos);
    merging.shards = {parts[0]};
    CHECK(faultOf(merging).find("missing: 2, 3") != std::string::npos);
    CHECK_FALSE(fs::exists(merging.output));
}

TEST_CASE("a shard whose header tells only a part of its job is refused by name") {
    const TemporaryFolder folder;
    writeStack(folder.path());
    MergeOptions merging;
    merging.output = folder.path() / "merged.exr";
    merging.shards = shardsOf(jobOn(folder.path()), folder.path(), 2);
    const fs::path part = merging.shards[0];
    const std::string whole = bytesOf(part);
    CHECK(faultOf(merging).empty());
    fs::remove(merging.output);
    for (const char* key : {"layout", "texels", "compression"}) {
        CAPTURE(key);
        std::string bytes = whole;
        const std::size_t job = bytes.find("abrdf:job");
        REQUIRE(job != std::string::npos);
        bytes[bytes.find(fmt::format("\"{}\":", key), job) + 1] = '_';
        std::ofstream(part, std::ios::binary) << bytes;
        CHECK(faultOf(merging).find("part1of2.exr: has a damaged header") != std::string::npos);
        CHECK_FALSE(fs::exists(merging.output));
    }
}

TEST_CASE("shards that lie about their form are refused, whatever job they name") {
    const TemporaryFolder folder;
    MergeOptions merging;
    merging.output = folder.path() / "merged.exr";
    merging.shards = {folder.path() / "a.exr", folder.path() / "b.exr"};
    const auto write = [&](int shard, int width, int height, int views, AtlasKind kind) {
        const AngularGrid grid(regularDirections(1, 32), regularDirections(1, views));
        const Atlas part = syntheticAtlas(grid, width, height, [](const LightAndView&, int, int) {
            return Rgb{1, 2, 3};
        });
        AtlasHeader header = part.header();
        header.layout.kind = kind;
        header.shard = shard;
        header.shards = 2;
        header.job = R"({"layout":"angular","texels":"2x4","compression":"none"})";
        const auto pixels = part.pixels();
        writeAtlas(merging.shards[static_cast<std::size_t>(shard - 1)],
                   Atlas(header, {pixels.begin(), pixels.end()}));
    };
    const auto first = [&] { write(1, 2, 2, 3, AtlasKind::kAngular); };
    first();
    write(2, 2, 2, 3, AtlasKind::kAngular);
    CHECK(faultOf(merging).empty());
    fs::remove(merging.output);
    write(2, 2, 2, 5, AtlasKind::kAngular);
    CHECK(faultOf(merging).find("2 wide of 32 x 5 directions instead of") != std::string::npos);
    write(2, 3, 2, 3, AtlasKind::kAngular);
    CHECK(faultOf(merging).find("texels 3 wide") != std::string::npos);
    write(2, 2, 2, 3, AtlasKind::kSpatial);
    CHECK(faultOf(merging).find("b.exr: is no shard") != std::string::npos);
    // 32 lights: two rows of texels a tile.
    write(1, 2, 1, 3, AtlasKind::kAngular);
    write(2, 2, 3, 3, AtlasKind::kAngular);
    CHECK(faultOf(merging).find("part 2 begins within a tile") != std::string::npos);
    CHECK_FALSE(fs::exists(merging.output));
}

TEST_CASE("there are no more shards than rows of tiles") {
    const TemporaryFolder folder;
    writeStack(folder.path());
    ConvertOptions options = jobOn(folder.path());
    options.output = folder.path() / "a.exr";
    options.shard = {1, 100};
    CHECK_THROWS_AS(convert(options, {}), std::invalid_argument);
}

TEST_SUITE_END();
