// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/sampled_brdf.h"

#include <stdexcept>

namespace abrdf {

SampledBrdf::SampledBrdf(AngularGrid grid, std::vector<Rgb> values)
    : grid_(std::move(grid)), values_(std::move(values)), interpolation_(grid_) {
    if (values_.size() != grid_.pairCount()) {
        throw std::invalid_argument("a sampled BRDF needs a value for each pair of its grid");
    }
}

}  // namespace abrdf
