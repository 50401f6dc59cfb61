// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What one fuzz target does with any bytes: it may only throw what the readers promise, and that
/// is caught here. Anything else that happens is a fault of theirs.
struct FuzzTarget {
    const char* name;
    void (*run)(std::span<const char> bytes);
    /// Small valid inputs to begin from.
    std::vector<std::string> (*seeds)();
};

/// A target for each reader.
std::span<const FuzzTarget> fuzzTargets();

/// Throws std::out_of_range.
const FuzzTarget& fuzzTargetFromName(const std::string& name);

}  // namespace abrdf
