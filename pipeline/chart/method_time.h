// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/reconstruct/reconstructor.h"

#include <cstddef>
#include <span>

namespace abrdf {

/// Microseconds an ABRDF: medians of warm repetitions.
struct MethodTime {
    double oneCore = 0;
    double allCores = 0;  ///< By as many threads as the job may use.
};

/// Times a method on copies of one texel's samples, as many at once as it likes. One core and all
/// are timed in turn, so that what else the machine does falls on both.
/// pairs: of the output; seconds: about how long to measure.
MethodTime timeMethod(const Reconstructor& reconstructor, std::span<const Rgb> samples,
                      std::size_t pairs, double seconds);

}  // namespace abrdf
