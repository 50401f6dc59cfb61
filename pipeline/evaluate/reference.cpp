// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/reference.h"

#include "abrdf/for_each_texel.h"
#include "pipeline/input_samples.h"
#include "stages/slice/slice_texels.h"

namespace abrdf {

std::vector<std::uint8_t> Reference::maskWithout(const std::vector<std::size_t>& excluded) const {
    std::vector<std::uint8_t> pairs = present;
    for (const std::size_t pair : excluded) pairs[pair] = 0;
    return pairs;
}

Reference readReference(const OpenedInput& input, Texels texels, const Plane& plane,
                        const ProgressSink& progress) {
    const BtfDescription& description = input.description();
    const SampleSet everything =
        samplesFor(methodFromName("measured"), {}, input, description.grid);
    const ImageStack stack = readStack(input, everything, texels, plane, progress).stack;
    Reference reference{sliceTexels(stack, everything, 0, stack.texelCount()).samples, plane,
                        description.present};
    const ColorTransform toRec709 = input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)");
    forEachTexelBlock(reference.truth.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        toRec709.apply(reference.truth[texel]);
        // What has no measurement is not compared, whatever filled it.
        for (std::size_t i = 0; plane.height != 0 && i < stack.pairs().size(); ++i) {
            const Rgb measured = stack.image(i)[texel];
            if (!isFinite(measured)) reference.truth[texel][stack.pairs()[i]] = measured;
        }
    });
    return reference;
}

}  // namespace abrdf
