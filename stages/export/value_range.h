// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/export/export_brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace abrdf {

[[noreturn]] inline void failPastRange(const ExportSource& source) {
    throw std::runtime_error(fmt::format(
        "{}: has values past what 32-bit floats hold once they are summed; scale the material down",
        source.name));
}

/// Throws std::runtime_error, naming the source, where what is to be written is not finite.
inline void checkRange(std::span<const Rgb> values, const ExportSource& source) {
    if (!std::ranges::all_of(values, isFinite)) failPastRange(source);
}

}  // namespace abrdf
