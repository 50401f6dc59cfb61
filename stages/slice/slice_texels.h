// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/image_stack.h"
#include "abrdf/sample_set.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// Turns image-major data into texel-major samples. Built once a job, then used from any thread.
class TexelSlicer {
  public:
    /// images: the pairs of the images, ascending; they must hold all set.pairs.
    TexelSlicer(std::span<const std::size_t> images, const SampleSet& set);

    std::size_t sampleCount() const { return terms_.size(); }

    /// band: image after image, each with the same texels, from which those of `samples` (a row of
    /// sampleCount() values for each texel) are taken from `first` on. A sample that is NaN takes
    /// the value of the texel's nearest valid sample; a texel without any valid one becomes black.
    /// Returns the number of samples replaced so.
    std::uint64_t slice(std::span<const Rgb> band, std::size_t first, std::span<Rgb> samples) const;

  private:
    /// One term of a sample: which image, and its share.
    struct Term {
        std::size_t image;
        float weight;
    };

    std::uint64_t repair(std::span<Rgb> samples) const;

    std::size_t images_;
    std::vector<LightAndView> directions_;
    std::vector<std::vector<Term>> terms_;
};

struct SlicedTexels {
    AbrdfTile samples;           ///< A row of set.count() values for each texel.
    std::uint64_t repaired = 0;  ///< Samples without a valid value, replaced by their neighbours.
};

/// Texels [firstTexel, firstTexel + texelCount) of a stack in memory, in parallel.
SlicedTexels sliceTexels(const ImageStack& stack, const SampleSet& set, std::size_t firstTexel,
                         std::size_t texelCount);

}  // namespace abrdf
