// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/grazing.h"
#include "stages/pack/pack_texels.h"
#include "stages/reconstruct/reconstructor.h"
#include "stages/slice/slice_texels.h"

#include <span>
#include <vector>

namespace abrdf {

/// All that happens to a texel between the images and the atlas: slice, reconstruct, extend past
/// the measured elevations, finish. Built once a job, then used from any thread.
struct TexelMaker {
    TexelSlicer slicer;
    const Reconstructor& reconstructor;
    const GrazingMap& grazing;
    TexelFinisher finisher;
    std::size_t pairs;  ///< Of the atlas.

    /// Memory of one run of texels, kept for the next.
    struct Buffers {
        std::vector<Rgb> samples;
        std::vector<Rgb> inner;  ///< Up to the measured elevations, where the atlas goes past them.
        std::vector<Rgb> abrdfs;
        std::vector<float> estimates;  ///< Delta E a texel; none where the method knows none.
        UnrealCounts unreal;
    };

    /// Makes texels [first, first + count) of a band of images; abrdfs: all pairs of each.
    void make(std::span<const Rgb> band, std::size_t first, std::size_t count,
              Buffers& buffers) const;

    /// The same but for the last step, in scene_linear.
    void makeUnfinished(std::span<const Rgb> band, std::size_t first, std::size_t count,
                        Buffers& buffers) const;
};

}  // namespace abrdf
