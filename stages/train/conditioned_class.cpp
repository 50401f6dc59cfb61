// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/conditioned_class.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/for_each_texel.h"
#include "stages/train/random_material.h"
#include "stages/train/shown_materials.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace abrdf {

namespace {

constexpr double kSampleVariance = 1e-2;  ///< lambda: of a sample's own noise, in ln(value).

// Real materials deviate from random ones: the discrepancy kernel, as the prior has it.
constexpr double kDeviation = 0.8;
constexpr double kLength = 1.2;

/// Isotropic materials count double: most measured ones are.
double shareOf(MaterialClass materialClass) {
    return materialClass == MaterialClass::kIso ? 2 : 1;
}

}  // namespace

ConditionedClass::ConditionedClass(MaterialClass materialClass, const AngularGrid& grid,
                                   const WatchedPairs& watched,
                                   std::vector<LightAndView> candidates,
                                   const ConditionOptions& options)
    : materialClass_(materialClass), candidates_(std::move(candidates)) {
    std::vector<LightAndView> pairs = pairsOf(grid);
    pairs.insert(pairs.end(), watched.others.begin(), watched.others.end());
    std::size_t firstCandidate = 0;
    if (candidates_.empty()) {
        candidates_ = pairsOf(grid);
    } else {
        firstCandidate = pairs.size();
        pairs.insert(pairs.end(), candidates_.begin(), candidates_.end());
    }
    const ShownMaterials shown = shownMaterials(
        randomMaterials(materialClass, options.materials, options.seed), pairs, grid, watched);
    logs_ = shown.logs.middleCols(static_cast<Eigen::Index>(firstCandidate),
                                  static_cast<Eigen::Index>(candidates_.size()));
    std::vector<LightAndView> watchedAt;
    for (const Eigen::Index i : watched.pairs) {
        watchedAt.push_back(pairs[static_cast<std::size_t>(i)]);
    }
    const auto count = static_cast<float>(logs_.rows());
    const Eigen::MatrixXf watchedLogs =
        shown.logs(Eigen::all, watched.pairs) * shown.weight.cast<float>().asDiagonal();
    const Eigen::VectorXf deviation = (kDeviation * kDeviation * shown.weight).cast<float>();
    covariance_.resize(watchedLogs.cols(), logs_.cols());
    forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
        covariance_.middleCols(first, columns).noalias() =
            watchedLogs.transpose() * logs_.middleCols(first, columns) / count;
        covariance_.middleCols(first, columns) +=
            deviation.asDiagonal() *
            discrepancyKernel(materialClass, watchedAt, candidatesAt(first, columns), kLength)
                .cast<float>();
    });
    variance_ = logs_.cwiseAbs2().colwise().mean().transpose().cast<double>();
    variance_.array() += kDeviation * kDeviation;
    pairs_ = watched.share.sum();
    total_ = watchedLogs.squaredNorm() / static_cast<double>(count) +
             kDeviation * kDeviation * shown.weight.squaredNorm();
    left_ = total_;
}

std::vector<LightAndView> ConditionedClass::candidatesAt(Eigen::Index first,
                                                         Eigen::Index count) const {
    return {candidates_.begin() + first, candidates_.begin() + first + count};
}

double ConditionedClass::balance() const {
    return shareOf(materialClass_) / std::sqrt(std::max(total_, 1e-30));
}

void ConditionedClass::addScores(Eigen::VectorXd& score) const {
    const double factor = balance();
    forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
        score.segment(first, columns).array() +=
            factor *
            covariance_.middleCols(first, columns)
                .colwise()
                .squaredNorm()
                .transpose()
                .cast<double>()
                .array() /
            (variance_.segment(first, columns).array() + kSampleVariance);
    });
}

double ConditionedClass::scoreOf(Eigen::Index first, const Eigen::MatrixXd& own) const {
    // tr((C_ss + lambda)^-1 C_sw C_ws), all of it conditioned.
    const auto part = covariance_.middleCols(first, own.cols());
    const Eigen::MatrixXd seen = (part.transpose() * part).cast<double>();
    Eigen::MatrixXd noisy = own;
    noisy.diagonal().array() += kSampleVariance;
    return balance() * noisy.llt().solve(seen).trace();
}

Eigen::MatrixXd ConditionedClass::ownCovariance(Eigen::Index first, Eigen::Index count) const {
    const auto part = logs_.middleCols(first, count);
    const std::vector<LightAndView> at = candidatesAt(first, count);
    return (part.transpose() * part).cast<double>() / static_cast<double>(logs_.rows()) +
           kDeviation * kDeviation * discrepancyKernel(materialClass_, at, at, kLength);
}

const ConditionedClass::Downdate& ConditionedClass::choose(Eigen::Index j) {
    const Eigen::VectorXf ofJ = logs_.col(j);
    const Eigen::VectorXf watchedJ = covariance_.col(j);
    const auto count = static_cast<float>(logs_.rows());
    const std::vector<LightAndView> chosen = {candidates_[static_cast<std::size_t>(j)]};
    Eigen::VectorXf row =
        (kDeviation * kDeviation * discrepancyKernel(materialClass_, candidates_, chosen, kLength))
            .cast<float>();
    forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
        auto part = row.segment(first, columns);
        part.noalias() += logs_.middleCols(first, columns).transpose() * ofJ / count;
        for (const Downdate& earlier : chosen_) {
            part -= earlier.gain(j) * earlier.divisor * earlier.gain.segment(first, columns);
        }
    });
    const float divisor = row(j) + static_cast<float>(kSampleVariance);
    left_ -= watchedJ.squaredNorm() / static_cast<double>(divisor);
    const Eigen::VectorXf gain = row / divisor;
    forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
        covariance_.middleCols(first, columns).noalias() -=
            watchedJ * gain.segment(first, columns).transpose();
    });
    variance_ = (variance_ - (gain.cwiseAbs2() * divisor).cast<double>()).cwiseMax(0);
    chosen_.push_back({gain, divisor});
    return chosen_.back();
}

double ConditionedClass::shareLeft() const {
    return std::max(left_, 0.0) / std::max(total_, 1e-30);
}

double ConditionedClass::varianceLeft() const {
    return std::max(left_, 0.0) / pairs_;
}

void ConditionedClass::forEachColumns(const Columns& body) const {
    forEachTexelBlock(
        static_cast<std::size_t>(logs_.cols()), 512, [&](std::size_t begin, std::size_t end) {
            body(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
        });
}

Uncertainty uncertaintyOf(std::span<const ConditionedClass> classes) {
    Uncertainty left{0, 0};
    double variance = 0;
    for (const ConditionedClass& c : classes) {
        left.share += c.shareLeft() / static_cast<double>(classes.size());
        variance += c.varianceLeft() / static_cast<double>(classes.size());
    }
    left.deviation = std::sqrt(variance);
    return left;
}

std::vector<ConditionedClass> conditionedClasses(const AngularGrid& grid,
                                                 const std::vector<LightAndView>& candidates,
                                                 const ConditionOptions& options) {
    return conditionedClasses(grid, watchedPairs(grid, options.seed), candidates, options);
}

std::vector<ConditionedClass> conditionedClasses(const AngularGrid& grid,
                                                 const WatchedPairs& watched,
                                                 const std::vector<LightAndView>& candidates,
                                                 const ConditionOptions& options) {
    std::vector<ConditionedClass> classes;
    for (const MaterialClass materialClass : kMaterialClasses) {
        classes.emplace_back(materialClass, grid, watched, candidates, options);
    }
    return classes;
}

}  // namespace abrdf
