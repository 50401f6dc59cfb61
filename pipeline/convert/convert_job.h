// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/grazing.h"
#include "abrdf/scene_pairs.h"
#include "abrdf/tile_order.h"
#include "pipeline/convert/convert.h"
#include "pipeline/convert/memory_plan.h"
#include "pipeline/reconstruction.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace abrdf {

/// All of a conversion that is decided before the first image is decoded.
struct ConvertJob {
    OpenedInput input;
    MethodChoice method;            ///< Settled.
    nlohmann::ordered_json chosen;  ///< Why; null where there was nothing to choose.
    PlannedMethod planned;
    double planSeconds = 0;  ///< That choosing the samples took.
    FoundPlane found;
    std::optional<ScenePairs> scene;  ///< Of which `grid` is made; none: all of the grid matters.
    AngularGrid grid;
    GrazingMap grazing;  ///< From the elevations that are measured to the grid's.
    Texels texels;       ///< Of the whole atlas.
    int firstRow = 0;    ///< Of texels, of this job's shard.
    AtlasHeader header;  ///< Of this job's shard.
    MemoryTask memory;

    const AtlasLayout& layout() const { return header.layout; }
    const SampleSet& samples() const { return planned.samples; }

    /// Is the atlas to stand in the database's own frame, though its images were shifted?
    bool isUnshifted = false;

    /// The order of the columns of the table of texels: that of an angular atlas's tiles, or of
    /// rows.
    TileOrder texelOrder() const;

    /// This job's texels of an image, row by row.
    template <typename T>
    std::span<const T> rowsOf(std::span<const T> image) const {
        return image.subspan(
            static_cast<std::size_t>(firstRow) * static_cast<std::size_t>(texels.width),
            layout().texelCount());
    }
};

/// Throws as convert().
ConvertJob prepareConvert(const ConvertOptions& options, const ProgressSink& progress);

}  // namespace abrdf
