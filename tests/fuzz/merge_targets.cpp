// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/merge.h"
#include "stages/read/atlas_reader.h"
#include "tests/fuzz/targets.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

std::ptrdiff_t filesIn(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

/// Two shards, one behind the other: of how many bytes the first is, two bytes say.
void runMerge(std::span<const char> bytes) {
    if (bytes.size() < 2) return;
    const auto byte = [&](std::size_t i) {
        return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
    };
    const auto shards = bytes.subspan(2);
    const std::size_t first = std::min(byte(0) + 256 * byte(1), shards.size());
    MergeOptions options;
    options.shards = {fuzzFile("part1.exr", shards.first(first)),
                      fuzzFile("part2.exr", shards.subspan(first))};
    options.output = options.shards[0].parent_path() / "whole.exr";
    fs::remove(options.output);
    const auto before = filesIn(options.output.parent_path());
    try {
        merge(options, {});
        const AtlasHeader header = readAtlasHeader(options.output);
        fuzzCheck(header.shard == 0, "what was merged is whole");
    } catch (const std::runtime_error&) {
        fuzzCheck(filesIn(options.output.parent_path()) == before, "a failed merge leaves nothing");
    }
}

/// Of a whole with 2 x 2 texels, each a row of tiles.
std::string shardBytes(const char* layout, int shard) {
    const TemporaryFolder folder;
    const Atlas part =
        syntheticAtlas(AngularGrid(regularDirections(1, 64), {{0, 0}, {0.5, 1}}), 2, 1,
                       [&](const LightAndView& pair, int x, int) {
                           return lambertianWithGloss(
                               pair, {0.2F, 0.1F * static_cast<float>(x), 0.5F}, 0.1 * shard, 0.3);
                       });
    AtlasHeader header = part.header();
    header.shard = shard;
    header.shards = 2;
    header.job =
        nlohmann::ordered_json{{"layout", layout}, {"texels", "2x2"}, {"compression", "none"}}
            .dump();
    const auto pixels = part.pixels();
    writeAtlas(folder.path() / "a.exr", Atlas(header, {pixels.begin(), pixels.end()}));
    return bytesOf(folder.path() / "a.exr");
}

std::vector<std::string> mergeSeeds() {
    std::vector<std::string> seeds;
    for (const char* layout : {"angular", "spatial"}) {
        const std::string first = shardBytes(layout, 1);
        seeds.push_back(std::string{static_cast<char>(first.size() & 255U),
                                    static_cast<char>(first.size() >> 8U)} +
                        first + shardBytes(layout, 2));
    }
    return seeds;
}

constexpr std::array kTargets{FuzzTarget{"merge", runMerge, mergeSeeds}};

}  // namespace

std::span<const FuzzTarget> mergeTargets() {
    return kTargets;
}

}  // namespace abrdf
