// SPDX-License-Identifier: BSD-3-Clause
//
// `published`: J. Filip, "Restoring illumination and view dependent data from sparse samples".
// Each subspace (theta_i, theta_v) is the sum of its axial and its diagonal slice, scaled to their
// range; subspaces that were not measured are interpolated by radial basis functions.
#include "stages/reconstruct/rbf_weights.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace abrdf {

namespace {

constexpr std::size_t kSubspaces = 4;

/// Where an azimuth falls between two samples of a slice that closes on itself.
struct SlicePlace {
    std::uint32_t before = 0;
    std::uint32_t after = 0;
    float share = 0;  ///< Of `after`, 0 .. 1.

    Rgb in(std::span<const Rgb> slice) const {
        return slice[before] + share * (slice[after] - slice[before]);
    }
};

SlicePlace slicePlace(Radians azimuth, int count) {
    const double place = wrappedAzimuth(azimuth) / (2 * kPi) * count;
    const auto before = static_cast<std::uint32_t>(place) % static_cast<std::uint32_t>(count);
    return {before, (before + 1) % static_cast<std::uint32_t>(count),
            static_cast<float>(place - std::floor(place))};
}

/// The positions along both slices that make the value at (phi_i, phi_v), both in 0 .. 2 pi:
///     u = (phi_i + phi_v - alpha) / 2,   w = (phi_v - phi_i + alpha) / 2
struct TorusPlace {
    SlicePlace axial;
    SlicePlace diagonal;
};

TorusPlace torusPlace(Radians phiLight, Radians phiView, const SlicePlan& plan) {
    const Radians light = wrappedAzimuth(phiLight);
    const Radians view = wrappedAzimuth(phiView);
    return {slicePlace((light + view - plan.alpha) / 2, plan.axialCount),
            slicePlace((view - light + plan.alpha) / 2, plan.diagonalCount)};
}

Rgb channelMin(Rgb a, Rgb b) {
    return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)};
}
Rgb channelMax(Rgb a, Rgb b) {
    return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}
Rgb product(Rgb a, Rgb b) {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}

/// B^ = gain v + offset a channel, which is vhat (M - m) + m.
struct Normalization {
    Rgb gain;
    Rgb offset;
};

/// One channel: v spans low .. high over the subspace, the slices span m .. M. Where v is constant
/// (a Lambertian) there is nothing to scale: the middle of m .. M, which are equal then.
void normalizeChannel(float low, float high, float m, float M, float& gain, float& offset) {
    const float range = high - low;
    if (range > 1e-6F * std::max(std::abs(high), std::abs(low))) {
        gain = (M - m) / range;
        offset = m - gain * low;
    } else {
        gain = 0;
        offset = 0.5F * (m + M);
    }
}

class Published : public Reconstructor {
  public:
    explicit Published(const ReconstructionTask& task) : plan_(task.plan) {
        checkPlan(plan_);
        placeKnots();
        placeOutputs(task.output);
    }

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const override {
        std::array<Normalization, kSubspaces> norms;
        for (std::size_t s = 0; s < kSubspaces; ++s) norms[s] = normalization(slicesOf(samples, s));
        std::vector<Rgb> axial(static_cast<std::size_t>(plan_.axialCount));
        std::vector<Rgb> diagonal(static_cast<std::size_t>(plan_.diagonalCount));
        for (const ElevationPair& group : groups_) {
            // All four subspaces look up the same places, so their slices are summed first:
            // sum_s weight_s (gain_s (s_A(u) + s_D(w)) + offset_s).
            std::ranges::fill(axial, Rgb{});
            std::ranges::fill(diagonal, Rgb{});
            Rgb offset;
            for (std::size_t s = 0; s < kSubspaces; ++s) {
                const Slices slices = slicesOf(samples, s);
                const Rgb gain = group.weights[s] * norms[s].gain;
                offset += group.weights[s] * norms[s].offset;
                for (std::size_t k = 0; k < axial.size(); ++k) {
                    axial[k] += product(gain, slices.axial[k]);
                }
                for (std::size_t k = 0; k < diagonal.size(); ++k) {
                    diagonal[k] += product(gain, slices.diagonal[k]);
                }
            }
            for (const Output& output : group.outputs) {
                abrdf[output.pair] =
                    output.place.axial.in(axial) + output.place.diagonal.in(diagonal) + offset;
            }
        }
    }

