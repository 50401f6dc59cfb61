// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/unshifted_texels.h"

#include <algorithm>
#include <set>
#include <utility>

namespace abrdf {

UnshiftedTexels::UnshiftedTexels(const Plane& plane, const BtfDescription& description,
                                 Texels texels, const AngularGrid& grid,
                                 ReconstructRows reconstruct)
    : grid_(grid), reconstruct_(std::move(reconstruct)) {
    applied_.edges = plane.edges;
    applied_.width = texels.width;
    applied_.height = texels.height;
    for (const Direction& view : grid.views()) {
        const Shift shift = parallax(plane.height, view);
        applied_.ofView.push_back({shift.x * texels.width / description.width,
                                   shift.y * texels.height / description.height});
    }
}

ReconstructedTexels UnshiftedTexels::rows(int first, int count) {
    std::set<int> needed;
    for (int y = first; y < first + count; ++y) {
        for (const int row : alignedRows(applied_, y)) needed.insert(row);
    }
    std::erase_if(aligned_, [&](const auto& row) { return !needed.contains(row.first); });

    const auto width = static_cast<std::size_t>(applied_.width);
    ReconstructedTexels result;
    result.abrdfs = AbrdfTile(width * static_cast<std::size_t>(count), grid_.pairCount());
    for (auto row = needed.begin(); row != needed.end();) {
        if (aligned_.contains(*row)) {
            ++row;
            continue;
        }
        const int begin = *row;
        int end = begin;
        while (row != needed.end() && *row == end && !aligned_.contains(end)) {
            ++row;
            ++end;
        }
        const ReconstructedTexels more = reconstruct_(begin, end - begin);
        result.unreal += more.unreal;
        const std::size_t values = width * grid_.pairCount();
        for (int y = begin; y < end; ++y) {
            AbrdfTile& tile =
                aligned_.emplace(y, AbrdfTile(width, grid_.pairCount())).first->second;
            std::ranges::copy(
                more.abrdfs.values().subspan(static_cast<std::size_t>(y - begin) * values, values),
                tile.values().begin());
        }
    }
    for (int y = first; y < first + count; ++y) {
        const AbrdfTile row = unshiftedRow(
            applied_, grid_, y, [&](int from) -> const AbrdfTile& { return aligned_.at(from); });
        std::ranges::copy(row.values(),
                          result.abrdfs.values()
                              .subspan(static_cast<std::size_t>(y - first) * row.values().size(),
                                       row.values().size())
                              .begin());
    }
    return result;
}

}  // namespace abrdf
