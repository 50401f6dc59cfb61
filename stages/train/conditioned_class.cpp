// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/conditioned_class.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/portable_math.h"
#include "abrdf/scene_pairs.h"
#include "stages/train/random_material.h"
#include "stages/train/training_values.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr double kSampleVariance = 1e-2;  ///< lambda: of a sample's own noise, in ln(value).
constexpr float kFloor = 1e-2F;         ///< Below this share of the body nothing is to be learned.
constexpr std::size_t kOutputs = 1500;  ///< Pairs whose uncertainty is watched, beside mirrors.

// Real materials deviate from random ones: the discrepancy kernel, as the prior has it.
constexpr double kDeviation = 0.8;
constexpr double kLength = 1.2;

/// Of the highlight exposure, where the natural one counts 1.
constexpr double kHighlightShare = 0.5;

/// Isotropic materials count double: most measured ones are.
double shareOf(MaterialClass materialClass) {
    return materialClass == MaterialClass::kIso ? 2 : 1;
}

Radians halfAngle(const LightAndView& pair) {
    const Imath::V3d half =
        (vectorFromDirection(pair.light) + vectorFromDirection(pair.view)).normalized();
    return std::acos(std::clamp(half.z, -1.0, 1.0));
}

bool isMirror(const LightAndView& pair) {
    return halfAngle(pair) < radiansFromDegrees(1e-3);
}

/// dL* / d ln B; nothing changes on a display where B is above 1.
double sensitivity(double value) {
    if (value >= 1) return 0;
    return value > 0.008856 ? 116.0 / 3 * std::cbrt(value) : 903.3 * value;
}

/// Root of the mean squared sensitivity of each watched pair, at natural and highlight exposure,
/// times the pairs it stands for.
Eigen::VectorXd weights(const Eigen::MatrixXf& values, const Eigen::VectorXd& highlight,
                        const WatchedPairs& watched) {
    Eigen::VectorXd weight(watched.share.size());
    for (Eigen::Index w = 0; w < weight.size(); ++w) {
        double sum = 0;
        for (Eigen::Index m = 0; m < values.cols(); ++m) {
            const auto value =
                static_cast<double>(values(watched.pairs[static_cast<std::size_t>(w)], m));
            const double natural = sensitivity(value);
            const double highlit = sensitivity(value / std::max(highlight(m), 1e-12));
            sum += natural * natural + kHighlightShare * highlit * highlit;
        }
        weight(w) = std::sqrt(sum / static_cast<double>(values.cols()) * watched.share(w));
    }
    return weight;
}

Eigen::MatrixXf valuesOfClass(MaterialClass materialClass, const std::vector<LightAndView>& pairs,
                              const ConditionOptions& options) {
    std::vector<PreparedMaterial> materials;
    for (const AnalyticMaterial& m :
         randomMaterials(materialClass, options.materials, options.seed)) {
        materials.emplace_back(m);
    }
    return valuesOf(materials, vectorPairs(pairs));
}

/// ln(value / body + floor), centred: a row a material. The body is the median of the grid's pairs
/// away from mirrors.
Eigen::MatrixXf logarithms(const Eigen::MatrixXf& values, const Eigen::VectorXd& highlight,
                           const AngularGrid& grid) {
    std::vector<Eigen::Index> body;
    for (std::size_t i = 0; i < grid.pairCount(); ++i) {
        if (halfAngle(grid.pair(i)) > radiansFromDegrees(25)) {
            body.push_back(static_cast<Eigen::Index>(i));
        }
    }
    Eigen::MatrixXf logs(values.cols(), values.rows());
    forEachTexelBlock(
        static_cast<std::size_t>(values.cols()), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t m = begin; m < end; ++m) {
                const auto column = static_cast<Eigen::Index>(m);
                std::vector<float> sorted;
                for (const Eigen::Index i : body) sorted.push_back(values(i, column));
                if (sorted.empty()) sorted.push_back(0);
                const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
                std::ranges::nth_element(sorted, middle);
                const auto least = static_cast<float>(std::max(1e-6 * highlight(column), 1e-12));
                const float unit = 1 / std::max(*middle, least);
                for (Eigen::Index i = 0; i < values.rows(); ++i) {
                    logs(column, i) = portable::log(values(i, column) * unit + kFloor);
                }
            }
        });
    logs.rowwise() -= logs.colwise().mean().eval();
    return logs;
}

}  // namespace

