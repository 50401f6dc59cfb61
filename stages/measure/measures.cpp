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
constexpr std::size_t kMostValues = 5'600'000;  // Pairs whose channels give quantiles.

std::array<float, 3> channels(Rgb color) {
    return {color.r, color.g, color.b};
}

double square(double x) {
    return x * x;
}

void appendValues(std::span<const Rgb> truth, std::vector<float>& values) {
    for (const Rgb& color : truth) {
        if (!isFinite(color)) continue;
        for (const float value : channels(color)) values.push_back(std::max(value, 0.0F));
    }
}

/// What the full measurement says of how it is to be shown.
struct Shown {
    std::array<double, 2> exposures{1, 1};  ///< Natural, highlight.
    double offset = kSmallestOffset;        ///< Of `stops`.
};

Shown shownFor(const std::vector<float>& values, const MeasureOptions& options) {
    const double brightest = quantile(values, kHighlightQuantile);
    const bool black = brightest < std::numeric_limits<float>::min();
    const double tenth = 0.1 * quantile(values, 0.5);
    return {{options.exposure, black ? 1 : 1 / brightest}, tenth > 0 ? tenth : kSmallestOffset};
}

/// The errors of one pair or a sum of some; squared ones are in code values, of all channels.
struct Errors {
    struct Display {
        double deltaE = 0;
        double deltaE2000 = 0;
        double squared = 0;
    };
    std::array<Display, 2> shown;
    double stops = 0;
    double weight = 0;
    std::size_t pairs = 0;

    void add(const Errors& other, double factor) {
        for (std::size_t i = 0; i < shown.size(); ++i) {
            shown[i].deltaE += factor * other.shown[i].deltaE;
            shown[i].deltaE2000 += factor * other.shown[i].deltaE2000;
            shown[i].squared += factor * other.shown[i].squared;
        }
        stops += factor * other.stops;
        weight += factor * other.weight;
        pairs += other.pairs;
    }
};

Errors::Display displayErrors(Rgb truth, Rgb reconstruction, double exposure) {
    const Rgb shownTruth = static_cast<float>(exposure) * truth;
    const Rgb shown = static_cast<float>(exposure) * reconstruction;
    const Lab labTruth = labFromLinearRec709(shownTruth);
    const Lab lab = labFromLinearRec709(shown);
    Errors::Display errors{deltaE76(labTruth, lab), deltaE2000(labTruth, lab), 0};
    for (std::size_t c = 0; c < 3; ++c) {
        errors.squared +=
            square(255 * (srgbEncoded(channels(shown)[c]) - srgbEncoded(channels(shownTruth)[c])));
    }
    return errors;
}

double stopsOf(Rgb truth, Rgb reconstruction, double offset) {
    double stops = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        stops += std::abs(std::log2((std::max(channels(reconstruction)[c], 0.0F) + offset) /
                                    (std::max(channels(truth)[c], 0.0F) + offset)));
    }
    return stops;
}

Errors errorsOf(Rgb truth, Rgb reconstruction, const Shown& shown) {
    Errors errors;
    for (std::size_t i = 0; i < shown.exposures.size(); ++i) {
        errors.shown[i] = displayErrors(truth, reconstruction, shown.exposures[i]);
    }
    errors.stops = stopsOf(truth, reconstruction, shown.offset);
    errors.weight = 1;
    errors.pairs = 1;
    return errors;
}

double weightOf(std::size_t pair, const MeasureOptions& options) {
    return options.weights.empty() ? 1 : options.weights[pair];
}

Measures measuresOf(const Errors::Display& sum, double weight) {
    const double rmse = std::sqrt(sum.squared / (3 * weight));
    // A NaN goes through: it is the first argument of std::max().
    return {sum.deltaE / weight, sum.deltaE2000 / weight, rmse,
            20 * std::log10(255 / std::max(rmse, kSmallestRmse))};
}

Accuracy accuracyOf(const Errors& sum) {
    if (sum.weight <= 0) return {};
    return {measuresOf(sum.shown[0], sum.weight), measuresOf(sum.shown[1], sum.weight),
            sum.stops / (3 * sum.weight), sum.pairs};
}

/// Of texels that have any compared pair, in one order whatever the number of threads.
TexelMeasures texelMeasures(const std::vector<Errors>& texels) {
    Errors sum;
    std::vector<float> deltaE;
    std::vector<float> lackOfPsnr;
    TexelMeasures result;
    for (const Errors& texel : texels) {
        if (texel.weight <= 0) continue;
        sum.add(texel, 1);
        const Measures natural = measuresOf(texel.shown[0], texel.weight);
        result.deltaE += natural.deltaE;
        result.psnr += natural.psnr;
        if (std::isnan(natural.deltaE)) continue;  // The means are NaN then.
        deltaE.push_back(static_cast<float>(natural.deltaE));
        lackOfPsnr.push_back(static_cast<float>(-natural.psnr));
    }
    result.accuracy = accuracyOf(sum);
    const auto count = static_cast<double>(std::max<std::size_t>(1, deltaE.size()));
    result.deltaE /= count;
    result.psnr /= count;
    result.deltaE95 = quantile(deltaE, 0.95);
    result.psnr95 = -quantile(lackOfPsnr, 0.95);
    return result;
}

}  // namespace

Accuracy measureAccuracy(std::span<const Rgb> truth, std::span<const Rgb> reconstruction,
                         std::span<const std::uint8_t> mask, const MeasureOptions& options) {
    assert(reconstruction.size() == truth.size());
    assert(mask.empty() || mask.size() == truth.size());
    std::vector<float> values;
    appendValues(truth, values);
    const Shown shown = shownFor(values, options);
    Errors sum;
    for (std::size_t pair = 0; pair < truth.size(); ++pair) {
        if ((!mask.empty() && mask[pair] == 0) || !isFinite(truth[pair])) continue;
        const double weight = weightOf(pair, options);
        if (weight > 0) sum.add(errorsOf(truth[pair], reconstruction[pair], shown), weight);
    }
    return accuracyOf(sum);
}

std::vector<TexelMeasures> measureTexels(const AbrdfTile& truth, const AbrdfTile& reconstruction,
                                         std::span<const std::vector<std::uint8_t>> masks,
                                         const MeasureOptions& options) {
    assert(truth.values().size() == reconstruction.values().size());
    const std::size_t texels = truth.texelCount();
    std::vector<float> values;
    const std::size_t step = 1 + truth.values().size() / kMostValues;
    for (std::size_t t = 0; t < texels; t += step) appendValues(truth[t], values);
    const Shown shown = shownFor(values, options);

    std::vector<std::vector<Errors>> sums(masks.size(), std::vector<Errors>(texels));
    forEachTexelBlock(texels, 1, [&](std::size_t t, std::size_t) {
        for (std::size_t pair = 0; pair < truth.valuesPerTexel(); ++pair) {
            const double weight = weightOf(pair, options);
            if (!isFinite(truth[t][pair]) || weight <= 0) continue;
            const Errors errors = errorsOf(truth[t][pair], reconstruction[t][pair], shown);
            for (std::size_t m = 0; m < masks.size(); ++m) {
                if (masks[m][pair] != 0) sums[m][t].add(errors, weight);
            }
        }
    });
    std::vector<TexelMeasures> result;
    for (const std::vector<Errors>& texelSums : sums) result.push_back(texelMeasures(texelSums));
    return result;
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
