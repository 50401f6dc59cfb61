// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluated_method.h"

#include "abrdf/for_each_texel.h"
#include "pipeline/chart/method_time.h"
#include "pipeline/convert/unshifted_texels.h"
#include "stages/slice/slice_texels.h"

#include <utility>

namespace abrdf {

EvaluatedMethod runMethod(const MethodChoice& choice, const OpenedInput& input, Texels texels,
                          const PlaneChoice& plane, const SceneChoice* scene,
                          const ProgressSink& progress) {
    const AngularGrid& grid = input.description().grid;
    EvaluatedMethod result;
    result.planned = planMethod(choice, input, grid, progress, scene);
    const SampleSet& samples = result.planned.samples;
    result.found = planeOf(result.planned, plane, input, texels, progress);
    const ReadStack read = readStack(input, samples, texels, result.found.plane, progress);
    const ImageStack& stack = read.stack;
    const auto reconstructor =
        buildReconstructor(choice, result.planned, input, stack.pairs(), read.facts, progress);
    const SlicedTexels sliced = sliceTexels(stack, samples, 0, stack.texelCount());
    const auto all = [&](int, int) {
        return reconstructTexels(sliced.samples, grid, *reconstructor);
    };
    ReconstructedTexels made =
        plane.unshift && result.found.plane.height != 0
            ? UnshiftedTexels(result.found.plane, input.description(), texels, grid, all)
                  .rows(0, texels.height)
            : all(0, texels.height);
    result.abrdfs = std::move(made.abrdfs);
    result.estimates = std::move(made.estimates);
    const ColorTransform toRec709 = input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)");
    forEachTexelBlock(result.abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        toRec709.apply(result.abrdfs[texel]);
    });
    result.microsecondsPerAbrdf =
        timeMethod(*reconstructor, sliced.samples[0], grid.pairCount(), 0.05).oneCore;
    result.multiplyAdds = reconstructor->multiplyAdds();
    result.remark = reconstructor->remark();
    return result;
}

}  // namespace abrdf
