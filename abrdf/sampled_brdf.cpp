// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/sampled_brdf.h"

#include <stdexcept>

namespace abrdf {

SampledBrdf::SampledBrdf(AngularGrid grid, std::vector<Rgb> values)
    : grid_(std::move(grid)),
      values_(std::move(values)),
      lights_(grid_.lights()),
      views_(grid_.views()) {
    if (values_.size() != grid_.pairCount()) {
        throw std::invalid_argument("a sampled BRDF needs a value for each pair of its grid");
    }
}

Rgb SampledBrdf::evaluate(const LightAndView& pair) const {
    const std::vector<WeightedPair> terms = pairWeights(grid_, lights_, views_, pair);
    if (terms.size() == 1) return values_[terms[0].pair];  // A node, to the last bit.
    Rgb sum;
    for (const WeightedPair& term : terms) sum += term.weight * values_[term.pair];
    return sum;
}

}  // namespace abrdf
