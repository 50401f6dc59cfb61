// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/prior_model.h"
#include "abrdf/sample_set.h"
#include "color/rgb.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace abrdf {

/// A prior that is quick to train: 60 materials of each class, on 25 directions.
struct SmallPrior {
    AngularGrid grid;
    SampleSet samples;  ///< Every eleventh pair.
    std::shared_ptr<const PriorModel> model;

    /// A texel's samples of a material.
    std::vector<Rgb> samplesOf(const std::function<Rgb(const LightAndView&)>& material) const;
    /// Its whole ABRDF.
    std::vector<Rgb> abrdfOf(const std::function<Rgb(const LightAndView&)>& material) const;
    /// Of each pair of the grid, which are all distinct, its place among the model's outputs.
    std::vector<std::size_t> rowOf() const;
};

/// The same one for all tests of a program.
const SmallPrior& smallPrior();

/// A coloured plastic: Lambert and a highlight.
Rgb plastic(const LightAndView& pair);

}  // namespace abrdf
