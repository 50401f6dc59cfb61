// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "pipeline/convert/plane.h"
#include "pipeline/reconstruction.h"

#include <string>
#include <vector>

namespace abrdf {

/// What a method makes of one input.
struct EvaluatedMethod {
    PlannedMethod planned;
    FoundPlane found;
    AbrdfTile abrdfs;              ///< Linear Rec.709.
    std::vector<float> estimates;  ///< A bound of each texel's Delta E; may be empty.
    double microsecondsPerAbrdf = 0;
    double multiplyAdds = 0;
    std::string remark;  ///< As Reconstructor's.
};

/// Reads the samples of the method, reconstructs all texels and takes its time. scene: as
/// planMethod(). Throws as convert().
EvaluatedMethod runMethod(const MethodChoice& choice, const OpenedInput& input, Texels texels,
                          const PlaneChoice& plane, const SceneChoice* scene,
                          const ProgressSink& progress);

}  // namespace abrdf
