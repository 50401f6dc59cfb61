// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What one fuzz target does with any bytes: it may only throw what the code under test promises,
/// and that is caught here. Anything else that happens is a fault of theirs.
struct FuzzTarget {
    const char* name;
    void (*run)(std::span<const char> bytes);
    /// Small valid inputs to begin from.
    std::vector<std::string> (*seeds)();
};

// One file each.
std::span<const FuzzTarget> readerTargets();  ///< A target for each database format.
std::span<const FuzzTarget> atlasTargets();   ///< Atlases, look-ups in them, environments.
std::span<const FuzzTarget> jobTargets();     ///< Job files, plans, models, journals, reports.
std::span<const FuzzTarget> mergeTargets();   ///< Shards of an atlas.
std::span<const FuzzTarget> methodTargets();  ///< Reconstruction: options and samples.

/// All of them.
std::vector<FuzzTarget> fuzzTargets();

/// Throws std::out_of_range.
FuzzTarget fuzzTargetFromName(const std::string& name);

/// A file of this name with these bytes, in a folder of this process, which lasts.
std::filesystem::path fuzzFile(const std::string& name, std::span<const char> bytes);

/// Ends the program: what was promised does not hold.
void fuzzCheck(bool holds, const char* promise);

}  // namespace abrdf
