// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/unshift_rows.h"

#include "abrdf/for_each_texel.h"

#include <array>
#include <set>

namespace abrdf {

namespace {

/// Row y in the aligned frame, for each view.
std::vector<Between> rowsOf(const AppliedShifts& applied, int y) {
    std::vector<Between> rows;
    for (const Shift& shift : applied.ofView) {
        rows.push_back(
            shiftedPlaces(applied.height, -shift.y, applied.edges)[static_cast<std::size_t>(y)]);
    }
    return rows;
}

}  // namespace

std::vector<int> alignedRows(const AppliedShifts& applied, int y) {
    std::set<int> rows;
    for (const Between& row : rowsOf(applied, y)) {
        rows.insert(static_cast<int>(row.first));
        rows.insert(static_cast<int>(row.second));
    }
    return {rows.begin(), rows.end()};
}

AbrdfTile unshiftedRow(const AppliedShifts& applied, const AngularGrid& grid, int y,
                       const std::function<const AbrdfTile&(int y)>& alignedRow) {
    const std::size_t views = grid.views().size();
    const std::size_t lights = grid.lights().size();
    const std::vector<Between> rows = rowsOf(applied, y);
    std::vector<std::array<const AbrdfTile*, 2>> tiles;
    std::vector<std::vector<Between>> columns;
    for (std::size_t v = 0; v < views; ++v) {
        tiles.push_back({&alignedRow(static_cast<int>(rows[v].first)),
                         &alignedRow(static_cast<int>(rows[v].second))});
        columns.push_back(shiftedPlaces(applied.width, -applied.ofView[v].x, applied.edges));
    }
    AbrdfTile result(static_cast<std::size_t>(applied.width), grid.pairCount());
    forEachTexelBlock(result.texelCount(), 1, [&](std::size_t x, std::size_t) {
        const std::span<Rgb> abrdf = result[x];
        for (std::size_t v = 0; v < views; ++v) {
            const Between& column = columns[v][x];
            const float right = column.share;
            const float below = rows[v].share;
            const std::array<std::span<const Rgb>, 4> around = {
                (*tiles[v][0])[column.first], (*tiles[v][0])[column.second],
                (*tiles[v][1])[column.first], (*tiles[v][1])[column.second]};
            const std::array weights = {(1 - right) * (1 - below), right * (1 - below),
                                        (1 - right) * below, right * below};
            for (std::size_t pair = v; pair < lights * views; pair += views) {
                for (std::size_t i = 0; i < around.size(); ++i) {
                    abrdf[pair] += weights[i] * around[i][pair];
                }
            }
        }
    });
    return result;
}

}  // namespace abrdf
