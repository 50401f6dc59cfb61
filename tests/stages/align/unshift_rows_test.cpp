// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/unshift_rows.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace abrdf;

namespace {

constexpr int kWidth = 6;
constexpr int kHeight = 5;

float valueAt(int x, int y, std::size_t pair) {
    return static_cast<float>(100 * y + 10 * x) + static_cast<float>(pair) / 16;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("images that were shifted by whole texels come back as they were") {
    const AngularGrid grid(regularDirections(2, 3));
    AppliedShifts applied;
    applied.width = kWidth;
    applied.height = kHeight;
    for (std::size_t v = 0; v < grid.views().size(); ++v) {
        applied.ofView.push_back({static_cast<double>(v % 3) - 1, static_cast<double>(v / 3)});
    }
    // Aligned texel (x, y) of view v is the database's (x + shift.x, y + shift.y).
    std::vector<AbrdfTile> aligned;
    for (int y = 0; y < kHeight; ++y) {
        aligned.emplace_back(kWidth, grid.pairCount());
        for (int x = 0; x < kWidth; ++x) {
            for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
                const Shift& shift = applied.ofView[pair % grid.views().size()];
                const int fromX = (x + static_cast<int>(shift.x) + kWidth) % kWidth;
                const int fromY = (y + static_cast<int>(shift.y) + kHeight) % kHeight;
                const float value = valueAt(fromX, fromY, pair);
                aligned.back()[static_cast<std::size_t>(x)][pair] = {value, value, value};
            }
        }
    }
    for (int y = 0; y < kHeight; ++y) {
        std::vector<int> asked;
        const AbrdfTile row = unshiftedRow(applied, grid, y, [&](int from) -> const AbrdfTile& {
            asked.push_back(from);
            return aligned[static_cast<std::size_t>(from)];
        });
        for (int x = 0; x < kWidth; ++x) {
            for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
                CHECK(row[static_cast<std::size_t>(x)][pair].g == valueAt(x, y, pair));
            }
        }
        const std::vector<int> named = alignedRows(applied, y);
        CHECK(std::ranges::is_sorted(named));
        for (const int from : asked) CHECK(std::ranges::binary_search(named, from));
    }
}

TEST_SUITE_END();
