// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/isotropy.h"

#include "abrdf/angular_grid.h"
#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "stages/export/turned_pair.h"
#include "stages/export/value_range.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

namespace abrdf {

namespace {

/// The sums of one pair, over its turns.
struct PairSums {
    double weight = 0;
    double deltaE = 0;
    double turnSquare = 0;
    double square = 0;
    double swapSquare = 0;
    double brdfSquare = 0;
};

std::array<double, 3> channelsOf(Rgb c) {
    return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

PairSums sumsOf(const ExportSource& source, const LightAndView& pair, int azimuths) {
    const TurnedBrdf brdf(source, 1);
    const Rgb mean = TurnedBrdf(source, azimuths).evaluate(pair);
    const auto pi = static_cast<float>(kPi);
    const Lab lab = labFromLinearRec709(pi * mean);
    PairSums sums;
    sums.weight =
        std::cos(pair.view.theta) * std::sin(pair.view.theta) * std::sin(pair.light.theta);
    for (int k = 0; k < azimuths; ++k) {
        const LightAndView there = turnedPair(pair, 2 * kPi * k / azimuths);
        const Rgb value = brdf.evaluate(there);
        const Rgb swapped = brdf.evaluate({there.view, there.light});
        sums.deltaE += deltaE76(lab, labFromLinearRec709(pi * value)) / azimuths;
        for (std::size_t c = 0; c < 3; ++c) {
            const double v = channelsOf(value)[c];
            const double f = v / std::cos(pair.light.theta);
            const double g = channelsOf(swapped)[c] / std::cos(pair.view.theta);
            const double m = channelsOf(mean)[c];
            sums.turnSquare += (v - m) * (v - m);
            sums.square += v * v;
            sums.swapSquare += (f - g) * (f - g) / 4;
            sums.brdfSquare += (f * f + g * g) / 2;
        }
    }
    return sums;
}

}  // namespace

Rgb TurnedBrdf::evaluate(const LightAndView& pair) const {
    Rgb sum;
    int count = 0;
    for (int k = 0; k < azimuths_; ++k) {
        const Rgb value = source_.brdf.evaluate(
            azimuths_ == 1 ? pair : turnedPair(pair, 2 * kPi * k / azimuths_));
        if (!isFinite(value)) continue;
        sum += value;
        ++count;
    }
    if (count == 0) return {};
    const double cosine =
        source_.cosine == Cosine::kKept ? 1 : std::max(0.0, std::cos(pair.light.theta));
    return static_cast<float>(cosine / (kPi * count)) * sum;
}

Symmetries symmetriesOf(const ExportSource& source, int azimuths) {
    const std::vector<Direction> views = ubo81Directions();
    std::vector<PairSums> pairs(6 * views.size());
    forEachTexelBlock(pairs.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double ring = static_cast<double>(i / views.size());
            const Direction light = {radiansFromDegrees(ring == 0 ? 5 : 15 * ring), 0};
            pairs[i] = sumsOf(source, {light, views[i % views.size()]}, azimuths);
        }
    });
    PairSums sum;
    for (const PairSums& pair : pairs) {
        sum.weight += pair.weight;
        sum.deltaE += pair.weight * pair.deltaE;
        sum.turnSquare += pair.weight * pair.turnSquare;
        sum.square += pair.weight * pair.square;
        sum.swapSquare += pair.weight * pair.swapSquare;
        sum.brdfSquare += pair.weight * pair.brdfSquare;
    }
    if (!std::isfinite(sum.deltaE) || !std::isfinite(sum.square)) failPastRange(source);
    const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0; };
    return {ratio(sum.deltaE, sum.weight), ratio(sum.turnSquare, sum.square),
            ratio(sum.swapSquare, sum.brdfSquare)};
}

nlohmann::ordered_json reportOf(const Symmetries& symmetries) {
    return {{"delta_e_over_azimuth", symmetries.turnDeltaE},
            {"share_over_azimuth", symmetries.turnShare},
            {"share_not_reciprocal", symmetries.swapShare}};
}

nlohmann::ordered_json notesOn(const Symmetries& symmetries, double tolerance) {
    const bool isotropic = symmetries.turnDeltaE <= tolerance;
    const std::string azimuth =
        isotropic ? fmt::format(
                        "isotropic: turns of the sample differ by {:.2g} Delta E (up to "
                        "{:g} is allowed); their mean loses {:.3g} % of the energy",
                        symmetries.turnDeltaE, tolerance, 100 * symmetries.turnShare)
                  : fmt::format("anisotropic: turns of the sample differ by {:.2g} Delta E",
                                symmetries.turnDeltaE);
    const std::string reciprocity = fmt::format(
        "not reciprocal: {:.3g} % of the energy, which a program that takes the light for the "
        "viewer gets wrong",
        100 * symmetries.swapShare);
    return {azimuth, reciprocity};
}

}  // namespace abrdf
