// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/whole_maps.h"

#include "abrdf/pair_features.h"
#include "stages/reconstruct/leave_out.h"
#include "stages/reconstruct/prior_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace abrdf {

namespace {

std::vector<float> numbersOf(const Eigen::VectorXf& values) {
    return {values.data(), values.data() + values.size()};
}

Eigen::MatrixXd columnsOf(std::span<const Eigen::VectorXf> vectors) {
    Eigen::MatrixXd columns(vectors[0].size(), static_cast<Eigen::Index>(vectors.size()));
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        columns.col(static_cast<Eigen::Index>(i)) = vectors[i].cast<double>();
    }
    return columns;
}

/// A map, and what it makes of some vectors; one column of zeros where only they are wanted.
struct Mapped {
    Eigen::MatrixXf matrix;
    std::vector<std::vector<float>> vectors;
};

Mapped mappedLogs(const PriorModel& model, const std::vector<PriorTerm>& terms,
                  const std::vector<LightAndView>& outputs,
                  std::span<const std::size_t> isotropicRowOf,
                  std::span<const Eigen::VectorXf> logs, bool onlyThem) {
    Mapped mapped;
    if (onlyThem) {
        const Eigen::MatrixXd vectors = columnsOf(logs);
        const PriorMap map = priorMap(model, terms, outputs, isotropicRowOf, &vectors);
        for (Eigen::Index i = 0; i < vectors.cols(); ++i) {
            mapped.vectors.push_back(numbersOf(map.matrix.col(i) + map.offset));
        }
        mapped.matrix = Eigen::MatrixXf::Zero(map.matrix.rows(), 1);
        return mapped;
    }
    PriorMap map = priorMap(model, terms, outputs, isotropicRowOf);
    for (const Eigen::VectorXf& vector : logs) {
        mapped.vectors.push_back(numbersOf(Eigen::VectorXf(map.matrix * vector) + map.offset));
    }
    mapped.matrix = std::move(map.matrix);
    return mapped;
}

/// luminance: the material's own at the outputs, a feature of its chroma.
Mapped mappedChroma(const ChromaKriging& kriging, const std::vector<LightAndView>& outputs,
                    const Eigen::VectorXd& luminance, std::span<const Eigen::VectorXf> chroma,
                    bool onlyThem) {
    Mapped mapped;
    if (onlyThem) {
        const Eigen::MatrixXd vectors = columnsOf(chroma);
        const Eigen::MatrixXf products = kriging.outputMatrix(outputs, luminance, &vectors);
        for (const auto& column : products.colwise()) mapped.vectors.push_back(numbersOf(column));
        mapped.matrix = Eigen::MatrixXf::Zero(products.rows(), 1);
        return mapped;
    }
    mapped.matrix = kriging.outputMatrix(outputs, luminance);
    for (const Eigen::VectorXf& vector : chroma) {
        mapped.vectors.push_back(numbersOf(mapped.matrix * vector));
    }
    return mapped;
}

/// The mean luminance of the material at the outputs, from its logarithms there.
Eigen::VectorXd luminanceFromLogs(const std::vector<float>& x, float cap, double scale) {
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) {
        luminance(static_cast<Eigen::Index>(i)) =
            scale * std::max(std::exp(static_cast<double>(std::min(x[i], cap))) - kPriorFloor, 0.0);
    }
    return luminance;
}

}  // namespace

TexelBasis WholeMaps::basisOf(const Eigen::MatrixXf& ofLuminance,
                              const Eigen::MatrixXf& ofChroma) const {
    TexelBasis basis = centers;
    basis.luminance = PackedMatrix(ofLuminance);
    basis.chroma = PackedMatrix(ofChroma);
    return basis;
}

WholeMaps wholeMaps(const PriorModel& model, const PriorFit& fit,
                    const PriorEncoder::Centers& centers, std::span<const std::size_t> rowOf,
                    bool onlyCenters) {
    WholeMaps maps;
    const PairGroups isotropic = isotropicPairs(model.outputs);
    const bool fewRows = isIsotropic(model, fit.terms) && !fit.kriging.isAnisotropic();
    const std::vector<LightAndView>& outputs = fewRows ? isotropic.distinct : model.outputs;
    for (const std::size_t row : rowOf) {
        maps.rowOf.push_back(fewRows ? isotropic.rowOf[row] : row);
        maps.pairs.push_back(model.outputs[row]);
    }
    // The centres' logarithms and the mean's own, which need not be the centre.
    const std::size_t logVectors = fit.rule.logVectors();
    std::vector<Eigen::VectorXf> logs(
        centers.logs.begin(), centers.logs.begin() + static_cast<std::ptrdiff_t>(logVectors));
    const LogSamples own = logSamples(model, fit.mean.rowwise().sum() / 3);
    logs.emplace_back(Eigen::VectorXf::Zero(fit.mean.rows()));
    if (own.scale > 0) logs.back() = own.z.cast<float>();
    Mapped ofLogs = mappedLogs(model, fit.terms, outputs, isotropic.rowOf, logs, onlyCenters);
    const Eigen::VectorXd luminance =
        luminanceFromLogs(ofLogs.vectors.back(), fit.rule.cap, own.scale);
    Mapped ofChroma = mappedChroma(fit.kriging, outputs, luminance, centers.chroma, onlyCenters);
    for (std::size_t i = 0; i < logVectors; ++i) {
        maps.centers.logCenters[i] = std::move(ofLogs.vectors[i]);
    }
    for (std::size_t c = 0; c < fit.rule.chromaVectors(); ++c) {
        maps.centers.chromaCenters[c] = std::move(ofChroma.vectors[c]);
    }
    maps.luminance = std::move(ofLogs.matrix);
    maps.chroma = std::move(ofChroma.matrix);
    return maps;
}

/// Predictions are maps like all others: x = z - (R z - r), with z = centre + vector.
TexelModel leaveOutModel(const PriorModel& model, const PriorFit& fit,
                         const PriorEncoder::Centers& centers) {
    const SampleBlocks blocks = leaveOutBlocks(model.samples);
    const LeaveOutMap logs = leaveOutMap(model, fit.terms, blocks);
    const auto n = static_cast<Eigen::Index>(model.samples.size());
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd luminance = identity - logs.matrix;
    const Eigen::MatrixXd chroma = identity - fit.kriging.leaveOut(blocks);
    const auto numbers = [](const Eigen::VectorXd& values) {
        return numbersOf(values.cast<float>());
    };
    TexelBasis basis;
    basis.luminance = PackedMatrix(luminance.cast<float>());
    basis.chroma = PackedMatrix(chroma.cast<float>());
    for (std::size_t i = 0; i < fit.rule.logVectors(); ++i) {
        basis.logCenters[i] = numbers(luminance * centers.logs[i].cast<double>() + logs.offset);
    }
    for (std::size_t c = 0; c < fit.rule.chromaVectors(); ++c) {
        basis.chromaCenters[c] = numbers(chroma * centers.chroma[c].cast<double>());
    }
    std::vector<std::size_t> rowOf(model.samples.size());
    std::iota(rowOf.begin(), rowOf.end(), std::size_t{0});
    return {std::move(basis), fit.rule, std::move(rowOf), model.samples};
}

}  // namespace abrdf
