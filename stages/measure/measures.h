// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "color/rgb.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// How far a reconstruction is from its measurement as an sRGB display shows both, clipped to
/// [0, 1]: the poster's measures.
struct Measures {
    double deltaE = 0;      ///< Mean CIE 1976 colour difference.
    double deltaE2000 = 0;  ///< Mean CIEDE2000 colour difference.
    double rmse = 0;        ///< Of all channels, in 8-bit code values that are not rounded.
    double psnr = 0;        ///< 20 log10(255 / max(rmse, 1e-9)), in dB.
};

struct Accuracy {
    Measures natural;       ///< 1 is shown as 1 (times MeasureOptions::exposure).
    Measures highlight;     ///< The 99.5 % quantile of the full measurement is shown as 1.
    double stops = 0;       ///< Mean |log2((B^ + e) / (B + e))|, e a tenth of the median.
    std::size_t pairs = 0;  ///< Over how many pairs; where it is 0, all measures are 0.
};

struct MeasureOptions {
    double exposure = 1;  ///< Factor on the values in the natural measures, > 0; unitless.
    /// How much each pair counts in all means, >= 0; empty: all alike. Quantile and median are of
    /// the full measurement all the same.
    std::span<const double> weights = {};
};

/// Compares the pairs whose mask is not 0; an empty mask means all. Quantile and median are those
/// of the full measurement all the same. Pairs that `truth` lacks (not finite) are left out; a NaN
/// of the reconstruction is an error that shows: its measures are NaN.
/// Both colours are scene-linear Rec.709, one a pair; the caller converts.
Accuracy measureAccuracy(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                         std::span<const std::uint8_t> mask, const MeasureOptions& options);

/// How well single texels of a map come back, at natural exposure.
struct TexelMeasures {
    Accuracy accuracy;    ///< Over all texels and their pairs.
    double deltaE = 0;    ///< Mean over the texels of their mean CIE 1976 colour difference.
    double deltaE95 = 0;  ///< 95 % of the texels have no larger one.
    double psnr = 0;      ///< Mean over the texels of their PSNR, in dB.
    double psnr95 = 0;    ///< 95 % of the texels have no lower one.
};

/// The same of many texels, one after the other; a result for each mask, all in one pass. masks: a
/// flag a pair, for every texel. Quantile and median of the full measurement are taken from every
/// n-th texel where there are more than 16 million values.
std::vector<TexelMeasures> measureTexels(const AbrdfTile& truth, const AbrdfTile& reconstruction,
                                         std::span<const std::vector<std::uint8_t>> masks,
                                         const MeasureOptions& options);

/// CIE 1976 colour difference of each pair at one exposure; scene-linear Rec.709.
std::vector<float> deltaEMap(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                             double exposure);

}  // namespace abrdf