    double multiplyAdds() const override {
        const auto samples = static_cast<double>(kSubspaces * plan_.samplesPerSubspace());
        double sum = 2 * static_cast<double>(kSubspaces * knots_.size());
        for (const ElevationPair& group : groups_) {
            sum += samples + 4 * static_cast<double>(group.outputs.size());
        }
        return 3 * sum;
    }

    double modelBytes() const override {
        return static_cast<double>(kSubspaces * plan_.samplesPerSubspace() * sizeof(Rgb));
    }

    double condition() const override { return condition_; }

  private:
    struct Slices {
        std::span<const Rgb> axial;
        std::span<const Rgb> diagonal;
    };
    struct Output {
        std::size_t pair;
        TorusPlace place;
    };
    /// All outputs of one (theta_i, theta_v): one set of weights for the four subspaces.
    struct ElevationPair {
        std::array<float, kSubspaces> weights{};
        std::vector<Output> outputs;
    };

    Slices slicesOf(std::span<const Rgb> samples, std::size_t subspace) const {
        const auto axialCount = static_cast<std::size_t>(plan_.axialCount);
        const auto own =
            samples.subspan(subspace * plan_.samplesPerSubspace(), plan_.samplesPerSubspace());
        return {own.first(axialCount), own.subspan(axialCount)};
    }

    /// v is linear between the knots u_j, w_k, so its extremes over the subspace are at knots.
    void placeKnots() {
        for (int j = 0; j < plan_.axialCount; ++j) {
            for (int k = 0; k < plan_.diagonalCount; ++k) {
                const Radians u = 2 * kPi * j / plan_.axialCount;
                const Radians w = 2 * kPi * k / plan_.diagonalCount;
                knots_.push_back(torusPlace(u - w + plan_.alpha, u + w, plan_));
            }
        }
    }

    void placeOutputs(const AngularGrid& grid) {
        Eigen::MatrixX2d nodes(kSubspaces, 2);
        for (std::size_t s = 0; s < kSubspaces; ++s) {
            nodes.row(static_cast<Eigen::Index>(s)) << plan_.thetaLight(s), plan_.thetaView(s);
        }
        const RbfWeights rbf(nodes);
        condition_ = rbf.condition();
        std::map<std::pair<Radians, Radians>, std::size_t> groupOf;
        for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
            const LightAndView target = grid.pair(pair);
            const auto [group, isNew] =
                groupOf.try_emplace({target.light.theta, target.view.theta}, groups_.size());
            if (isNew) {
                const Eigen::VectorXd weights = rbf.at({target.light.theta, target.view.theta});
                ElevationPair elevations;
                for (std::size_t s = 0; s < kSubspaces; ++s) {
                    elevations.weights[s] =
                        static_cast<float>(weights(static_cast<Eigen::Index>(s)));
                }
                groups_.push_back(elevations);
            }
            groups_[group->second].outputs.push_back(
                {pair, torusPlace(target.light.phi, target.view.phi, plan_)});
        }
    }

    Normalization normalization(const Slices& slices) const {
        Rgb m = slices.axial[0];
        Rgb M = m;
        for (const auto& slice : {slices.axial, slices.diagonal}) {
            for (const Rgb& value : slice) {
                m = channelMin(m, value);
                M = channelMax(M, value);
            }
        }
        const auto sumAt = [&](const TorusPlace& place) {
            return place.axial.in(slices.axial) + place.diagonal.in(slices.diagonal);
        };
        Rgb low = sumAt(knots_[0]);
        Rgb high = low;
        for (const TorusPlace& knot : knots_) {
            const Rgb v = sumAt(knot);
            low = channelMin(low, v);
            high = channelMax(high, v);
        }
        Normalization n;
        normalizeChannel(low.r, high.r, m.r, M.r, n.gain.r, n.offset.r);
        normalizeChannel(low.g, high.g, m.g, M.g, n.gain.g, n.offset.g);
        normalizeChannel(low.b, high.b, m.b, M.b, n.gain.b, n.offset.b);
        return n;
    }

    SlicePlan plan_;
    double condition_ = 1;
    std::vector<TorusPlace> knots_;
    std::vector<ElevationPair> groups_;
};

}  // namespace

std::unique_ptr<Reconstructor> makePublished(const ReconstructionTask& task) {
    return std::make_unique<Published>(task);
}

}  // namespace abrdf
