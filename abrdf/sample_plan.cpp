// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/sample_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>

namespace abrdf {

namespace {

/// Both slices of one subspace; angles in degrees.
struct SubspaceSlices {
    double thetaLight, thetaView;
    double axialOffset;
    int axialCount;
    double axialStart;
    double diagonalOffset;
    int diagonalCount;
    double diagonalPower;
};

Slice axialOf(const SubspaceSlices& s, int count) {
    return {SliceKind::kAxial,
            radiansFromDegrees(s.thetaLight),
            radiansFromDegrees(s.thetaView),
            radiansFromDegrees(s.axialOffset),
            count,
            radiansFromDegrees(s.axialStart),
            1};
}

Slice diagonalOf(const SubspaceSlices& s, int count) {
    return {SliceKind::kDiagonal,
            radiansFromDegrees(s.thetaLight),
            radiansFromDegrees(s.thetaView),
            radiansFromDegrees(s.diagonalOffset),
            count,
            0,
            s.diagonalPower};
}

/// Scaled counts; a diagonal keeps an odd one, as even ones repeat azimuth differences.
int scaledAxial(int count, double factor) {
    return std::max(1, static_cast<int>(std::lround(count * factor)));
}
int scaledDiagonal(int count, double factor) {
    return std::max(1, 2 * static_cast<int>(std::lround((count * factor - 1) / 2)) + 1);
}

std::vector<LightAndView> samplesOf(std::span<const SubspaceSlices> subspaces, double factor) {
    std::vector<LightAndView> samples;
    for (const SubspaceSlices& s : subspaces) {
        for (const Slice& slice : {axialOf(s, scaledAxial(s.axialCount, factor)),
                                   diagonalOf(s, scaledDiagonal(s.diagonalCount, factor))}) {
            const std::vector<LightAndView> own = samplesOf(slice);
            samples.insert(samples.end(), own.begin(), own.end());
        }
    }
    return samples;
}

/// How many different samples are left once they are snapped to a grid.
class DistinctCount {
  public:
    explicit DistinctCount(const AngularGrid* grid) : grid_(grid) {
        if (grid == nullptr) return;
        lights_.emplace(grid->lights());
        views_.emplace(grid->views());
    }
    std::size_t of(const std::vector<LightAndView>& samples) const {
        if (grid_ == nullptr) return samples.size();
        std::set<std::size_t> pairs;
        for (const LightAndView& s : samples) {
            pairs.insert(grid_->pairIndex(lights_->indexOf(s.light), views_->indexOf(s.view)));
        }
        return pairs.size();
    }

  private:
    const AngularGrid* grid_;
    std::optional<NearestDirection> lights_, views_;
};

/// All slices with their counts scaled by the largest factor that keeps to the bound.
SamplePlan boundedPlan(const std::string& name, std::span<const SubspaceSlices> subspaces,
                       std::size_t bound, const AngularGrid* snapTo) {
    const std::size_t most = bound > 0 ? bound : kPlanSamples;
    const DistinctCount distinct(snapTo);
    SamplePlan plan{bound > 0 ? fmt::format("{}:{}", name, bound) : name, {}, {}};
    for (int percent = bound > kPlanSamples ? 2000 : 200; percent > 1; --percent) {
        plan.samples = samplesOf(subspaces, percent / 100.0);
        if (distinct.of(plan.samples) <= most) return plan;
    }
    throw std::invalid_argument(fmt::format("the plan {} needs at least {} samples, one a slice",
                                            name, 2 * subspaces.size()));
}

// Chosen by search for least error of `prior` on random materials; see tests/bench/README.md.
constexpr std::array kEight = {
    SubspaceSlices{45, 45, 150, 23, 82.5, 247.5, 33, 1},
    SubspaceSlices{45, 75, 120, 19, 52.5, 52.5, 31, 1},
    SubspaceSlices{75, 45, 60, 17, 67.5, 120, 43, 1},
    SubspaceSlices{75, 75, 120, 11, 45, 277.5, 41, 1},
};

/// Design: estimator.md, section 4.
std::array<SubspaceSlices, 16> sixteenSubspaces() {
    constexpr std::array kElevations = {30.0, 45.0, 60.0, 75.0};
    constexpr std::array kOffsets = {60.0,  90.0,  120.0, 150.0, 180.0, 120.0, 90.0,  60.0,
                                     150.0, 180.0, 60.0,  120.0, 90.0,  150.0, 120.0, 90.0};
    std::array<SubspaceSlices, 16> subspaces{};
    for (std::size_t i = 0; i < subspaces.size(); ++i) {
        const auto number = static_cast<double>(i);
        subspaces[i] = {kElevations[i / 4],
                        kElevations[i % 4],
                        kOffsets[i],
                        4,
                        std::fmod(37 * number, 90),
                        std::fmod(67.5 * number, 360),
                        9,
                        1.5};
    }
    return subspaces;
}

}  // namespace

PlanName planNameFrom(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    PlanName name{text.substr(0, colon), 0};
    if (colon == std::string::npos) return name;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, name.bound);
    if (error != std::errc() || rest != end || name.bound < 8 || name.bound > 100000) {
        throw std::invalid_argument(fmt::format(
            "the plan '{}' needs a number of samples from 8 to 100000 after its colon, as {}:204",
            text, name.base));
    }
    return name;
}

SamplePlan posterPlan(const SlicePlan& slices) {
    checkPlan(slices);
    SamplePlan plan{slices.name, {}, slices};
    for (std::size_t s = 0; s < slices.subspaceCount(); ++s) {
        for (const SliceKind kind : {SliceKind::kAxial, SliceKind::kDiagonal}) {
            const int count = kind == SliceKind::kAxial ? slices.axialCount : slices.diagonalCount;
            const std::vector<LightAndView> own = samplesOf(
                Slice{kind, slices.thetaLight(s), slices.thetaView(s), slices.alpha, count, 0, 1});
            plan.samples.insert(plan.samples.end(), own.begin(), own.end());
        }
    }
    return plan;
}

SamplePlan eightPlan(std::size_t bound, const AngularGrid* snapTo) {
    return boundedPlan("eight", kEight, bound, snapTo);
}

SamplePlan sixteenSlicesPlan(std::size_t bound, const AngularGrid* snapTo) {
    return boundedPlan("slices16", sixteenSubspaces(), bound, snapTo);
}

SamplePlan pairsPlan(const std::string& name, const AngularGrid& grid,
                     const std::vector<std::size_t>& pairs) {
    SamplePlan plan{name, {}, {}};
    for (const std::size_t pair : pairs) plan.samples.push_back(grid.pair(pair));
    return plan;
}

}  // namespace abrdf
