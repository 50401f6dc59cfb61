// SPDX-License-Identifier: BSD-3-Clause
//
// x = sum over terms of w (m_x + (C + sigma^2 K_xs) A (z - m_y)), gathered into few products: one
// for each class's C and one for each kernel's K.
#include "stages/reconstruct/prior_map.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/matrix_product.h"

#include <algorithm>
#include <map>

namespace abrdf {

namespace {

/// A weighted sum of precisions A, and what it makes of the means.
struct Gathered {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd ofMean;

    void add(double weight, const Eigen::MatrixXd& precision, const Eigen::VectorXd& mean) {
        if (matrix.size() == 0) {
            matrix = Eigen::MatrixXd::Zero(precision.rows(), precision.cols());
            ofMean = Eigen::VectorXd::Zero(precision.rows());
        }
        matrix += weight * precision;
        ofMean += weight * (precision * mean);
    }
};

/// Adds `left` times what was gathered. In double: precisions hold numbers up to 1 / nu that
/// nearly cancel.
void addProduct(const Eigen::MatrixXd& left, const Gathered& gathered, PriorMap& map) {
    map.matrix += product(left, gathered.matrix).cast<float>();
    map.offset -= (left * gathered.ofMean).cast<float>();
}

/// x = ln(cos(theta_i)) + the samples' mean of z - ln(cos(theta_i)).
void addLambert(double weight, const std::vector<LightAndView>& outputs,
                const std::vector<LightAndView>& samples, PriorMap& map) {
    const Eigen::VectorXd level = lambertLogs(outputs).array() - lambertLogs(samples).mean();
    map.offset += (weight * level).cast<float>();
    map.matrix.array() += static_cast<float>(weight / static_cast<double>(samples.size()));
}

}  // namespace

bool isIsotropic(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    return std::ranges::all_of(terms, [&](const PriorTerm& term) {
        return term.isLambert ||
               model.classes[term.classIndex].materialClass == MaterialClass::kIso;
    });
}

PriorMap priorMap(const PriorModel& model, const std::vector<PriorTerm>& terms,
                  const std::vector<LightAndView>& outputs, std::span<const std::size_t> rowOf) {
    const auto rows = static_cast<Eigen::Index>(outputs.size());
    const auto samples = static_cast<Eigen::Index>(model.samples.size());
    PriorMap map{Eigen::VectorXf::Zero(rows), Eigen::MatrixXf::Zero(rows, samples)};
    std::map<std::size_t, Gathered> ofClass;
    std::map<std::pair<bool, double>, Gathered> ofKernel;  // Is it iso's; its length.
    for (const PriorTerm& term : terms) {
        if (term.isLambert) {
            addLambert(term.weight, outputs, model.samples, map);
            continue;
        }
        const PriorClass& priorClass = model.classes[term.classIndex];
        const PriorSpectrum& spectrum = priorClass.spectra[term.spectrum];
        const Eigen::MatrixXd precision = precisionOf(model, term);
        const bool isIso = priorClass.materialClass == MaterialClass::kIso;
        ofClass[term.classIndex].add(term.weight, precision, priorClass.sampleMean);
        if (spectrum.sigma > 0) {
            ofKernel[{isIso, spectrum.length}].add(term.weight * spectrum.sigma * spectrum.sigma,
                                                   precision, priorClass.sampleMean);
        }
    }
    for (const auto& [index, gathered] : ofClass) {
        const PriorClass& priorClass = model.classes[index];
        double weight = 0;
        for (const PriorTerm& term : terms) {
            weight += !term.isLambert && term.classIndex == index ? term.weight : 0;
        }
        if (priorClass.outputMean.size() == rows) {
            map.offset += static_cast<float>(weight) * priorClass.outputMean;
            addProduct(priorClass.cross.cast<double>(), gathered, map);
        } else {  // Class iso beside others: its rows serve several outputs.
            const std::vector<std::size_t> spread(rowOf.begin(), rowOf.end());
            map.offset += static_cast<float>(weight) * priorClass.outputMean(spread);
            addProduct(priorClass.cross(spread, Eigen::all).cast<double>(), gathered, map);
        }
    }
    for (const auto& [kernel, gathered] : ofKernel) {
        const auto [isIso, length] = kernel;
        const MaterialClass like = isIso ? MaterialClass::kIso : MaterialClass::kAniso;
        addProduct(discrepancyKernel(like, outputs, model.samples, length), gathered, map);
    }
    return map;
}

}  // namespace abrdf
