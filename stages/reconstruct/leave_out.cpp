// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/leave_out.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace abrdf {

namespace {

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
