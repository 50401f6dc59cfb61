// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/model_atlas.h"
#include "abrdf/pixel_type.h"

#include <cstdint>
#include <filesystem>

namespace abrdf {

/// Writes a model atlas as OpenEXR of several parts, one of a kind:
///     rgb             R, G, B of each texel lit and seen from near the normal: what viewers show
///     estimate        deltaE, a bound of each texel's mean Delta E (where it is known)
///     texels          rank, most and scales of each texel
///     coefficients    of each texel: Y.000 ... of luminance, R, G, B of channels and cR, cG of
///                     chroma as far as they have a share, as many as the largest rank
///     luminance,      the basis: a row a line, a number a column; for ranks below the whole one
///     chroma          ("small") where there is one, and the whole one where a texel needs it
///     centers         of each row of the basis, a column a vector
///     rows            of each pair, its row of the basis
/// type: of the coefficients; all else is float. Returns the file's size. Throws
/// std::runtime_error that names the file.
std::uint64_t writeModelAtlas(const std::filesystem::path& path, const ModelAtlas& atlas,
                              PixelType type);

}  // namespace abrdf
