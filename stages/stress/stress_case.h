// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/random.h"
#include "abrdf/sample_plan.h"
#include "stages/stress/stress_material.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What a method is given at one step of a case, and what it ought to answer.
struct StressTrial {
    StressMaterial truth;
    /// What the camera says of each nominal pair; NaN, infinite or negative: not a light, as a
    /// damaged pixel. Empty: the truth.
    std::function<Rgb(const LightAndView& pair, Random& random)> measured;
    /// One flag a sample: is it there? Empty: all are.
    std::function<std::vector<bool>(std::span<const LightAndView> samples, Random& random)> kept;
    std::optional<SamplePlan> plan;   ///< Instead of the run's.
    bool exactPlaces = false;         ///< Is it photographed where the plan says, off the grid?
    std::optional<AngularGrid> grid;  ///< Where answers are wanted, instead of the run's.
    double leastTheta = 0;            ///< Errors count where light or view is at least so steep.
    double exposure = 1;              ///< Factor on the values at which errors are meant.
    double noise = 0;                 ///< As ReconstructOptions has them.
    double saturated = 0;
};

struct StressStep {
    double value = 0;   ///< On the case's axis.
    std::string label;  ///< "5 %"
};

/// One way in which the world fails, from harmless to hopeless.
struct StressCase {
    std::string name;   ///< "noise"
    std::string title;  ///< "multiplicative noise of the samples"
    std::string axis;   ///< "deviation", with its unit.
    /// Does it happen to any material, or does it bring its own?
    bool ofAnyMaterial = true;
    /// Are the steps kinds of one thing, of which none is more harmful by its place?
    bool kindsOnly = false;
    std::vector<StressStep> steps;
    /// The trial at a step; `material` is not looked at where the case brings its own.
    std::function<StressTrial(const StressMaterial& material, double value)> trial;
    /// Are answers held beside those of the methods' twins in longer floats? For grey materials.
    bool hasTwin = false;
};

/// All cases. A new one is a line in a file of this folder.
std::vector<StressCase> stressCases();

// The pages of the suite; stressCases() joins them.
std::vector<StressCase> noiseCases();
std::vector<StressCase> highlightCases();
std::vector<StressCase> rangeCases();
std::vector<StressCase> missingCases();
std::vector<StressCase> angleCases();
std::vector<StressCase> planCases();
std::vector<StressCase> degenerateCases();
std::vector<StressCase> colorCases();
std::vector<StressCase> grazingCases();
std::vector<StressCase> spatialCases();
std::vector<StressCase> numberCases();
std::vector<StressCase> conditioningCases();

/// Steps whose labels are their values times `factor` with `unit` behind.
std::vector<StressStep> stepsOf(const std::vector<double>& values, double factor = 1,
                                const std::string& unit = "");

/// The first step at which an error exceeds twice that of step 0 or 3 Delta E, whichever is
/// larger; NaN is beyond any. Nothing where none does.
std::optional<std::size_t> breakdownStep(std::span<const double> errors);

}  // namespace abrdf
