// SPDX-License-Identifier: BSD-3-Clause
//
// x = sum over terms of w (m_x + (C + sigma^2 K_xs) A (z - m_y)), gathered into few products: one
// for each class's C and one for each kernel's K.
#include "stages/reconstruct/prior_map.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/matrix_product.h"

#include <algorithm>
#include <map>

namespace abrdf {

namespace {

constexpr std::size_t kRowsAtOnce = 128;

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

/// What is multiplied from the right: what was gathered, of the vectors where there are some, and
/// of the means in a last column. In double: precisions hold numbers up to 1 / nu that nearly
/// cancel.
Eigen::MatrixXd rightOf(const Gathered& gathered, const Eigen::MatrixXd* vectors) {
    const Eigen::Index columns = vectors != nullptr ? vectors->cols() : gathered.matrix.cols();
    Eigen::MatrixXd right(gathered.matrix.rows(), columns + 1);
    right.leftCols(columns) =
        vectors != nullptr ? product(gathered.matrix, *vectors) : gathered.matrix;
    right.rightCols(1) = gathered.ofMean;
    return right;
}

/// Adds `left`, some rows from `first` on, times what stands right of it.
void addProduct(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right, Eigen::Index first,
                PriorMap& map) {
    const Eigen::MatrixXd rows = product(left, right);
    map.matrix.middleRows(first, left.rows()) += rows.leftCols(map.matrix.cols()).cast<float>();
    map.offset.segment(first, left.rows()) -= rows.rightCols(1).cast<float>();
}

/// x = ln(cos(theta_i)) + the samples' mean of z - ln(cos(theta_i)).
void addLambert(double weight, const std::vector<LightAndView>& outputs,
                const std::vector<LightAndView>& samples, const Eigen::MatrixXd* vectors,
                PriorMap& map) {
    const Eigen::VectorXd level = lambertLogs(outputs).array() - lambertLogs(samples).mean();
    map.offset += (weight * level).cast<float>();
    if (vectors != nullptr) {
        map.matrix.rowwise() += (weight * vectors->colwise().mean()).cast<float>();
    } else {
        map.matrix.array() += static_cast<float>(weight / static_cast<double>(samples.size()));
    }
}

/// A class's C, and what stands right of it.
struct ClassPart {
    const PriorClass* priorClass;
    float weight;
    Eigen::MatrixXd right;
};

/// A kernel's K, and what stands right of it.
struct KernelPart {
    MaterialClass like;
    double length;
    Eigen::MatrixXd right;
};

struct Parts {
    std::vector<ClassPart> classes;
    std::vector<KernelPart> kernels;
};

Parts partsOf(const PriorModel& model, const std::vector<PriorTerm>& terms,
              const Eigen::MatrixXd* vectors) {
    std::map<std::size_t, Gathered> ofClass;
    std::map<std::pair<bool, double>, Gathered> ofKernel;  // Is it iso's; its length.
    std::map<std::size_t, double> weights;
    for (const PriorTerm& term : terms) {
        if (term.isLambert) continue;
        const PriorClass& priorClass = model.classes[term.classIndex];
        const PriorSpectrum& spectrum = priorClass.spectra[term.spectrum];
        const Eigen::MatrixXd precision = precisionOf(model, term);
        const bool isIso = priorClass.materialClass == MaterialClass::kIso;
        weights[term.classIndex] += term.weight;
        ofClass[term.classIndex].add(term.weight, precision, priorClass.sampleMean);
        if (spectrum.sigma > 0) {
            ofKernel[{isIso, spectrum.length}].add(term.weight * spectrum.sigma * spectrum.sigma,
                                                   precision, priorClass.sampleMean);
        }
    }
    Parts parts;
    for (const auto& [index, gathered] : ofClass) {
        parts.classes.push_back({&model.classes[index], static_cast<float>(weights[index]),
                                 rightOf(gathered, vectors)});
    }
    for (const auto& [kernel, gathered] : ofKernel) {
        const auto [isIso, length] = kernel;
        parts.kernels.push_back({isIso ? MaterialClass::kIso : MaterialClass::kAniso, length,
                                 rightOf(gathered, vectors)});
    }
    return parts;
}

}  // namespace

bool isIsotropic(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    return std::ranges::all_of(terms, [&](const PriorTerm& term) {
        return term.isLambert ||
               model.classes[term.classIndex].materialClass == MaterialClass::kIso;
    });
}

PriorMap priorMap(const PriorModel& model, const std::vector<PriorTerm>& terms,
                  const std::vector<LightAndView>& outputs, std::span<const std::size_t> rowOf,
                  const Eigen::MatrixXd* vectors) {
    const auto rows = static_cast<Eigen::Index>(outputs.size());
    const auto samples = static_cast<Eigen::Index>(model.samples.size());
    PriorMap map{Eigen::VectorXf::Zero(rows),
                 Eigen::MatrixXf::Zero(rows, vectors != nullptr ? vectors->cols() : samples)};
    for (const PriorTerm& term : terms) {
        if (term.isLambert) addLambert(term.weight, outputs, model.samples, vectors, map);
    }
    const Parts parts = partsOf(model, terms, vectors);
    // Some rows at a time: what is made on the way stays in a core's cache.
    forEachTexelBlock(outputs.size(), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
        const auto first = static_cast<Eigen::Index>(begin);
        const std::vector<LightAndView> own(outputs.begin() + static_cast<std::ptrdiff_t>(begin),
                                            outputs.begin() + static_cast<std::ptrdiff_t>(end));
        for (const ClassPart& part : parts.classes) {
            // Class iso beside others: its rows serve several outputs.
            const bool isSpread = part.priorClass->outputMean.size() != rows;
            std::vector<std::size_t> at;
            for (std::size_t i = begin; i < end; ++i) at.push_back(isSpread ? rowOf[i] : i);
            map.offset.segment(first, static_cast<Eigen::Index>(own.size())) +=
                part.weight * part.priorClass->outputMean(at);
            addProduct(part.priorClass->cross(at, Eigen::all).cast<double>(), part.right, first,
                       map);
        }
        for (const KernelPart& part : parts.kernels) {
            addProduct(discrepancyKernel(part.like, own, model.samples, part.length), part.right,
                       first, map);
        }
    });
    return map;
}

}  // namespace abrdf
