// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/censored_samples.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace abrdf {

CensoredSamples::CensoredSamples(const PriorModel& model, const std::vector<PriorTerm>& terms,
                                 double saturated)
    : saturated_(saturated), scaleFactor_(model.scaleFactor) {
    const auto n = static_cast<Eigen::Index>(model.samples.size());
    mean_ = Eigen::VectorXd::Zero(n);
    precision_ = Eigen::MatrixXd::Zero(n, n);
    for (PriorTerm term : terms) {
        // A Lambertian has no highlight; what is above it is some class's.
        if (term.isLambert) term = {false, 0, 0, 3e-2, term.weight};
        mean_ += term.weight * model.classes[term.classIndex].sampleMean;
        precision_ += term.weight * precisionOf(model, term);
    }
}

std::vector<Eigen::Index> CensoredSamples::clippedRows(const Eigen::MatrixX3d& colors) const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < colors.rows(); ++i) {
        if (colors.row(i).maxCoeff() >= saturated_) rows.push_back(i);
    }
    return rows;
}

/// Conditional means of the unknown logarithms given the others; one that comes out below what the
/// photograph shows is known after all, and the rest are found once more.
Eigen::VectorXd CensoredSamples::restoredLogs(const Eigen::VectorXd& z,
                                              std::vector<Eigen::Index> unknown) const {
    Eigen::VectorXd result = z;
    for (int round = 0; round < 2 && !unknown.empty(); ++round) {
        const Eigen::VectorXd a = precision_ * (z - mean_);
        const Eigen::MatrixXd block = precision_(unknown, unknown);
        const Eigen::VectorXd residual = block.llt().solve(a(unknown).eval());
        std::vector<Eigen::Index> above;
        result = z;
        for (std::size_t i = 0; i < unknown.size(); ++i) {
            if (residual(static_cast<Eigen::Index>(i)) >= 0) continue;
            result(unknown[i]) -= residual(static_cast<Eigen::Index>(i));
            above.push_back(unknown[i]);
        }
        if (above.size() == unknown.size()) break;
        unknown = above;
    }
    return result;
}

Eigen::MatrixX3d CensoredSamples::restored(const Eigen::MatrixX3d& colors) const {
    const std::vector<Eigen::Index> clipped = clippedRows(colors);
    if (clipped.empty() || static_cast<Eigen::Index>(clipped.size()) == colors.rows()) {
        return colors;
    }
    const Eigen::VectorXd luminance = colors.rowwise().sum() / 3;
    const double scale =
        scaleFactor_ * largestMean({luminance.data(), luminance.data() + luminance.size()});
    const Eigen::VectorXd z = (luminance.array().max(0.0) / scale + kPriorFloor).log();
    // What no model of ours holds: ten times the largest sample, as the training's cap.
    const double cap = std::log(10 / scaleFactor_);
    const Eigen::VectorXd logs = restoredLogs(z, clipped).cwiseMin(std::max(cap, z.maxCoeff()));

    // Its chroma stays as it was seen: at the exposure of the photograph nothing else is shown.
    Eigen::MatrixX3d result = colors;
    for (const Eigen::Index row : clipped) {
        const double light = (std::exp(logs(row)) - kPriorFloor) * scale;
        const double gain = light / luminance(row);
        if (gain > 1 && std::isfinite(gain)) result.row(row) *= gain;
    }
    return result;
}

}  // namespace abrdf
