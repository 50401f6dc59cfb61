// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/reconstruct/reconstructor.h"

namespace abrdf {

/// A task of 9 directions and 12 samples with a model of the prior that is trained in a moment: an
/// execution of a fuzz target is to take milliseconds.
const ReconstructionTask& smallTask();

/// The bytes of its model as a file.
std::string smallModelBytes();

/// The stage on `texels` texels of `samples`; checks that what comes out is light, and bounded.
void reconstructAndCheck(const Reconstructor& reconstructor, const AngularGrid& output,
                         std::span<const Rgb> samples, std::size_t texels);

}  // namespace abrdf
