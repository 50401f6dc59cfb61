// SPDX-License-Identifier: BSD-3-Clause
//
// `prior` of a grey texel in long double: each term's covariance S + sigma^2 K + nu I is put
// together and solved by Cholesky for the texel's own logarithms; no eigenvectors of it divide, no
// map is built, and nothing is rounded to float. Its model is chosen as `prior` chooses it.
#include "abrdf/discrepancy_kernel.h"
#include "abrdf/pair_features.h"
#include "stages/reconstruct/prior_choice.h"
#include "stages/reconstruct/reconstructor.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

using Long = long double;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

/// m_x + (C + sigma^2 K) (S + sigma^2 K + nu I)^-1 (z - m_y)
LongVector logsOf(const PriorModel& model, const PriorTerm& term, const LongVector& z,
                  double& condition) {
    const PriorClass& priorClass = model.classes[term.classIndex];
    const PriorSpectrum& spectrum = priorClass.spectra[term.spectrum];
    const LongMatrix vectors = spectrum.eigenvectors.cast<Long>();
    LongMatrix system =
        vectors * spectrum.eigenvalues.cast<Long>().asDiagonal() * vectors.transpose();
    system.diagonal().array() += static_cast<Long>(term.nu);
    const Eigen::LLT<LongMatrix> llt(system);
    condition = std::max(condition, static_cast<double>(1 / llt.rcond()));
    const LongVector a = llt.solve(z - priorClass.sampleMean.cast<Long>());
    LongVector x = priorClass.outputMean.cast<Long>() + priorClass.cross.cast<Long>() * a;
    if (x.size() != static_cast<Eigen::Index>(model.outputs.size())) {
        x = x(isotropicPairs(model.outputs).rowOf).eval();
    }
    if (spectrum.sigma > 0) {
        const Long variance = static_cast<Long>(spectrum.sigma) * static_cast<Long>(spectrum.sigma);
        x += variance * (discrepancyKernel(priorClass.materialClass, model.outputs, model.samples,
                                           spectrum.length)
                             .cast<Long>() *
                         a);
    }
    return x;
}

}  // namespace

TwinAnswer priorTwin(const ReconstructionTask& task) {
    const PriorModel& model = *task.prior;
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(task.mean.size()));
    for (std::size_t k = 0; k < task.mean.size(); ++k) {
        const Rgb& c = task.mean[k];
        luminance(static_cast<Eigen::Index>(k)) =
            (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) / 3;
    }
    const LogSamples logs = logSamples(model, luminance);
    TwinAnswer twin;
    const std::vector<std::size_t> rowOf = distinctPairs(pairsOf(task.output)).rowOf;
    twin.abrdf.resize(rowOf.size());
    if (logs.scale <= 0) return twin;
    const LongVector z = logs.z.cast<Long>();
    LongVector x = LongVector::Zero(static_cast<Eigen::Index>(model.outputs.size()));
    for (const PriorTerm& term : chooseTerms(model, luminance, task.options.noise)) {
        const Long weight = term.weight;
        if (term.isLambert) {
            const Long level = (z - lambertLogs(model.samples).cast<Long>()).mean();
            x.array() += weight * (lambertLogs(model.outputs).cast<Long>().array() + level);
        } else {
            x += weight * logsOf(model, term, z, twin.condition);
        }
    }
    const Long cap = mostLog(model);
    for (std::size_t i = 0; i < rowOf.size(); ++i) {
        const Long log = std::min(x(static_cast<Eigen::Index>(rowOf[i])), cap);
        const auto value =
            static_cast<double>(std::max(std::exp(log) - static_cast<Long>(kPriorFloor), Long{0}) *
                                static_cast<Long>(logs.scale));
        twin.abrdf[i] = {value, value, value};
    }
    return twin;
}

}  // namespace abrdf
