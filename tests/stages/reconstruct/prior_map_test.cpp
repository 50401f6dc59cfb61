// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_map.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/pair_features.h"
#include "stages/reconstruct/prior_encoder.h"
#include "tests/support/small_prior.h"

#include <Eigen/LU>
#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

using namespace abrdf;

namespace {

/// The slow twin: the mixture of conditional means in double precision, term by term.
Eigen::VectorXd slowLogs(const PriorModel& model, const std::vector<PriorTerm>& terms,
                         const Eigen::VectorXd& z) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.outputs.size()));
    const std::vector<std::size_t> rowOf = isotropicPairs(model.outputs).rowOf;
    for (const PriorTerm& term : terms) {
        if (term.isLambert) {
            const double level = (z - lambertLogs(model.samples)).mean();
            x.array() += term.weight * (lambertLogs(model.outputs).array() + level);
            continue;
        }
        const PriorClass& c = model.classes[term.classIndex];
        const PriorSpectrum& spectrum = c.spectra[term.spectrum];
        const PriorSpectrum& plain = c.spectra.front();
        const auto n = z.size();
        Eigen::MatrixXd covariance =
            plain.eigenvectors * plain.eigenvalues.asDiagonal() * plain.eigenvectors.transpose();
        Eigen::MatrixXd cross = c.cross.cast<double>();
        Eigen::VectorXd mean = c.outputMean.cast<double>();
        if (c.materialClass == MaterialClass::kIso) {
            cross = cross(rowOf, Eigen::all).eval();
            mean = mean(rowOf).eval();
        }
        if (spectrum.sigma > 0) {
            const double variance = spectrum.sigma * spectrum.sigma;
            covariance += variance * discrepancyKernel(c.materialClass, model.samples,
                                                       model.samples, spectrum.length);
            cross += variance * discrepancyKernel(c.materialClass, model.outputs, model.samples,
                                                  spectrum.length);
        }
        covariance += term.nu * Eigen::MatrixXd::Identity(n, n);
        x += term.weight * (mean + cross * covariance.fullPivLu().solve(z - c.sampleMean));
    }
    return x;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the map of a mixture is its slow twin in double precision") {
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const Eigen::VectorXd luminance = matrixOf(samples).rowwise().sum() / 3;
    const Eigen::VectorXd z = logSamples(model, luminance).z;
    const PairGroups isotropic = isotropicPairs(model.outputs);
    const std::vector<std::vector<PriorTerm>> mixtures = {
        chooseTerms(model, luminance, 0),
        {{false, 0, 1, 3e-4, 0.5}, {false, 3, 4, 3e-3, 0.3}, {true, 0, 0, 0, 0.2}},
        {{false, 2, 0, 3e-4, 1}}};
    for (const std::vector<PriorTerm>& terms : mixtures) {
        const PriorMap map = priorMap(model, terms, model.outputs, isotropic.rowOf);
        const Eigen::VectorXf x = map.offset + map.matrix * z.cast<float>();
        CHECK((x.cast<double>() - slowLogs(model, terms, z)).cwiseAbs().maxCoeff() < 2e-3);
        const Eigen::MatrixXd vectors = z;
        const PriorMap ofOne = priorMap(model, terms, model.outputs, isotropic.rowOf, &vectors);
        CHECK((ofOne.offset + ofOne.matrix - x).cwiseAbs().maxCoeff() < 1e-3F);
    }
}

TEST_SUITE_END();
