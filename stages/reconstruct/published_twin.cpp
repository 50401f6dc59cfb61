// SPDX-License-Identifier: BSD-3-Clause
//
// `published`, its seven equations in long double and solved for each pair's values, the rest in
// double, pair by pair as the paper has it.
#include "stages/reconstruct/rbf_weights.h"
#include "stages/reconstruct/reconstructor.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace abrdf {

namespace {

using Long = long double;
using Seven = Eigen::Matrix<Long, 7, 7>;
using SevenVector = Eigen::Matrix<Long, 7, 1>;

SevenVector basisAt(const SlicePlan& plan, Radians light, Radians view) {
    SevenVector basis;
    for (std::size_t s = 0; s < 4; ++s) {
        const Long x = static_cast<Long>(light) - static_cast<Long>(plan.thetaLight(s));
        const Long y = static_cast<Long>(view) - static_cast<Long>(plan.thetaView(s));
        const Long r2 = x * x + y * y;
        basis(static_cast<Eigen::Index>(s)) = r2 > 0 ? r2 * std::log(r2) / 2 : 0;
    }
    basis.tail<3>() << 1, static_cast<Long>(light), static_cast<Long>(view);
    return basis;
}

/// One channel of one subspace.
class Subspace {
  public:
    Subspace(const SlicePlan& plan, std::vector<double> samples) : plan_(plan) {
        const auto [m, M] = std::ranges::minmax_element(samples);
        least_ = *m;
        most_ = *M;
        axial_.assign(samples.begin(), samples.begin() + plan.axialCount);
        diagonal_.assign(samples.begin() + plan.axialCount, samples.end());
        // Extremes of a sum that is linear between knots.
        for (int j = 0; j < plan.axialCount; ++j) {
            for (int k = 0; k < plan.diagonalCount; ++k) {
                const Radians u = 2 * kPi * j / plan.axialCount;
                const Radians w = 2 * kPi * k / plan.diagonalCount;
                const double v = sum(u - w + plan.alpha, u + w);
                low_ = j + k == 0 ? v : std::min(low_, v);
                high_ = j + k == 0 ? v : std::max(high_, v);
            }
        }
    }

    double at(Radians phiLight, Radians phiView) const {
        const double range = high_ - low_;
        if (range <= 1e-6 * std::max(std::abs(high_), std::abs(low_))) return (least_ + most_) / 2;
        return (sum(phiLight, phiView) - low_) / range * (most_ - least_) + least_;
    }

  private:
    static double on(const std::vector<double>& slice, Radians azimuth) {
        const double place =
            wrappedAzimuth(azimuth) / (2 * kPi) * static_cast<double>(slice.size());
        const std::size_t k = static_cast<std::size_t>(place) % slice.size();
        const double t = place - std::floor(place);
        return (1 - t) * slice[k] + t * slice[(k + 1) % slice.size()];
    }

    double sum(Radians phiLight, Radians phiView) const {
        const Radians light = wrappedAzimuth(phiLight);
        const Radians view = wrappedAzimuth(phiView);
        return on(axial_, (light + view - plan_.alpha) / 2) +
               on(diagonal_, (view - light + plan_.alpha) / 2);
    }

    SlicePlan plan_;
    std::vector<double> axial_, diagonal_;
    double least_ = 0, most_ = 0, low_ = 0, high_ = 0;
};

}  // namespace

TwinAnswer publishedTwin(const ReconstructionTask& task) {
    const SlicePlan& plan = task.plan;
    Seven system = Seven::Zero();
    for (std::size_t s = 0; s < 4; ++s) {
        const auto row = static_cast<Eigen::Index>(s);
        system.row(row) = basisAt(plan, plan.thetaLight(s), plan.thetaView(s)).transpose();
        system.col(row).tail<3>() = system.row(row).tail<3>().transpose();
    }
    const Eigen::PartialPivLU<Seven> lu(system);
    const auto own = static_cast<std::size_t>(plan.samplesPerSubspace());
    std::array<std::vector<Subspace>, 3> channels;
    for (std::size_t s = 0; s < 4; ++s) {
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<double> values;
            for (std::size_t k = 0; k < own; ++k) {
                const Rgb value = task.mean[s * own + k];
                values.push_back(static_cast<double>(std::array{value.r, value.g, value.b}[c]));
            }
            channels[c].emplace_back(plan, std::move(values));
        }
    }
    TwinAnswer twin;
    twin.condition = static_cast<double>(1 / lu.rcond());
    for (const LightAndView& pair : pairsOf(task.output)) {
        const SevenVector basis = basisAt(plan, pair.light.theta, pair.view.theta);
        std::array<double, 3>& value = twin.abrdf.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            SevenVector wanted = SevenVector::Zero();
            for (std::size_t s = 0; s < 4; ++s) {
                wanted(static_cast<Eigen::Index>(s)) =
                    static_cast<Long>(channels[c][s].at(pair.light.phi, pair.view.phi));
            }
            value[c] = static_cast<double>(basis.dot(lu.solve(wanted)));
        }
    }
    return twin;
}

}  // namespace abrdf
