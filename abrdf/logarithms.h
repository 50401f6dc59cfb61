// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace abrdf {

/// portable::log() of normal values > 0, in place, with the widest registers of the processor: its
/// bits on each.
void takeLogarithms(std::span<float> values);

}  // namespace abrdf
