// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/reconstruction.h"
#include "stages/stress/stress_case.h"

#include <memory>
#include <optional>
#include <string>

namespace abrdf {

/// A method as a stress trial needs it.
struct StressMethod {
    const Method* method = nullptr;
    SamplePlan plan;  ///< Its own, for trials that bring none.
};

/// The samples that a method gets of a plan: measured pairs of `grid`, or the plan's own places.
SampleSet stressSamples(const StressMethod& method, const StressTrial& trial,
                        const AngularGrid& grid);

/// What floats do to an answer: how far it is from its twin's in longer ones.
struct TwinDifference {
    double condition = 1;  ///< Largest condition number of the twin's systems.
    double deltaE = 0;     ///< Mean CIE 1976 Delta E.
    double relative = 0;   ///< Root of summed squares, relative to the twin's.
};

struct StressOutcome {
    double deltaE = 0;     ///< Mean CIE 1976 Delta E at the trial's exposure; NaN where refused.
    double condition = 1;  ///< Largest condition number of a system that was solved.
    std::optional<TwinDifference> twin;  ///< Where the method has one and it was asked for.
    std::string refusal;                 ///< What the method said instead of answering.
    double largest = 0;     ///< Largest value of the answer, times that of the samples.
    bool isUnreal = false;  ///< A value of the answer is NaN, infinite or negative: a fault.
};

/// Samples the trial's truth with its defects, reconstructs, compares. model: of the samples and
/// of the trial's grid, for methods that need one. A refusal (std::invalid_argument,
/// std::runtime_error) is an outcome.
StressOutcome runStressTrial(const StressMethod& method, const StressTrial& trial,
                             const SampleSet& samples, const AngularGrid& grid,
                             const std::shared_ptr<const PriorModel>& model, std::uint64_t seed,
                             bool withTwin = false);

}  // namespace abrdf
