// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/image_stack.h"
#include "abrdf/progress.h"
#include "abrdf/sample_set.h"
#include "pipeline/job.h"
#include "stages/align/shift_image.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace abrdf {

/// The surface's plane z = height that images are shifted to, so that a texel shows one place of
/// the surface in all views.
struct Plane {
    double height = 0;  ///< In texels of the database's images; 0: images stay as they are.
    Edges edges = Edges::kPeriodic;
};

/// Receives the linear texels of image `image` (of samples.pairs), row by row; from any thread.
using ImageSink = std::function<void(std::size_t image, std::span<const Rgb> texels)>;

/// What is known of all images once they were read.
struct ReadFacts {
    std::uint64_t leftOut = 0;  ///< Pixels that were NaN, infinite or negative.
    std::uint64_t outside = 0;  ///< Pixels of the plane that lie outside their image: NaN.
    std::vector<Rgb> means;     ///< Of each image over its valid texels; NaN where it has none.
    /// Texels that are spread over the images, the same of each, image after image; none where
    /// there is only one texel.
    std::vector<Rgb> someTexels;
    std::uint64_t hash = 0;  ///< contentHash() of all their texels.
};

/// Reads, linearises, shifts and averages the images of samples.pairs in parallel, at most `atOnce`
/// under way, and opens no other image; a table is evaluated instead, one "image" of one texel a
/// sample.
ReadFacts readImages(const OpenedInput& input, const SampleSet& samples, Texels texels,
                     const Plane& plane, std::size_t atOnce, const ImageSink& sink,
                     const ProgressSink& progress);

struct ReadStack {
    ImageStack stack;
    ReadFacts facts;
};

/// The same into memory.
ReadStack readStack(const OpenedInput& input, const SampleSet& samples, Texels texels,
                    const Plane& plane, const ProgressSink& progress);

/// Of images as they stand.
inline ReadStack readStack(const OpenedInput& input, const SampleSet& samples, Texels texels,
                           const ProgressSink& progress) {
    return readStack(input, samples, texels, Plane{}, progress);
}

}  // namespace abrdf
