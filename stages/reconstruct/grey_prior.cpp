// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/grey_prior.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/pair_features.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace abrdf {

struct GreyPrior::Sums {
    Eigen::VectorXd x;         ///< Logarithms at the outputs.
    Eigen::VectorXd residual;  ///< Of the samples, each without its block.
};

GreyPrior::GreyPrior(const PriorModel& model)
    : model_(model),
      blocks_(leaveOutBlocks(model.samples)),
      shares_(outputShares(model.samples, model.outputs)),
      isotropicRow_(isotropicPairs(model.outputs).rowOf) {
    for (const PriorClass& priorClass : model.classes) {
        const bool isIso = priorClass.materialClass == MaterialClass::kIso;
        for (const PriorSpectrum& spectrum : priorClass.spectra) {
            if (spectrum.sigma <= 0 || kernels_.contains({isIso, spectrum.length})) continue;
            kernels_[{isIso, spectrum.length}] = discrepancyKernel(
                priorClass.materialClass, model.outputs, model.samples, spectrum.length);
        }
    }
}

/// x += w (m_x + (C + sigma^2 K) a), a = A (z - m_y); the residual of block B is (A_BB)^-1 a_B.
void GreyPrior::addTerm(const PriorTerm& term, const Eigen::VectorXd& z, Sums& sums) const {
    if (term.isLambert) {
        const LeaveOutMap map = leaveOutMap(model_, {term}, blocks_);
        const double level = (z - lambertLogs(model_.samples)).mean();
        sums.x.array() += term.weight * (lambertLogs(model_.outputs).array() + level);
        sums.residual += map.matrix * z - map.offset;
        return;
    }
    const PriorClass& priorClass = model_.classes[term.classIndex];
    const PriorSpectrum& spectrum = priorClass.spectra[term.spectrum];
    const bool isIso = priorClass.materialClass == MaterialClass::kIso;
    const Eigen::MatrixXd& vectors = spectrum.eigenvectors;
    const Eigen::VectorXd inverse = (spectrum.eigenvalues.array() + term.nu).inverse();
    const Eigen::VectorXd a =
        vectors * inverse.cwiseProduct(vectors.transpose() * (z - priorClass.sampleMean));

    Eigen::VectorXd x = (priorClass.outputMean + priorClass.cross * a.cast<float>()).cast<double>();
    if (x.size() != sums.x.size()) x = x(isotropicRow_).eval();
    if (spectrum.sigma > 0) {
        x += spectrum.sigma * spectrum.sigma * (kernels_.at({isIso, spectrum.length}) * a);
    }
    sums.x += term.weight * x;
    for (const std::vector<Eigen::Index>& block : blocks_) {
        const Eigen::MatrixXd rows = vectors(block, Eigen::all);
        const Eigen::VectorXd own = a(block);
        const Eigen::MatrixXd within = rows * inverse.asDiagonal() * rows.transpose();
        const Eigen::VectorXd residual = within.llt().solve(own);
        sums.residual(block) += term.weight * residual;
    }
}

GreyEstimate GreyPrior::estimate(const Eigen::VectorXd& samples) const {
    const LogSamples logs = logSamples(model_, samples);
    const auto outputs = static_cast<Eigen::Index>(model_.outputs.size());
    if (logs.scale <= 0) {
        return {Eigen::VectorXd::Zero(outputs), Eigen::VectorXd::Zero(samples.size()), 1};
    }
    Sums sums{Eigen::VectorXd::Zero(outputs), Eigen::VectorXd::Zero(samples.size())};
    const std::vector<PriorTerm> terms = chooseTerms(model_, samples, 0);
    for (const PriorTerm& term : terms) addTerm(term, logs.z, sums);
    const double cap = mostLog(model_);
    const auto valuesOf = [&](const Eigen::VectorXd& x) {
        return Eigen::VectorXd((x.array().min(cap).exp() - kPriorFloor).max(0.0) * logs.scale);
    };
    return {valuesOf(sums.x), valuesOf(logs.z - sums.residual), isotropicShare(model_, terms)};
}

}  // namespace abrdf
