// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/greedy_pairs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace abrdf {

namespace {

void checkCount(const GreedyOptions& options, std::size_t most) {
    if (options.count < 1 || options.count > most || options.materials < 2) {
        throw std::invalid_argument(
            "a greedy plan needs at least one sample, two materials, and no more samples than "
            "pairs");
    }
}

/// allowed: above 0 where a candidate may be chosen.
GreedyChoice chosen(std::vector<ConditionedClass> classes, Eigen::VectorXd allowed,
                    const GreedyOptions& options, const ProgressSink& progress) {
    GreedyChoice choice;
    while (choice.pairs.size() < options.count) {
        const std::size_t place = choice.pairs.size();
        Eigen::Index best = 0;
        if (place < options.first.size()) {
            best = static_cast<Eigen::Index>(options.first[place]);
        } else {
            Eigen::VectorXd score = Eigen::VectorXd::Zero(allowed.size());
            for (const ConditionedClass& c : classes) c.addScores(score);
            (allowed.array() > 0).select(score, -1).maxCoeff(&best);
        }
        allowed(best) = 0;
        for (ConditionedClass& c : classes) c.choose(best);
        choice.pairs.push_back(static_cast<std::size_t>(best));
        const Uncertainty left = uncertaintyOf(classes);
        choice.variance.push_back(left.share);
        choice.deviation.push_back(left.deviation);
        if (progress) progress({"plan", "samples", choice.pairs.size(), options.count});
    }
    return choice;
}

}  // namespace

std::size_t greedyMaterials(std::size_t pairs) {
    return std::clamp<std::size_t>(1000 * 6561 / std::max<std::size_t>(pairs, 1), 200, 1000);
}

GreedyChoice greedyPairs(const AngularGrid& grid, std::span<const std::size_t> candidates,
                         const GreedyOptions& options, const ProgressSink& progress) {
    return greedyPairs(grid, candidates, watchedPairs(grid, options.seed), options, progress);
}

GreedyChoice greedyPairs(const AngularGrid& grid, std::span<const std::size_t> candidates,
                         const WatchedPairs& watched, const GreedyOptions& options,
                         const ProgressSink& progress) {
    checkCount(options, candidates.empty() ? grid.pairCount() : candidates.size());
    const auto pairs = static_cast<Eigen::Index>(grid.pairCount());
    Eigen::VectorXd allowed = Eigen::VectorXd::Constant(pairs, candidates.empty() ? 1 : 0);
    for (const std::size_t pair : candidates) allowed(static_cast<Eigen::Index>(pair)) = 1;
    return chosen(conditionedClasses(grid, watched, {}, {options.materials, options.seed}),
                  std::move(allowed), options, progress);
}

GreedyChoice greedyPairs(std::vector<ConditionedClass> classes, const GreedyOptions& options,
                         const ProgressSink& progress) {
    const std::size_t candidates = classes.front().candidateCount();
    checkCount(options, candidates);
    return chosen(std::move(classes), Eigen::VectorXd::Ones(static_cast<Eigen::Index>(candidates)),
                  options, progress);
}

}  // namespace abrdf
