// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/measures.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "stages/measure/quantile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

constexpr double kHighlightQuantile = 0.995;
constexpr double kSmallestRmse = 1e-9;    // Bounds the PSNR of equal inputs: 228 dB.
constexpr double kSmallestOffset = 1e-6;  // Of `stops`, where half of the measurement is black.

std::array<float, 3> channels(Rgb color) {
    return {color.r, color.g, color.b};
}

double square(double x) {
    return x * x;
}

std::vector<float> measuredValues(std::span<const Rgb> truth) {
    std::vector<float> values;
    values.reserve(3 * truth.size());
    for (const Rgb& color : truth) {
        if (!isFinite(color)) continue;
        for (const float value : channels(color)) values.push_back(std::max(value, 0.0F));
    }
    return values;
}

std::vector<std::size_t> comparedPairs(std::span<const Rgb> truth,
                                       std::span<const std::uint8_t> mask) {
    std::vector<std::size_t> pairs;
    pairs.reserve(truth.size());
    for (std::size_t pair = 0; pair < truth.size(); ++pair) {
        if ((mask.empty() || mask[pair] != 0) && isFinite(truth[pair])) pairs.push_back(pair);
    }
    return pairs;
}

/// The errors of one pair; the squared one is in code values and summed over its channels.
struct PairErrors {
    double deltaE = 0;
    double deltaE2000 = 0;
    double squared = 0;
};

PairErrors displayErrors(Rgb truth, Rgb reconstruction, double exposure) {
    const Rgb shownTruth = static_cast<float>(exposure) * truth;
    const Rgb shown = static_cast<float>(exposure) * reconstruction;
    const Lab labTruth = labFromLinearRec709(shownTruth);
    const Lab lab = labFromLinearRec709(shown);
    PairErrors errors{deltaE76(labTruth, lab), deltaE2000(labTruth, lab)};
    for (std::size_t c = 0; c < 3; ++c) {
        errors.squared +=
            square(255 * (srgbEncoded(channels(shown)[c]) - srgbEncoded(channels(shownTruth)[c])));
    }
    return errors;
}

Measures displayMeasures(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                         std::span<const std::size_t> pairs, double exposure) {
    std::vector<PairErrors> errors(pairs.size());
    forEachTexel(pairs.size(), [&](std::size_t i) {
        errors[i] = displayErrors(truth[pairs[i]], reconstruction[pairs[i]], exposure);
    });

    PairErrors sum;
    for (const PairErrors& error : errors) {
        sum.deltaE += error.deltaE;
        sum.deltaE2000 += error.deltaE2000;
        sum.squared += error.squared;
    }
    const auto count = static_cast<double>(pairs.size());
    const double rmse = std::sqrt(sum.squared / (3 * count));
    // A NaN goes through: it is the first argument of std::max().
    return {sum.deltaE / count, sum.deltaE2000 / count, rmse,
            20 * std::log10(255 / std::max(rmse, kSmallestRmse))};
}

double meanStops(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                 std::span<const std::size_t> pairs, double offset) {
    const double sum = sumOverTexels(pairs.size(), [&](std::size_t i) {
        const auto measured = channels(truth[pairs[i]]);
        const auto restored = channels(reconstruction[pairs[i]]);
        double stops = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            stops += std::abs(std::log2((std::max(restored[c], 0.0F) + offset) /
                                        (std::max(measured[c], 0.0F) + offset)));
        }
        return stops;
    });
    return sum / (3 * static_cast<double>(pairs.size()));
}

}  // namespace

Accuracy measureAccuracy(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                         std::span<const std::uint8_t> mask, const MeasureOptions& options) {
    assert(reconstruction.size() == truth.size());
    assert(mask.empty() || mask.size() == truth.size());
    const std::vector<std::size_t> pairs = comparedPairs(truth, mask);
    if (pairs.empty()) return {};

    const std::vector<float> values = measuredValues(truth);
    const double brightest = quantile(values, kHighlightQuantile);
    const bool black = brightest < std::numeric_limits<float>::min();
    const double highlightExposure = black ? 1 : 1 / brightest;
    const double tenth = 0.1 * quantile(values, 0.5);
    const double offset = tenth > 0 ? tenth : kSmallestOffset;

    return {displayMeasures(truth, reconstruction, pairs, options.exposure),
            displayMeasures(truth, reconstruction, pairs, highlightExposure),
            meanStops(truth, reconstruction, pairs, offset), pairs.size()};
}

std::vector<float> deltaEMap(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                             double exposure) {
    assert(reconstruction.size() == truth.size());
    const auto factor = static_cast<float>(exposure);
    std::vector<float> map(truth.size());
    forEachTexel(map.size(), [&](std::size_t pair) {
        map[pair] =
            static_cast<float>(deltaE76(labFromLinearRec709(factor * truth[pair]),
                                        labFromLinearRec709(factor * reconstruction[pair])));
    });
    return map;
}

}  // namespace abrdf
