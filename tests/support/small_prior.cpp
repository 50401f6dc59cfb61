// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/small_prior.h"

#include "abrdf/pair_features.h"
#include "stages/slice/choose_samples.h"
#include "stages/train/train_prior.h"

#include <cmath>

namespace abrdf {

std::vector<Rgb> SmallPrior::samplesOf(
    const std::function<Rgb(const LightAndView&)>& material) const {
    std::vector<Rgb> values;
    for (const LightAndView& pair : samples.directions) values.push_back(material(pair));
    return values;
}

std::vector<Rgb> SmallPrior::abrdfOf(
    const std::function<Rgb(const LightAndView&)>& material) const {
    std::vector<Rgb> values;
    for (const LightAndView& pair : pairsOf(grid)) values.push_back(material(pair));
    return values;
}

std::vector<std::size_t> SmallPrior::rowOf() const {
    return distinctPairs(pairsOf(grid)).rowOf;
}

const SmallPrior& smallPrior() {
    static const SmallPrior kPrior = [] {
        SmallPrior prior;
        std::vector<Direction> directions = {{0, 0}};
        for (const Direction& d : regularDirections(4, 8)) {
            if (d.theta > 0) directions.push_back(d);
        }
        prior.grid = AngularGrid(directions);
        SamplePlan plan;
        for (std::size_t pair = 3; pair < prior.grid.pairCount(); pair += 11) {
            plan.samples.push_back(prior.grid.pair(pair));
        }
        prior.samples = chooseSamples(plan, prior.grid, SampleWish::kMeasuredPairs);
        prior.model = std::make_shared<const PriorModel>(
            trainPrior(prior.samples.directions, pairsOf(prior.grid), {60, 1}, {}));
        return prior;
    }();
    return kPrior;
}

Rgb plastic(const LightAndView& pair) {
    const Imath::V3d half =
        (vectorFromDirection(pair.light) + vectorFromDirection(pair.view)).normalized();
    const double body = std::cos(pair.light.theta);
    const double highlight = 0.8 * std::pow(std::max(half.z, 0.0), 40);
    return {static_cast<float>(0.4 * body + highlight), static_cast<float>(0.2 * body + highlight),
            static_cast<float>(0.05 * body + highlight)};
}

}  // namespace abrdf
