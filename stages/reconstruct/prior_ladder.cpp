// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_ladder.h"

#include "abrdf/random.h"
#include "abrdf/scene_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abrdf {

namespace {

constexpr std::size_t kProbes = 192;
constexpr std::uint64_t kProbeSeed = 0x9206e5;

std::vector<DisplayLab> labsOf(std::span<const Rgb> colors, float exposure) {
    std::vector<DisplayLab> labs(colors.size());
    displayLabs(colors.data(), colors.size(), exposure, labs.data());
    return labs;
}

std::vector<DisplayLab> labsOf(const TexelModel& model, const TexelCodes& codes, float exposure) {
    std::vector<Rgb> colors(codes.count() * model.pairs());
    model.evaluate(codes, colors);
    return labsOf(colors, exposure);
}

/// Mean difference over all outputs, at most, as far as some of them tell: two standard errors
/// above their mean.
float mostMeanDifference(std::span<const DisplayLab> a, std::span<const DisplayLab> b) {
    const auto n = static_cast<float>(a.size());
    float sum = 0;
    float squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const float difference = displayDifference(a[i], b[i]);
        sum += difference;
        squares += difference * difference;
    }
    const float mean = sum / n;
    const float variance = std::max(squares / n - mean * mean, 0.0F);
    return mean + 2 * std::sqrt(variance / n);
}

/// Some of the texels, at one rank.
TexelCodes someOf(const TexelCodes& codes, std::span<const std::size_t> texels,
                  std::uint16_t rank) {
    TexelCodes some;
    some.stride = codes.stride;
    some.ranks.assign(texels.size(), rank);
    for (const std::size_t t : texels) some.scales.push_back(codes.scales[t]);
    const auto pick = [&](const std::vector<float>& from, std::vector<float>& to) {
        for (std::size_t i = 0; i < texels.size() && !from.empty(); ++i) {
            const auto begin = from.begin() + static_cast<std::ptrdiff_t>(texels[i] * codes.stride);
            to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(codes.stride));
        }
    };
    for (std::size_t i = 0; i < 4; ++i) pick(codes.logs[i], some.logs[i]);
    for (std::size_t c = 0; c < 2; ++c) pick(codes.chroma[c], some.chroma[c]);
    return some;
}

}  // namespace

std::vector<std::size_t> probesOf(std::size_t pairs, std::span<const double> weights) {
    if (!weights.empty()) return spreadByWeight(weights, kProbes);
    const std::size_t count = std::min(kProbes, pairs);
    Random random(kProbeSeed, pairs);
    std::vector<std::size_t> probes;
    for (std::size_t i = 0; i < count; ++i) {
        // One somewhere in each piece: an even step would meet the same views again and again.
        const std::size_t begin = i * pairs / count;
        probes.push_back(begin + random.below((i + 1) * pairs / count - begin));
    }
    return probes;
}

PriorLadder::PriorLadder(LadderParts parts) : parts_(std::move(parts)) {
    double squares = 0;
    for (const double cosine : parts_.sampleCosines) squares += cosine * cosine;
    for (const double cosine : parts_.sampleCosines) {
        lambertWeights_.push_back(static_cast<float>(cosine / std::max(squares, 1e-12)));
    }
}

Rgb PriorLadder::lambertColor(std::span<const Rgb> samples) const {
    Rgb color;
    for (std::size_t k = 0; k < samples.size(); ++k) color += lambertWeights_[k] * samples[k];
    return color;
}

std::vector<float> PriorLadder::leftOutErrors(const TexelCodes& whole,
                                              std::span<const Rgb> samples) const {
    const std::size_t count = parts_.sampleCosines.size();
    const std::vector<DisplayLab> predicted = labsOf(parts_.leaveOut, whole, parts_.exposure);
    const std::vector<DisplayLab> measured = labsOf(samples, parts_.exposure);
    std::vector<float> errors;
    for (std::size_t t = 0; t < whole.count(); ++t) {
        float sum = 0;
        for (std::size_t k = 0; k < count; ++k) {
            sum += parts_.sampleShares[k] *
                   displayDifference(predicted[t * count + k], measured[t * count + k]);
        }
        errors.push_back(parts_.errorScale * sum);
    }
    return errors;
}

void PriorLadder::choose(const TexelCodes& whole, TexelCodes& projected,
                         std::span<const Rgb> samples, std::span<float> deltaE) const {
    const std::vector<float> leftOut = leftOutErrors(whole, samples);
    const std::size_t probes = parts_.wholeProbes.pairs();
    const std::vector<DisplayLab> wanted = labsOf(parts_.wholeProbes, whole, parts_.exposure);
    std::vector<std::size_t> open;
    // No model helps a texel whose samples contradict one another: it takes the largest at once.
    for (std::size_t t = 0; t < whole.count(); ++t) {
        deltaE[t] = leftOut[t];
        projected.ranks[t] = parts_.ranks.back();
        if (parts_.tolerance <= 0 || leftOut[t] <= parts_.tolerance) open.push_back(t);
    }
    const std::size_t count = parts_.sampleCosines.size();
    for (const std::uint16_t rank : parts_.ranks) {
        if (open.empty()) break;
        TexelCodes some = someOf(projected, open, rank);
        for (std::size_t i = 0; i < open.size() && rank == kConstantRank; ++i) {
            some.scales[i].channel = lambertColor(samples.subspan(open[i] * count, count));
        }
        const std::vector<DisplayLab> labs = labsOf(parts_.probes, some, parts_.exposure);
        std::vector<std::size_t> still;
        for (std::size_t i = 0; i < open.size(); ++i) {
            const std::size_t t = open[i];
            const float left = mostMeanDifference(std::span(labs).subspan(i * probes, probes),
                                                  std::span(wanted).subspan(t * probes, probes));
            deltaE[t] = std::sqrt(leftOut[t] * leftOut[t] + left * left);
            if (parts_.tolerance > 0 && deltaE[t] > parts_.tolerance) {
                still.push_back(t);
                continue;
            }
            projected.ranks[t] = rank;
            if (rank == kConstantRank) projected.scales[t] = some.scales[i];
        }
        open = std::move(still);
    }
}

double PriorLadder::multiplyAdds(std::size_t step) const {
    double sum = parts_.leaveOut.multiplyAdds(parts_.leaveOut.columns());
    if (parts_.wholeProbes.pairs() == 0) return sum;
    sum += parts_.wholeProbes.multiplyAdds(parts_.wholeProbes.columns());
    for (std::size_t s = 0; s <= step; ++s) sum += parts_.probes.multiplyAdds(parts_.ranks[s]);
    return sum;
}

}  // namespace abrdf
