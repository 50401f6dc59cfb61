// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/sample_set.h"
#include "abrdf/slice_plan.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What a method is built from.
struct ReconstructionTask {
    SlicePlan plan;
    SampleSet samples;   ///< In the form the method wished for, of this plan.
    AngularGrid input;   ///< The database's grid.
    AngularGrid output;  ///< The atlas's grid.
};

/// Fills in the pairs that were not measured. Built once a job, then used from any thread.
class Reconstructor {
  public:
    virtual ~Reconstructor() = default;

    /// samples: one texel's values in the order of the task's samples, finite, not negative;
    /// abrdf: one value for each pair of the output grid. May leave negative values.
    virtual void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const = 0;

    /// Multiply-adds a texel, all three channels.
    virtual double multiplyAdds() const = 0;
};

/// A reconstruction method: one file in this folder.
struct Method {
    const char* name;
    const char* description;  ///< One line for --list-methods.
    const char* cost;         ///< In words, for --list-methods.
    SampleWish wish;
    std::unique_ptr<Reconstructor> (*make)(const ReconstructionTask& task);
};

/// All methods, the most accurate first.
std::span<const Method> methods();

/// Throws std::invalid_argument for an unknown name, listing the known ones.
const Method& methodFromName(const std::string& name);

struct ReconstructedTexels {
    AbrdfTile abrdfs;
    std::uint64_t clamped = 0;    ///< Values that came out negative and were set to 0.
    std::uint64_t nonfinite = 0;  ///< Values that came out NaN or infinite and were set to 0.
};

/// The stage: every texel of a tile, in parallel. No negative, infinite or NaN value leaves it.
ReconstructedTexels reconstructTexels(const AbrdfTile& samples, const AngularGrid& output,
                                      const Reconstructor& reconstructor);

}  // namespace abrdf
