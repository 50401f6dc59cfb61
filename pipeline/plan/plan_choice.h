// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "abrdf/sample_plan.h"
#include "stages/reconstruct/reconstructor.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What a user says of the samples to take.
struct PlanChoice {
    /// poster, eight, slices16 or greedy, with :N for at most N samples; or a file that
    /// planFromFile() reads, with :N for its first N samples. Empty: the method's own.
    std::string name;
    std::vector<double> elevations = {};  ///< Of the plan poster, degrees; empty: its own.
    std::optional<double> alpha = {};     ///< Of the plan poster, degrees.
    int axial = 0;                        ///< Of the plan poster; 0: its own.
    int diagonal = 0;                     ///< Of the plan poster; 0: its own.
    /// Degrees within which, in both directions, a measured pair stands for a sample; nothing:
    /// kFileSnap for files, no bound for named plans.
    std::optional<double> snap = {};

    /// True where the user said nothing of it.
    bool isOpen() const {
        return name.empty() && elevations.empty() && !alpha && axial == 0 && diagonal == 0;
    }
};

/// Every direction up to 75 degrees has a measured one of UBO2003's 81 this near.
inline constexpr double kFileSnap = 10;

/// Throws std::invalid_argument for what no input could make right: an unknown plan, numbers that
/// no plan has.
void checkPlanChoice(const Method& method, const PlanChoice& choice);

/// The plan for a method over measured directions. present: one flag a pair of these, empty: all
/// are. anywhere: samples need not be snapped to these.
/// `published` can only use the poster's plan: with
/// another one it takes that with as many samples, and warns. A greedy plan for a grid that is not
/// UBO2003's is computed (ticks: phase "plan") and kept in the cache.
/// Throws std::invalid_argument for an unknown plan and for impossible numbers, std::runtime_error
/// as planFromFile() and snapPlan().
SamplePlan planFor(const Method& method, const PlanChoice& choice, const AngularGrid& measured,
                   std::span<const std::uint8_t> present, bool anywhere,
                   const ProgressSink& progress, const MessageSink& warn);

}  // namespace abrdf
