// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/memory_plan.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using namespace abrdf;

namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

MemoryTask map256(AtlasKind kind) {
    MemoryTask task;
    task.layout = {kind, 256, 256, 81, 81};
    task.images = 204;
    task.samples = 204;
    task.reconstructed = 6561;
    task.imageBytes = 2 * kMega;
    task.fixedBytes = 60 * kMega;
    task.threads = 8;
    return task;
}

/// The smallest budget that the error names.
std::uint64_t smallestOf(const MemoryTask& task) {
    try {
        planMemory(task, kMega);
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what();
        const auto at = text.rfind(' ');
        return bytesFromText(text.substr(at + 1));
    }
    return 0;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("sizes are read with their units, and nonsense is not") {
    CHECK(bytesFromText("1") == 1);
    CHECK(bytesFromText("3K") == 3072);
    CHECK(bytesFromText("500M") == 500 * kMega);
    CHECK(bytesFromText("2GiB") == 2048 * kMega);
    for (const char* text : {"", "0", "-1", "2X", "1.5G", "99999999999T", "G"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(bytesFromText(text), std::invalid_argument);
    }
}

TEST_CASE("a plan keeps within its budget, for the smallest that works as well") {
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        const MemoryTask task = map256(kind);
        const std::uint64_t smallest = smallestOf(task);
        CHECK(smallest > task.fixedBytes);
        CHECK(smallest <= 256 * kMega);
        for (const std::uint64_t budget : {smallest, 256 * kMega, 512 * kMega, 8192 * kMega}) {
            const MemoryPlan plan = planMemory(task, budget);
            CHECK(plan.peak <= budget);
            CHECK(plan.slots >= 1);
        }
        CHECK_FALSE(planMemory(task, smallest).samplesInMemory);
        CHECK(planMemory(task, smallest).scratchBytes > 0);
        CHECK(planMemory(task, 8192 * kMega).scratchBytes == 0);
        // More threads never make a budget impossible: fewer of them work.
        MemoryTask many = task;
        many.threads = 256;
        CHECK(planMemory(many, smallest).peak <= smallest);
    }
}

TEST_CASE("bands are whole runs of tiles and cover all cells") {
    const TileOrder order(10, 7, 4, 3);  // 3 x 3 tiles.
    CHECK(bandBegins(order, 4) == std::vector<std::size_t>{0, 42, 68, 70});
    CHECK(bandBegins(order, 100) == std::vector<std::size_t>{0, 70});
}

TEST_SUITE_END();
