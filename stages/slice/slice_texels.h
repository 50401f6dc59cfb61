// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/image_stack.h"
#include "abrdf/sample_set.h"

#include <cstdint>

namespace abrdf {

struct SlicedTexels {
    AbrdfTile samples;           ///< A row of set.count() values for each texel.
    std::uint64_t repaired = 0;  ///< Samples without a valid value, replaced by their neighbours.
};

/// Turns image-major data into texel-major samples: the transposition of the pipeline.
/// Texels [firstTexel, firstTexel + texelCount) of the stack, which must hold all set.pairs.
/// A sample that is NaN takes the value of the texel's nearest valid sample; a texel without any
/// valid one becomes black.
SlicedTexels sliceTexels(const ImageStack& stack, const SampleSet& set, std::size_t firstTexel,
                         std::size_t texelCount);

}  // namespace abrdf
