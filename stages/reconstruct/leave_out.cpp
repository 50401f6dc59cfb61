// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/leave_out.h"

#include "abrdf/pair_features.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace abrdf {

namespace {

constexpr double kVectorWeight = 0.7;  ///< As in the discrepancy kernels.

Eigen::MatrixXd featuresOf(const std::vector<LightAndView>& pairs, bool isIsotropic) {
    const Eigen::MatrixXd isotropic = isotropicFeatures(pairs);
    if (isIsotropic) return isotropic;
    const Eigen::MatrixXd vectors = vectorFeatures(pairs);
    Eigen::MatrixXd all(isotropic.rows(), isotropic.cols() + vectors.cols());
    all << isotropic, kVectorWeight * vectors;
    return all;
}

struct Near {
    Eigen::Index sample;
    double distance;
};

/// Of each output its nearest sample.
std::vector<Near> nearestOf(const std::vector<LightAndView>& samples,
                            const std::vector<LightAndView>& outputs, bool isIsotropic) {
    const Eigen::MatrixXd features = featuresOf(samples, isIsotropic);
    std::vector<Near> nearest;
    constexpr std::size_t kSome = 512;
    for (std::size_t first = 0; first < outputs.size(); first += kSome) {
        const auto begin = outputs.begin() + static_cast<std::ptrdiff_t>(first);
        const auto count = static_cast<std::ptrdiff_t>(std::min(kSome, outputs.size() - first));
        const Eigen::MatrixXd distances =
            squaredDistances(features, featuresOf({begin, begin + count}, isIsotropic));
        for (const auto& column : distances.colwise()) {
            Near near{};
            near.distance = std::sqrt(std::max(column.minCoeff(&near.sample), 0.0));
            nearest.push_back(near);
        }
    }
    return nearest;
}

/// A Lambertian's one number is the mean over the samples outside of the block.
void addLambert(double weight, const Eigen::VectorXd& logs, const SampleBlocks& blocks,
                LeaveOutMap& map) {
    const Eigen::Index n = logs.size();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
    for (const std::vector<Eigen::Index>& block : blocks) {
        Eigen::RowVectorXd mean = Eigen::RowVectorXd::Ones(n);
        for (const Eigen::Index i : block) mean(i) = 0;
        mean /= std::max(mean.sum(), 1.0);
        for (const Eigen::Index i : block) matrix.row(i) -= mean;
    }
    map.matrix += weight * matrix;
    map.offset += weight * (matrix * logs);
}

}  // namespace

SampleBlocks leaveOutBlocks(const std::vector<LightAndView>& samples) {
    SampleBlocks blocks;
    if (!lieOnSlices(samples)) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            blocks.push_back({static_cast<Eigen::Index>(i)});
        }
        return blocks;
    }
    std::map<std::pair<long, long>, std::vector<Eigen::Index>> ofSubspace;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        ofSubspace[subspaceOf(samples[i])].push_back(static_cast<Eigen::Index>(i));
    }
    for (auto& [subspace, block] : ofSubspace) blocks.push_back(std::move(block));
    return blocks;
}

std::vector<float> outputShares(const std::vector<LightAndView>& samples,
                                const std::vector<LightAndView>& outputs,
                                std::span<const double> weights) {
    const std::vector<Near> nearest = nearestOf(samples, outputs, false);
    std::vector<double> shares(samples.size());
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        shares[static_cast<std::size_t>(nearest[i].sample)] +=
            weights.empty() ? 1 / static_cast<double>(outputs.size()) : weights[i];
    }
    return {shares.begin(), shares.end()};
}

double nearness(const std::vector<LightAndView>& samples, const SampleBlocks& blocks,
                const std::vector<LightAndView>& outputs, bool isIsotropic) {
    const Eigen::MatrixXd features = featuresOf(samples, isIsotropic);
    Eigen::MatrixXd apart = squaredDistances(features, features);
    for (const std::vector<Eigen::Index>& block : blocks) {
        apart(block, block).setConstant(std::numeric_limits<double>::max());
    }
    const Eigen::VectorXd toOthers = apart.colwise().minCoeff().transpose();
    double ofOutputs = 0;
    double ofSamples = 0;
    for (const Near& near : nearestOf(samples, outputs, isIsotropic)) {
        ofOutputs += near.distance;
        ofSamples += std::sqrt(std::max(toOthers(near.sample), 0.0));
    }
    return ofSamples > 0 ? ofOutputs / ofSamples : 1;
}

Eigen::MatrixXd leaveOutMatrix(const Eigen::MatrixXd& precision, const SampleBlocks& blocks) {
    Eigen::MatrixXd matrix(precision.rows(), precision.cols());
    for (const std::vector<Eigen::Index>& block : blocks) {
        const Eigen::MatrixXd within = precision(block, block);
        const Eigen::MatrixXd rows = precision(block, Eigen::all);
        const Eigen::MatrixXd solved = within.llt().solve(rows);
        matrix(block, Eigen::all) = solved;
    }
    return matrix;
}

LeaveOutMap leaveOutMap(const PriorModel& model, const std::vector<PriorTerm>& terms,
                        const SampleBlocks& blocks) {
    const auto n = static_cast<Eigen::Index>(model.samples.size());
    LeaveOutMap map{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    for (const PriorTerm& term : terms) {
        if (term.isLambert) {
            addLambert(term.weight, lambertLogs(model.samples), blocks, map);
            continue;
        }
        const Eigen::MatrixXd matrix = leaveOutMatrix(precisionOf(model, term), blocks);
        map.matrix += term.weight * matrix;
        map.offset += term.weight * (matrix * model.classes[term.classIndex].sampleMean);
    }
    return map;
}

}  // namespace abrdf
