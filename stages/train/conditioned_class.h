// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/material_class.h"
#include "stages/train/watched_pairs.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace abrdf {

struct ConditionOptions {
    std::size_t materials = 1000;  ///< Random materials of the class, >= 2.
    std::uint64_t seed = 1;        ///< Of the materials.
};

/// What random materials of one class still leave open, once the candidates chosen so far are
/// measured: Gaussian, of the logarithm of luminance over the body, weighted by what a display
/// shows of it (design: estimator.md, section 4). The same bits for any number of threads.
class ConditionedClass {
  public:
    /// candidates: pairs that may be chosen, anywhere; empty: those of the grid.
    ConditionedClass(MaterialClass materialClass, const AngularGrid& grid,
                     const WatchedPairs& watched, std::vector<LightAndView> candidates,
                     const ConditionOptions& options);

    std::size_t candidateCount() const { return candidates_.size(); }

    /// Adds to `score` what each candidate would explain of the weighted variance.
    void addScores(Eigen::VectorXd& score) const;

    /// What the candidates first .. first + count - 1 would explain together, in the same unit;
    /// own: their covariance, as ownCovariance() gives it and choose() keeps it.
    double scoreOf(Eigen::Index first, const Eigen::MatrixXd& own) const;

    /// The covariance of the candidates first .. first + count - 1 before anything is chosen.
    Eigen::MatrixXd ownCovariance(Eigen::Index first, Eigen::Index count) const;

    /// What choosing a candidate takes from the covariance of any two: divisor gain gain^T.
    struct Downdate {
        Eigen::VectorXf gain;  ///< Of each candidate.
        float divisor = 1;
    };

    /// Conditions everything on candidate j.
    const Downdate& choose(Eigen::Index j);

    /// What is left of the weighted variance, 1 .. 0.
    double shareLeft() const;

    /// The same as a mean over the pairs that the watched ones stand for, in L* squared.
    double varianceLeft() const;

  private:
    std::vector<LightAndView> candidatesAt(Eigen::Index first, Eigen::Index count) const;
    /// Factor on scores: the share of the class over the root of its variance.
    double balance() const;
    using Columns = std::function<void(Eigen::Index first, Eigen::Index count)>;
    void forEachColumns(const Columns& body) const;

    MaterialClass materialClass_;
    std::vector<LightAndView> candidates_;
    Eigen::MatrixXf logs_;        ///< Material, candidate.
    Eigen::MatrixXf covariance_;  ///< Watched pair (weighted), candidate.
    Eigen::VectorXd variance_;    ///< Of each candidate.
    double pairs_ = 0;            ///< That the watched ones stand for.
    double total_ = 0;            ///< Weighted variance of the watched pairs at first ...
    double left_ = 0;             ///< ... and now.
    std::vector<Downdate> chosen_;
};

/// What all classes together leave open.
struct Uncertainty {
    double share = 1;      ///< Mean of shareLeft().
    double deviation = 0;  ///< Root of the mean of varianceLeft(), in L*.
};
Uncertainty uncertaintyOf(std::span<const ConditionedClass> classes);

/// All classes over the same pairs.
std::vector<ConditionedClass> conditionedClasses(const AngularGrid& grid,
                                                 const WatchedPairs& watched,
                                                 const std::vector<LightAndView>& candidates,
                                                 const ConditionOptions& options);

/// The same, watching watchedPairs(grid).
std::vector<ConditionedClass> conditionedClasses(const AngularGrid& grid,
                                                 const std::vector<LightAndView>& candidates,
                                                 const ConditionOptions& options);

}  // namespace abrdf
