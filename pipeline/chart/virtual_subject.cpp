// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/virtual_subject.h"

#include "stages/train/random_material.h"
#include "stages/train/training_values.h"

namespace abrdf {

Subject virtualSubject(const AngularGrid& grid) {
    constexpr std::uint64_t kSeed = 0xc4a27;  ///< Unlike any that models are trained with.
    const std::vector<VectorPair> pairs = vectorPairs(pairsOf(grid));
    const auto valuesOf = [&](MaterialClass materialClass) {
        Random random(kSeed, 0);
        std::vector<float> values(pairs.size());
        PreparedMaterial(randomMaterial(materialClass, random)).evaluate(pairs, values);
        return values;
    };
    const std::vector<float> warp = valuesOf(MaterialClass::kWoven);
    const std::vector<float> weft = valuesOf(MaterialClass::kAniso);
    Subject subject{"virtual", grid, {}, 0, 0};
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < pairs.size(); ++i) all.push_back(i);
    subject.truth = ImageStack(all, 1, 1);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        subject.truth.image(i)[0] =
            warp[i] * Rgb{0.7F, 0.3F, 0.2F} + weft[i] * Rgb{0.2F, 0.3F, 0.5F};
    }
    return subject;
}

}  // namespace abrdf
