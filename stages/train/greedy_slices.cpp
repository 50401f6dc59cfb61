// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/greedy_slices.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/goniometer.h"
#include "stages/train/conditioned_class.h"
#include "stages/train/greedy_pairs.h"

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace {

/// The samples of all slices, one slice after the other.
struct SliceSamples {
    std::vector<LightAndView> pairs;
    std::vector<Eigen::Index> first;  ///< Of each slice.

    explicit SliceSamples(const std::vector<Slice>& slices) {
        for (const Slice& slice : slices) {
            first.push_back(static_cast<Eigen::Index>(pairs.size()));
            const std::vector<LightAndView> own = samplesOf(slice);
            pairs.insert(pairs.end(), own.begin(), own.end());
        }
    }
};

/// One class of materials with the covariance of each slice's own samples.
class SliceScores {
  public:
    SliceScores(ConditionedClass& materials, const std::vector<Slice>& slices,
                const SliceSamples& samples)
        : materials_(materials), first_(samples.first) {
        own_.resize(slices.size());
        forEachTexelBlock(slices.size(), kBlock, [&](std::size_t begin, std::size_t end) {
            for (std::size_t s = begin; s < end; ++s) {
                own_[s] = materials.ownCovariance(first_[s], slices[s].count);
            }
        });
    }

    void addScores(std::vector<double>& scores) const {
        forEachTexelBlock(own_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
            for (std::size_t s = begin; s < end; ++s) {
                scores[s] += materials_.scoreOf(first_[s], own_[s]);
            }
        });
    }

    void choose(Eigen::Index sample) {
        const ConditionedClass::Downdate& downdate = materials_.choose(sample);
        forEachTexelBlock(own_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
            for (std::size_t s = begin; s < end; ++s) {
                const Eigen::VectorXd gain =
                    downdate.gain.segment(first_[s], own_[s].cols()).cast<double>();
                own_[s] -= static_cast<double>(downdate.divisor) * gain * gain.transpose();
            }
        });
    }

  private:
    static constexpr std::size_t kBlock = 16;
    ConditionedClass& materials_;
    const std::vector<Eigen::Index>& first_;
    std::vector<Eigen::MatrixXd> own_;
};

/// Samples, and turns at their price: of the slice itself and of the way to it from the nearest
/// slice that is chosen.
double costOf(const Slice& slice, const std::vector<Slice>& chosen, double price) {
    const std::vector<LightAndView> samples = samplesOf(slice);
    auto cost = static_cast<double>(samples.size());
    if (price <= 0) return cost;
    Radians way = chosen.empty() ? 0 : 1e9;
    for (const Slice& other : chosen) {
        Goniometer goniometer;
        goniometer.moveTo(samplesOf(other).front());
        way = std::min(way, goniometer.travelTo(samples.front()).sum());
    }
    std::vector<LightAndView> swept;
    for (const std::size_t i : sweptOrder({samples})) swept.push_back(samples[i]);
    return cost + price * (travelOf(swept).sum() + way) / (2 * kPi);
}

}  // namespace

std::vector<Slice> slicesOf(const SliceFamily& family) {
    std::vector<Radians> sorted = family.elevations;
    std::ranges::sort(sorted);
    const bool areDistinct = std::ranges::adjacent_find(sorted, [](Radians a, Radians b) {
                                 return b - a < radiansFromDegrees(1e-3);
                             }) == sorted.end();
    const bool areAngles = !sorted.empty() && std::ranges::all_of(sorted, [](Radians theta) {
        return theta > 0 && theta < kPi / 2;
    });
    if (!areDistinct || !areAngles) {
        throw std::invalid_argument(
            "slices need elevations above 0 and below 90 degrees, none of them twice, as 15,45,75");
    }
    const auto isCount = [](int count) { return count >= 1 && count <= 360; };
    if (!std::ranges::all_of(family.axialCounts, isCount) ||
        !std::ranges::all_of(family.diagonalCounts, isCount) || !isCount(family.offsets)) {
        throw std::invalid_argument(
            "a slice holds 1 to 360 samples, and there are 1 to 360 offsets");
    }
    std::vector<Slice> slices;
    for (const Radians thetaLight : family.elevations) {
        for (const Radians thetaView : family.elevations) {
            for (int k = 0; k < family.offsets; ++k) {
                const Radians offset = 2 * kPi * k / family.offsets;
                for (const int count : family.axialCounts) {
                    // Half a step further as well: an anisotropic material shows others there.
                    for (const Radians start : {0.0, kPi / count}) {
                        slices.push_back(
                            {SliceKind::kAxial, thetaLight, thetaView, offset, count, start, 1});
                    }
                }
                for (const int count : family.diagonalCounts) {
                    slices.push_back(
                        {SliceKind::kDiagonal, thetaLight, thetaView, offset, count, 0, 1.5});
                }
            }
        }
    }
    return slices;
}

GreedySlices greedySlices(const AngularGrid& grid, const std::vector<Slice>& slices,
                          const GreedySliceOptions& options, const ProgressSink& progress) {
    return greedySlices(grid, watchedPairs(grid, options.seed), slices, options, progress);
}

GreedySlices greedySlices(const AngularGrid& grid, const WatchedPairs& watched,
                          const std::vector<Slice>& slices, const GreedySliceOptions& options,
                          const ProgressSink& progress) {
    const SliceSamples samples(slices);
    std::vector<ConditionedClass> classes =
        conditionedClasses(grid, watched, samples.pairs, {options.materials, options.seed});
    GreedySlices choice;
    if (options.free) {
        const GreedyChoice free =
            greedyPairs(classes, GreedyOptions{.count = options.count}, progress);
        choice.freeDeviation = free.deviation;
        for (const std::size_t i : free.pairs) choice.freeSamples.push_back(samples.pairs[i]);
    }
    std::vector<SliceScores> scorers;
    for (ConditionedClass& c : classes) scorers.emplace_back(c, slices, samples);
    std::vector<bool> isChosen(slices.size(), false);
    for (std::size_t taken = 0;;) {
        std::vector<double> scores(slices.size(), 0);
        for (const SliceScores& scorer : scorers) scorer.addScores(scores);
        std::size_t best = slices.size();
        double most = -1;
        for (std::size_t s = 0; s < slices.size(); ++s) {
            const auto count = static_cast<std::size_t>(slices[s].count);
            if (isChosen[s] || taken + count > options.count) continue;
            const double worth = scores[s] / costOf(slices[s], choice.slices, options.travel);
            if (worth <= most) continue;
            most = worth;
            best = s;
        }
        if (best == slices.size()) break;
        isChosen[best] = true;
        choice.slices.push_back(slices[best]);
        for (int k = 0; k < slices[best].count; ++k) {
            for (SliceScores& scorer : scorers) scorer.choose(samples.first[best] + k);
            choice.deviation.push_back(uncertaintyOf(classes).deviation);
        }
        taken += static_cast<std::size_t>(slices[best].count);
        if (progress) progress({"plan", "samples", taken, options.count});
    }
    if (choice.slices.empty()) {
        throw std::invalid_argument("the plan has too few samples for a single slice");
    }
    return choice;
}

}  // namespace abrdf
