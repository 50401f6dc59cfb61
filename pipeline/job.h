// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/image_stack.h"
#include "abrdf/progress.h"
#include "abrdf/sample_plan.h"
#include "abrdf/sample_set.h"
#include "color/color_config.h"
#include "stages/align/shift_image.h"
#include "stages/read/btf_reader.h"
#include "stages/reconstruct/reconstructor.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

enum class MissingImages {
    kError,  ///< A needed image that is absent ends the job.
    kFill,   ///< It is interpolated from its neighbours, and counted.
};

/// What every job on a database says of its input.
struct InputOptions {
    std::filesystem::path input;
    std::optional<std::filesystem::path> colorConfig;  ///< Else $OCIO, else the shipped config.
    std::string inputSpace;  ///< OpenColorIO name; empty: the database's own convention.
    MissingImages missing = MissingImages::kError;
    MessageSink warn;  ///< Told of what goes on though it should not be.
    ReadOptions read;
};

/// Spatial resolution of a job; 0 x 0 stands for every texel of the images.
struct Texels {
    int width = 1;
    int height = 1;

    std::size_t count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

/// "WxH" or "full". Throws std::invalid_argument.
Texels texelsFromName(const std::string& name);

/// A database that is open and checked, with the colours' way in.
struct OpenedInput {
    std::unique_ptr<BtfReader> reader;
    ColorConfig colors;
    std::string inputSpace;  ///< The config's own name of it.
    MissingImages missing = MissingImages::kError;
    MessageSink warn;

    /// True where the images hold codes of few bits, not light.
    bool hasCodes() const;
    const BtfDescription& description() const { return reader->description(); }
};

/// Throws std::runtime_error for anything that cannot be used: no database, two images for a pair,
/// a colour space that the config lacks.
OpenedInput openInput(const InputOptions& options);

/// Replaces 0 x 0 by the images' size; throws std::invalid_argument for more texels than pixels.
Texels resolvedTexels(Texels texels, const BtfDescription& description);

/// The samples for `method` onto the atlas's grid `output`, with missing images filled where that
/// was asked for. A BRDF table is sampled where the plan says, or measured where the atlas asks;
/// source k of its set is sample k. Throws std::runtime_error that counts the missing images and
/// names the first five.
SampleSet samplesFor(const Method& method, const SamplePlan& plan, const OpenedInput& input,
                     const AngularGrid& output);

/// The grid that the samples of `method` come from: a table is its own measurement on any grid.
const AngularGrid& sampledGrid(const Method& method, const OpenedInput& input,
                               const AngularGrid& output);

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

/// "tl030 pl090 tv015 pv060": a pair as the databases write it.
std::string pairName(const LightAndView& pair);

/// Largest resident set so far, and the present one, in bytes.
std::uint64_t peakMemory();
std::uint64_t residentMemory();

}  // namespace abrdf
