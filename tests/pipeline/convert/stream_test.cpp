// SPDX-License-Identifier: BSD-3-Clause
//
// Maps within a memory budget, and their continuation after a stop at any moment.
#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "pipeline/convert/convert.h"
#include "pipeline/convert/dry_run.h"
#include "pipeline/convert/memory_plan.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

/// A stack of 16 x 15 pixels on few pairs, made once a run; a value tells its place.
const fs::path& stack() {
    static const TemporaryFolder folder;
    static const fs::path path = [] {
        SyntheticBtf btf;
        btf.width = 16;
        btf.height = 15;
        btf.value = [](const LightAndView& p, int x, int y) {
            return Rgb{static_cast<float>(x + 16 * y) / 256, static_cast<float>(p.light.phi),
                       static_cast<float>(1 + std::cos(p.view.phi * 2 - p.light.theta))};
        };
        writeSyntheticBtf(folder.path() / "btf", btf);
        return folder.path() / "btf";
    }();
    return path;
}

ConvertOptions jobTo(const fs::path& output) {
    ConvertOptions options;
    options.input.input = stack();
    options.output = output;
    options.method.name = "measured";
    options.texels = {0, 0};
    return options;
}

/// The smallest budget that the job's error names, a little more for what tests add meanwhile.
std::uint64_t smallestBudget(ConvertOptions options) {
    options.memory = 1;
    try {
        convert(options, {});
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what();
        return bytesFromText(text.substr(text.rfind(' ') + 1)) + 2 * kMega;
    }
    return 0;
}

struct Stop : std::runtime_error {
    Stop() : std::runtime_error("stop") {}
};

/// Runs a job that ends once so many tiles were written.
void runUntil(const ConvertOptions& options, std::size_t tiles) {
    CHECK_THROWS_AS(convert(options,
                            [&](const ProgressTick& tick) {
                                if (tick.unit == "tiles" && tick.done >= tiles) throw Stop();
                            }),
                    Stop);
}

std::string faultOf(const ConvertOptions& options) {
    return abrdf::faultOf([&] { convert(options, {}); });
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the smallest budget gives the bytes of a large one, through scratch files") {
    const TemporaryFolder folder;
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        ConvertOptions options = jobTo(folder.path() / "a.exr");
        options.layout = kind;
        CHECK(convert(options, {})["scratch_bytes"] == 0);
        const std::string bytes = bytesOf(options.output);
        options.memory = smallestBudget(options);
        REQUIRE(options.memory > 0);
        const auto plan = planConvert(options);
        const auto report = convert(options, {});
        CHECK(report["scratch_bytes"] >= 6561 * 240 * 12);
        CHECK(plan["estimate"]["scratch_bytes"] == report["scratch_bytes"]);
        CHECK(bytesOf(options.output) == bytes);
    }
}

TEST_CASE("a job that was stopped goes on from its tiles and gives the bytes of one that was not") {
    const TemporaryFolder folder;
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        ConvertOptions options = jobTo(folder.path() / "whole.exr");
        options.layout = kind;
        options.memory = 4096 * kMega;
        const auto whole = convert(options, {});
        CHECK_FALSE(whole.contains("resumed_tiles"));
        const fs::path partial = partialBeside(folder.path() / "a.exr");
        // Two runs of tiles at least, of which a cut leaves one.
        const std::size_t stopAt = kind == AtlasKind::kAngular ? 40 : 3;
        for (const std::uint64_t cut : {0U, 1U, 1000U}) {
            options.output = folder.path() / "a.exr";
            options.resume = true;
            const ThreadLimit limit(cut == 0 ? 1 : 3);
            runUntil(options, stopAt);
            CHECK_FALSE(fs::exists(options.output));
            // A power cut may take what the journal tells of; that tile is made again.
            fs::resize_file(partial, fs::file_size(partial) - cut);
            const auto report = convert(options, {});
            CHECK(report.value("resumed_tiles", std::size_t{0}) >= (cut == 0 ? stopAt : 1));
            CHECK(report["counts"] == whole["counts"]);
            CHECK(bytesOf(options.output) == bytesOf(folder.path() / "whole.exr"));
            CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);
            fs::remove(options.output);
        }
    }
}

TEST_CASE("a changed job refuses to go on and says what changed; without --resume it begins anew") {
    const TemporaryFolder folder;
    ConvertOptions options = jobTo(folder.path() / "a.exr");
    options.resume = true;
    runUntil(options, 2);
    ConvertOptions other = options;
    other.divideCosine = true;
    const std::string fault = faultOf(other);
    CHECK(fault.find("cosine was \"keep\" and is \"divide\"") != std::string::npos);
    CHECK(fs::exists(partialBeside(options.output)));
    other.resume = false;
    CHECK(faultOf(other).empty());
    CHECK_FALSE(fs::exists(partialBeside(options.output)));
    // What is finished is kept, if it is of this job.
    const std::string bytes = bytesOf(options.output);
    CHECK(faultOf(options).find("another job") != std::string::npos);
    other.resume = true;
    CHECK(convert(other, {})["finished_before"] == true);
    CHECK(bytesOf(options.output) == bytes);
}

TEST_CASE("a failed job without --resume leaves nothing, and an old file as it was") {
    const TemporaryFolder folder;
    const ConvertOptions options = jobTo(folder.path() / "a.exr");
    std::ofstream(options.output) << "old";
    runUntil(options, 2);
    CHECK(bytesOf(options.output) == "old");
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_SUITE_END();
