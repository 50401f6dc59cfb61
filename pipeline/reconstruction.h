// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/plan/plan_choice.h"
#include "pipeline/plan/scene_plan.h"
#include "pipeline/read_images.h"
#include "pipeline/train/prior_cache.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What is assumed of images that hold codes of 8 bits.
inline constexpr double kNoiseOfCodes = 0.01;
inline constexpr double kSaturatedCodes = 0.99;

/// A method and everything that it heeds.
struct MethodChoice {
    std::string name = "prior";
    PlanChoice plan;
    ReconstructOptions options;
    /// Relative noise of the samples; nothing: 1 % for 8-bit images, none for float ones.
    std::optional<double> noise;
    /// Value at which samples are clipped, 0: none; nothing: 0.99 for 8-bit images, else none.
    std::optional<double> saturated;
    PriorSource prior;
};

/// A method with its samples of one input, before anything is read.
struct PlannedMethod {
    const Method* method = nullptr;
    SamplePlan plan;
    SampleSet samples;
    AngularGrid input;                 ///< Where the samples come from.
    AngularGrid output;                ///< What is to be filled in.
    std::vector<double> weights = {};  ///< How much its pairs matter; empty: all alike.
    /// Mean CIE 1976 Delta E over what a scene shows, where the plan was chosen for it.
    std::optional<double> expectedError = {};

    /// As headers and reports name the plan.
    std::string planName() const;
};

/// A scene of which only some pairs of the output matter.
struct SceneChoice {
    SceneOutputs outputs;
    /// Did the user leave the plan open? Then as few samples are taken as are worthwhile.
    bool planIsOpen = true;
};

/// scene: null where all pairs of the output matter alike; else a plan that is left open, or
/// greedy, is made for the scene. Throws as planFor(), scenePlan() and samplesFor().
PlannedMethod planMethod(const MethodChoice& choice, const OpenedInput& input,
                         const AngularGrid& output, const ProgressSink& progress,
                         const SceneChoice* scene = nullptr);

/// The mean over all texels of each sample, from the means of the images; a sample that no texel
/// has valid is that of its nearest valid neighbour.
/// images: the pairs of the images, ascending; imageMeans: ReadFacts::means.
std::vector<Rgb> meanSamples(std::span<const std::size_t> images, std::span<const Rgb> imageMeans,
                             const SampleSet& samples);

/// The reconstructor for what was planned, for the material of these images, whose pairs are
/// `images`, ascending.
std::unique_ptr<Reconstructor> buildReconstructor(
    const MethodChoice& choice, const PlannedMethod& planned, const OpenedInput& input,
    std::span<const std::size_t> images, const ReadFacts& facts, const ProgressSink& progress);

}  // namespace abrdf
