// SPDX-License-Identifier: BSD-3-Clause
//
// `rbf` in long double: the system is solved for the texel's own values, without an inverse and
// without a matrix of weights, and nothing is rounded to float.
#include "stages/reconstruct/reconstructor.h"
#include "stages/reconstruct/weighted_samples.h"

#include <Eigen/LU>

#include <cmath>

namespace abrdf {

namespace {

using Long = long double;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

/// Light and view as points on two unit spheres.
Eigen::Matrix<Long, 6, 1> placeOf(const LightAndView& pair) {
    const auto point = [](const Direction& d) {
        const Long theta = d.theta;
        const Long phi = d.phi;
        return Eigen::Matrix<Long, 3, 1>(std::sin(theta) * std::cos(phi),
                                         std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    Eigen::Matrix<Long, 6, 1> place;
    place << point(pair.light), point(pair.view);
    return place;
}

}  // namespace

TwinAnswer radialBasisTwin(const ReconstructionTask& task) {
    constexpr Long kRidge = 1e-6L;
    const std::vector<LightAndView>& samples = task.samples.directions;
    const auto n = static_cast<Eigen::Index>(samples.size());
    LongMatrix places(6, n);
    LongMatrix values = LongMatrix::Zero(n + 1, 3);
    for (Eigen::Index k = 0; k < n; ++k) {
        const auto index = static_cast<std::size_t>(k);
        places.col(k) = placeOf(samples[index]);
        const Rgb& c = task.mean[index];
        values.row(k) << static_cast<Long>(c.r), static_cast<Long>(c.g), static_cast<Long>(c.b);
        values.row(k) /= static_cast<Long>(boundedCosine(samples[index].light));
    }
    LongMatrix system = LongMatrix::Ones(n + 1, n + 1);
    system(n, n) = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index k = 0; k < n; ++k) {
            system(i, k) = i == k ? kRidge : -(places.col(i) - places.col(k)).norm();
        }
    }
    const Eigen::PartialPivLU<LongMatrix> lu(system);
    const LongMatrix solved = lu.solve(values);
    TwinAnswer twin;
    twin.condition = static_cast<double>(1 / lu.rcond());
    for (const LightAndView& pair : pairsOf(task.output)) {
        Eigen::Matrix<Long, Eigen::Dynamic, 1> basis(n + 1);
        basis.head(n) = -(places.colwise() - placeOf(pair)).colwise().norm().transpose();
        basis(n) = 1;
        const Eigen::Matrix<Long, 3, 1> value =
            static_cast<Long>(boundedCosine(pair.light)) * (solved.transpose() * basis);
        twin.abrdf.push_back({static_cast<double>(value(0)), static_cast<double>(value(1)),
                              static_cast<double>(value(2))});
    }
    return twin;
}

}  // namespace abrdf
