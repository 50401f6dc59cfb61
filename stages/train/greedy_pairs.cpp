// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/greedy_pairs.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/portable_math.h"
#include "stages/train/random_material.h"
#include "stages/train/training_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

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

/// Pairs whose uncertainty is watched, and how many each of them stands for.
struct Watched {
    std::vector<Eigen::Index> pairs;
    Eigen::VectorXd share;
};

Watched watchedPairs(const AngularGrid& grid, std::uint64_t seed) {
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
    Watched watched;
    watched.pairs = mirrors;
    watched.pairs.insert(watched.pairs.end(), others.begin(),
                         others.begin() + static_cast<std::ptrdiff_t>(kept));
    watched.share = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(watched.pairs.size()));
    watched.share.tail(static_cast<Eigen::Index>(kept))
        .setConstant(static_cast<double>(others.size()) /
                     static_cast<double>(std::max<std::size_t>(kept, 1)));
    return watched;
}

/// One class of materials, conditioned on the pairs chosen so far.
class Lesson {
  public:
    Lesson(MaterialClass materialClass, const AngularGrid& grid, const Watched& watched,
           const GreedyOptions& options)
        : pairs_(pairsOf(grid)), materialClass_(materialClass) {
        std::vector<PreparedMaterial> materials;
        for (const AnalyticMaterial& m :
             randomMaterials(materialClass, options.materials, options.seed)) {
            materials.emplace_back(m);
        }
        const Eigen::MatrixXf values = valuesOf(materials, vectorPairs(pairs_));
        const Eigen::VectorXd highlight = quantileOfColumns(values, 0.995);
        takeLogarithms(values, highlight, grid);
        const Eigen::VectorXd weight = weights(values, highlight, watched);
        const auto count = static_cast<float>(logs_.rows());
        const Eigen::MatrixXf watchedLogs =
            logs_(Eigen::all, watched.pairs) * weight.cast<float>().asDiagonal();
        covariance_.resize(watchedLogs.cols(), logs_.cols());
        forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
            covariance_.middleCols(first, columns).noalias() =
                watchedLogs.transpose() * logs_.middleCols(first, columns) / count;
        });
        std::vector<LightAndView> watchedPairs;
        for (const Eigen::Index i : watched.pairs) {
            watchedPairs.push_back(pairs_[static_cast<std::size_t>(i)]);
        }
        covariance_ +=
            (kDeviation * kDeviation * weight).cast<float>().asDiagonal() *
            discrepancyKernel(materialClass, watchedPairs, pairs_, kLength).cast<float>();
        variance_ = logs_.cwiseAbs2().colwise().mean().transpose().cast<double>();
        variance_.array() += kDeviation * kDeviation;
        total_ = watchedLogs.squaredNorm() / static_cast<double>(count) +
                 kDeviation * kDeviation * weight.squaredNorm();
        left_ = total_;
    }

    /// Adds to `score` what each pair would explain of the weighted variance.
    void addScores(Eigen::VectorXd& score) const {
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

    /// Conditions everything on pair j.
    void choose(Eigen::Index j) {
        const Eigen::VectorXf ofJ = logs_.col(j);
        const Eigen::VectorXf watchedJ = covariance_.col(j);
        const auto count = static_cast<float>(logs_.rows());
        const std::vector<LightAndView> chosen = {pairs_[static_cast<std::size_t>(j)]};
        Eigen::VectorXf row =
            (kDeviation * kDeviation * discrepancyKernel(materialClass_, pairs_, chosen, kLength))
                .cast<float>();
        forEachColumns([&](Eigen::Index first, Eigen::Index columns) {
            auto part = row.segment(first, columns);
            part.noalias() += logs_.middleCols(first, columns).transpose() * ofJ / count;
            for (std::size_t i = 0; i < gains_.size(); ++i) {
                part -= gains_[i](j) * divisors_[i] * gains_[i].segment(first, columns);
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
        gains_.push_back(gain);
        divisors_.push_back(divisor);
    }

    double varianceLeft() const { return std::max(left_, 0.0) / std::max(total_, 1e-30); }

  private:
    /// ln(value / body + floor), centred: a row a material. The body is the median away from
    /// mirrors.
    void takeLogarithms(const Eigen::MatrixXf& values, const Eigen::VectorXd& highlight,
                        const AngularGrid& grid) {
        std::vector<Eigen::Index> body;
        for (std::size_t i = 0; i < grid.pairCount(); ++i) {
            if (halfAngle(grid.pair(i)) > radiansFromDegrees(25)) {
                body.push_back(static_cast<Eigen::Index>(i));
            }
        }
        logs_.resize(values.cols(), values.rows());
        forEachTexelBlock(
            static_cast<std::size_t>(values.cols()), 8, [&](std::size_t begin, std::size_t end) {
                for (std::size_t m = begin; m < end; ++m) {
                    const auto column = static_cast<Eigen::Index>(m);
                    std::vector<float> sorted;
                    for (const Eigen::Index i : body) sorted.push_back(values(i, column));
                    if (sorted.empty()) sorted.push_back(0);
                    const auto middle =
                        sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
                    std::ranges::nth_element(sorted, middle);
                    const auto least =
                        static_cast<float>(std::max(1e-6 * highlight(column), 1e-12));
                    const float unit = 1 / std::max(*middle, least);
                    for (Eigen::Index i = 0; i < values.rows(); ++i) {
                        logs_(column, i) = portable::log(values(i, column) * unit + kFloor);
                    }
                }
            });
        logs_.rowwise() -= logs_.colwise().mean().eval();
    }

    /// Root of the mean squared sensitivity of each watched pair, at natural and highlight
    /// exposure, times the pairs it stands for.
    static Eigen::VectorXd weights(const Eigen::MatrixXf& values, const Eigen::VectorXd& highlight,
                                   const Watched& watched) {
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

    template <typename Body>
    void forEachColumns(const Body& body) const {
        forEachTexelBlock(
            static_cast<std::size_t>(logs_.cols()), 512, [&](std::size_t begin, std::size_t end) {
                body(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
            });
    }

    std::vector<LightAndView> pairs_;
    MaterialClass materialClass_;
    Eigen::MatrixXf logs_;        ///< Material, pair.
    Eigen::MatrixXf covariance_;  ///< Watched pair (weighted), pair.
    Eigen::VectorXd variance_;    ///< Of each pair.
    double total_ = 0;            ///< Weighted variance of the watched pairs at first ...
    double left_ = 0;             ///< ... and now.
    std::vector<Eigen::VectorXf> gains_;
    std::vector<float> divisors_;
};

}  // namespace

GreedyChoice greedyPairs(const AngularGrid& grid, std::span<const std::size_t> candidates,
                         const GreedyOptions& options, const ProgressSink& progress) {
    const std::size_t most = candidates.empty() ? grid.pairCount() : candidates.size();
    if (options.count < 1 || options.count > most || options.materials < 2) {
        throw std::invalid_argument(
            "a greedy plan needs at least one sample, two materials, and no more samples than "
            "pairs");
    }
    const Watched watched = watchedPairs(grid, options.seed);
    std::vector<Lesson> lessons;
    for (const MaterialClass materialClass : kMaterialClasses) {
        lessons.emplace_back(materialClass, grid, watched, options);
    }
    const auto pairs = static_cast<Eigen::Index>(grid.pairCount());
    Eigen::VectorXd allowed = Eigen::VectorXd::Constant(pairs, candidates.empty() ? 1 : 0);
    for (const std::size_t pair : candidates) allowed(static_cast<Eigen::Index>(pair)) = 1;
    GreedyChoice choice;
    while (choice.pairs.size() < options.count) {
        const std::size_t place = choice.pairs.size();
        Eigen::Index best = 0;
        if (place < options.first.size()) {
            best = static_cast<Eigen::Index>(options.first[place]);
        } else {
            Eigen::VectorXd score = Eigen::VectorXd::Zero(pairs);
            for (const Lesson& lesson : lessons) lesson.addScores(score);
            (allowed.array() > 0).select(score, -1).maxCoeff(&best);
        }
        allowed(best) = 0;
        double variance = 0;
        for (Lesson& lesson : lessons) {
            lesson.choose(best);
            variance += lesson.varianceLeft() / static_cast<double>(lessons.size());
        }
        choice.pairs.push_back(static_cast<std::size_t>(best));
        choice.variance.push_back(variance);
        if (progress) progress({"plan", "samples", choice.pairs.size(), options.count});
    }
    return choice;
}

}  // namespace abrdf
