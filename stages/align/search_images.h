// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/image_stack.h"
#include "stages/align/shift_image.h"

namespace abrdf {

/// Cube roots: differences count about as they are seen, and highlights do not outweigh the rest.
ImageStack cubeRoots(const ImageStack& images);

/// Half the size: the mean of two by two texels.
ImageStack halved(const ImageStack& images);

/// Blurred by (1 2 1) / 4 each way, so that the blur of a shift between texels hardly counts.
ImageStack smoothed(const ImageStack& images, Edges edges);

}  // namespace abrdf
