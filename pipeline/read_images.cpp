// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/read_images.h"

#include "abrdf/content_hash.h"
#include "abrdf/flow.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/mean_color.h"
#include "stages/average/average_image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

struct AveragedImage {
    std::uint64_t leftOut = 0;  ///< As averageImage().
    std::uint64_t outside = 0;  ///< As shiftImage().
};

/// Linear texels of an image that is shifted at its own resolution first.
AveragedImage averageShifted(const EncodedImage& image, const Linearizer& linearizer, Shift shift,
                             Edges edges, Texels texels, std::span<Rgb> result) {
    if (shift.x == 0 && shift.y == 0) {
        return {averageImage(image, linearizer, texels.width, texels.height, result), 0};
    }
    std::vector<Rgb> pixels(static_cast<std::size_t>(image.width) *
                            static_cast<std::size_t>(image.height));
    std::vector<Rgb> shifted(pixels.size());
    AveragedImage averaged;
    averaged.leftOut = averageImage(image, linearizer, image.width, image.height, pixels);
    averaged.outside = shiftImage(pixels, image.width, image.height, shift, edges, shifted);
    averageColors(shifted, image.width, image.height, texels.width, texels.height, result);
    return averaged;
}

/// A sample of a table as an image of one texel: NaN where it is no light.
std::uint64_t evaluateTable(const BrdfTable& table, const LightAndView& direction,
                            const ColorTransform& toSceneLinear, std::span<Rgb> texel) {
    texel[0] = table.evaluate(direction);
    if (isFinite(texel[0]) && !isNegative(texel[0])) {
        toSceneLinear.apply(texel);
        return 0;
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    texel[0] = {kNaN, kNaN, kNaN};
    return 1;
}

/// More do not change a choice.
constexpr std::size_t kSomeTexels = 64;

/// Places of texels that are spread over an image, row by row; none where it has only one.
std::vector<std::size_t> someTexels(Texels texels) {
    std::vector<std::size_t> places;
    if (texels.count() == 1) return places;
    // The additive sequence of the plastic number: as many as there are, evenly spread, in step
    // with no weave.
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    const auto place = [](std::size_t i, double step, int count) {
        const double share = 0.5 + static_cast<double>(i) * step;
        return static_cast<std::size_t>((share - std::floor(share)) * count);
    };
    for (std::size_t i = 0; i < std::min(kSomeTexels, texels.count()); ++i) {
        places.push_back(place(i, kStepY, texels.height) * static_cast<std::size_t>(texels.width) +
                         place(i, kStepX, texels.width));
    }
    return places;
}

template <typename T>
std::span<const char> bytesOf(std::span<const T> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

ReadFacts readImages(const OpenedInput& input, const SampleSet& samples, Texels texels,
                     const Plane& plane, std::size_t atOnce, const ImageSink& sink,
                     const ProgressSink& progress) {
    const ColorTransform toSceneLinear = input.colors.transform(input.inputSpace, "scene_linear");
    const BrdfTable* table = input.reader->table();
    const Linearizer linearizer(toSceneLinear);
    const std::vector<std::size_t>& pairs = samples.pairs;
    const std::vector<std::size_t> some = someTexels(texels);
    ReadFacts facts;
    facts.means.resize(pairs.size());
    facts.someTexels.resize(pairs.size() * some.size());
    std::vector<std::uint64_t> hashes(pairs.size());
    std::vector<std::vector<Rgb>> buffers(atOnce);
    std::atomic<std::uint64_t> leftOut = 0;
    std::atomic<std::uint64_t> outside = 0;
    std::atomic<std::size_t> done = 0;
    const auto readInto = [&](std::size_t i, std::span<Rgb> image) {
        if (table != nullptr) {
            leftOut += evaluateTable(*table, samples.directions[i], toSceneLinear, image);
            return;
        }
        const Shift shift = parallax(plane.height, input.description().grid.pair(pairs[i]).view);
        const AveragedImage averaged = averageShifted(input.reader->read(pairs[i]), linearizer,
                                                      shift, plane.edges, texels, image);
        leftOut += averaged.leftOut;
        outside += averaged.outside;
        if (progress) progress({"read", "images", ++done, pairs.size()});
    };
    const auto read = [&](std::size_t i, std::size_t slot) {
        std::vector<Rgb>& image = buffers[slot];
        image.resize(texels.count());
        readInto(i, image);
        facts.means[i] = meanOfFinite(image);
        for (std::size_t t = 0; t < some.size(); ++t) {
            facts.someTexels[i * some.size() + t] = image[some[t]];
        }
        hashes[i] = contentHash(bytesOf(std::span<const Rgb>(image)));
        sink(i, image);
    };
    runFlow({pairs.size(), atOnce, {}, read, {}});
    facts.leftOut = leftOut;
    facts.outside = outside;
    facts.hash = contentHash(bytesOf(std::span<const std::uint64_t>(hashes)));
    return facts;
}

ReadStack readStack(const OpenedInput& input, const SampleSet& samples, Texels texels,
                    const Plane& plane, const ProgressSink& progress) {
    if (input.reader->table() != nullptr) texels = {1, 1};
    ReadStack result{ImageStack(samples.pairs, texels.width, texels.height), {}};
    result.facts = readImages(
        input, samples, texels, plane, 2 * static_cast<std::size_t>(threadsInUse()),
        [&](std::size_t i, std::span<const Rgb> image) {
            std::ranges::copy(image, result.stack.image(i).begin());
        },
        progress);
    return result;
}

}  // namespace abrdf
