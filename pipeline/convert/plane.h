// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/reconstruction.h"
#include "stages/align/find_plane.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace abrdf {

/// Where a material's visible surface is taken to lie.
struct PlaneChoice {
    bool search = true;          ///< Find it in the images; else `height` holds.
    double height = 0;           ///< In texels of the database's images.
    std::optional<Edges> edges;  ///< Nothing: told from the images.
    bool unshift = false;        ///< Give results back in the database's own frame.
};

/// "auto", "off" or a height. Throws std::invalid_argument.
PlaneChoice planeFromName(const std::string& name);

/// "auto", "periodic" or "cropped". Throws std::invalid_argument.
std::optional<Edges> edgesFromName(const std::string& name);

/// A plane, and how it was found.
struct FoundPlane {
    Plane plane;
    std::optional<PlaneFit> fit;  ///< Where it was searched; in texels of the database's images.
    double seconds = 0;
};

/// The plane for a method's samples. None, height 0, for one texel, for a table, and by search for
/// a method that takes every image as it is. A search reads the samples' images, at 128 texels each
/// way or fewer.
FoundPlane planeOf(const PlannedMethod& planned, const PlaneChoice& choice,
                   const OpenedInput& input, Texels texels, const ProgressSink& progress);

/// Texels from an edge within which samples may be lacking: the farthest that any view is shifted,
/// in texels of the database's images; 0 where edges join.
int marginOf(const Plane& plane, const AngularGrid& grid);

/// The same in texels of a job.
int marginOf(const Plane& plane, const BtfDescription& description, Texels texels);

/// For reports.
nlohmann::ordered_json jsonOf(const FoundPlane& found, const AngularGrid& grid);

}  // namespace abrdf
