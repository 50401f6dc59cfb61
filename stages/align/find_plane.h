// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/image_stack.h"
#include "stages/align/shift_image.h"

#include <vector>

namespace abrdf {

struct PlaneSearch {
    Edges edges = Edges::kPeriodic;
    /// The residual must fall at least by this share of that at height 0: relief about the plane
    /// z = 0 favours small heights a little. 0 .. 1.
    double leastDrop = 0.1;
};

/// The plane z = height in which images of different views agree best.
struct PlaneFit {
    double height = 0;  ///< In texels of the images searched; 0 where none is clearly better.
    double best = 0;    ///< The height of the least residual, accepted or not.
    /// Residual there and at height 0: the mean absolute difference of each image from what its
    /// neighbours in angle predict, over the mean absolute deviation of the images; of cube roots.
    double residual = 0;
    double residualAtZero = 0;

    double drop() const { return residualAtZero > 0 ? 1 - residual / residualAtZero : 0; }
};

/// Coarse to fine, the same for any number of threads. directions: one pair an image. Images of
/// fewer than 16 texels each way, or fewer than five of them, have no plane but 0.
PlaneFit findPlane(const ImageStack& images, const std::vector<LightAndView>& directions,
                   const PlaneSearch& search);

/// Do left and right, top and bottom edges join? True where images differ across the edges hardly
/// more than from one texel to the next.
bool isPeriodic(const ImageStack& images);

}  // namespace abrdf