WatchedPairs watchedPairs(const AngularGrid& grid, std::uint64_t seed) {
    std::vector<Eigen::Index> mirrors;
    std::vector<Eigen::Index> others;
    for (std::size_t i = 0; i < grid.pairCount(); ++i) {
        (isMirror(grid.pair(i)) ? mirrors : others).push_back(static_cast<Eigen::Index>(i));
    }
    Random random(seed, hashOf({grid.pairCount()}));
    const std::size_t kept = std::min(kOutputs, others.size());
    for (std::size_t i = 0; i < kept; ++i) {
        std::swap(others[i], others[i + random.below(others.size() - i)]);
    }
    WatchedPairs watched;
    watched.pairs = mirrors;
    watched.pairs.insert(watched.pairs.end(), others.begin(),
                         others.begin() + static_cast<std::ptrdiff_t>(kept));
    watched.share = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(watched.pairs.size()));
    watched.share.tail(static_cast<Eigen::Index>(kept))
        .setConstant(static_cast<double>(others.size()) /
                     static_cast<double>(std::max<std::size_t>(kept, 1)));
    return watched;
}

WatchedPairs watchedPairs(const AngularGrid& grid, const std::vector<LightAndView>& scene,
                          std::span<const double> weights) {
    WatchedPairs watched;
    std::vector<double> shares;
    const auto watch = [&](std::size_t pair, double share) {
        watched.pairs.push_back(
            static_cast<Eigen::Index>(grid.pairCount() + watched.others.size()));
        watched.others.push_back(scene[pair]);
        shares.push_back(share);
    };
    if (scene.size() <= kOutputs) {
        for (std::size_t i = 0; i < scene.size(); ++i) watch(i, weights[i]);
    } else {
        for (const std::size_t i : spreadByWeight(weights, kOutputs)) watch(i, 1.0 / kOutputs);
    }
    watched.share =
        Eigen::Map<Eigen::VectorXd>(shares.data(), static_cast<Eigen::Index>(shares.size()));
    return watched;
}

ConditionedClass::ConditionedClass(MaterialClass materialClass, const AngularGrid& grid,
                                   const WatchedPairs& watched,
                                   std::vector<LightAndView> candidates,
                                   const ConditionOptions& options)
    : materialClass_(materialClass), candidates_(std::move(candidates)) {
    // The grid's pairs come first: what a material's body and highlight are is told by them.
    std::vector<LightAndView> all = pairsOf(grid);
    const auto gridPairs = static_cast<Eigen::Index>(all.size());
    all.insert(all.end(), watched.others.begin(), watched.others.end());
    const Eigen::Index firstCandidate =
        candidates_.empty() ? 0 : static_cast<Eigen::Index>(all.size());
    if (candidates_.empty()) {
        candidates_.assign(all.begin(), all.begin() + gridPairs);
    } else {
        all.insert(all.end(), candidates_.begin(), candidates_.end());
    }
    pairs_ = watched.share.sum();
    const Eigen::MatrixXf values = valuesOfClass(materialClass, all, options);
    const Eigen::VectorXd highlight = quantileOfColumns(values.topRows(gridPairs), 0.995);
    const Eigen::MatrixXf logs = logarithms(values, highlight, grid);
    const Eigen::VectorXd weight = weights(values, highlight, watched);
    const auto count = static_cast<float>(logs.rows());
    const Eigen::MatrixXf watchedLogs =
        logs(Eigen::all, watched.pairs) * weight.cast<float>().asDiagonal();
    logs_ = logs.middleCols(firstCandidate, static_cast<Eigen::Index>(candidates_.size()));
    std::vector<LightAndView> watchedAt;
    for (const Eigen::Index i : watched.pairs)
        watchedAt.push_back(all[static_cast<std::size_t>(i)]);
    const Eigen::VectorXf deviation = (kDeviation * kDeviation * weight).cast<float>();
    covariance_.resize(watchedLogs.cols(), logs_.cols());
    forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
        const std::vector<LightAndView> part(candidates_.begin() + first,
                                             candidates_.begin() + first + columns);
        covariance_.middleCols(first, columns).noalias() =
            watchedLogs.transpose() * logs_.middleCols(first, columns) / count;
        covariance_.middleCols(first, columns) +=
            deviation.asDiagonal() *
            discrepancyKernel(materialClass, watchedAt, part, kLength).cast<float>();
    });
    variance_ = logs_.cwiseAbs2().colwise().mean().transpose().cast<double>();
    variance_.array() += kDeviation * kDeviation;
    total_ = watchedLogs.squaredNorm() / static_cast<double>(count) +
             kDeviation * kDeviation * weight.squaredNorm();
    left_ = total_;
}

void ConditionedClass::addScores(Eigen::VectorXd& score) const {
    const double balance = shareOf(materialClass_) / std::sqrt(std::max(total_, 1e-30));
    forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
        score.segment(first, columns).array() +=
            balance *
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
    const double balance = shareOf(materialClass_) / std::sqrt(std::max(total_, 1e-30));
    return balance * noisy.llt().solve(seen).trace();
}

Eigen::MatrixXd ConditionedClass::ownCovariance(Eigen::Index first, Eigen::Index count) const {
    const auto part = logs_.middleCols(first, count);
    const std::vector<LightAndView> at(candidates_.begin() + first,
                                       candidates_.begin() + first + count);
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
