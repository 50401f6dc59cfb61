// SPDX-License-Identifier: BSD-3-Clause
//
// Is there a map of errors, a number a pair, that deserves to be stored? Candidates are made from
// random materials alone and tried on the measured ones: the table "A confidence a pair" of
// README.md.
#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"
#include "abrdf/random.h"
#include "color/delta_e.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/grey_prior.h"
#include "stages/reconstruct/prior_map.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/slice/choose_samples.h"
#include "stages/train/random_material.h"
#include "stages/train/train_prior.h"
#include "stages/train/training_values.h"
#include "tests/support/measured_materials.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

using namespace abrdf;

namespace {

constexpr std::size_t kMaterials = 240;  ///< Random ones, that no training has seen.
constexpr std::size_t kStep = 4;         ///< Every so many-th pair is looked at.
constexpr double kLeast = 1e-2;          ///< Delta E below which nothing is told apart.

/// Of one plan.
struct Setting {
    SampleSet samples;
    PriorModel model;                ///< For the pairs that are looked at.
    std::vector<std::size_t> pairs;  ///< Of UBO2003's grid.
    Eigen::VectorXd nearest;         ///< Of each, the distance of the nearest sample's features.
    Eigen::VectorXd halfAngle;       ///< Of each, degrees.
};

/// What may tell of the error at each pair, and the error.
struct Seen {
    Eigen::VectorXd slope;   ///< dL*/d ln B of the estimate: what a relative error shows.
    Eigen::VectorXd spread;  ///< Deviation of the mixture's terms, in L*.
    Eigen::VectorXd error;   ///< Delta E.
    double leftOut = 0;      ///< Mean Delta E of left-out samples.
    bool isIsotropic = false;
};

Setting settingOf(const SamplePlan& plan) {
    const AngularGrid grid(ubo81Directions());
    Setting setting;
    setting.samples = chooseSamples(plan, grid, SampleWish::kMeasuredPairs);
    std::vector<LightAndView> outputs;
    for (std::size_t pair = 0; pair < grid.pairCount(); pair += kStep) {
        if (std::ranges::binary_search(setting.samples.pairs, pair)) continue;
        setting.pairs.push_back(pair);
        outputs.push_back(grid.pair(pair));
    }
    setting.model = trainPrior(setting.samples.directions, outputs, {}, {});
    const Eigen::MatrixXd features = isotropicFeatures(outputs);
    setting.nearest = squaredDistances(features, isotropicFeatures(setting.samples.directions))
                          .rowwise()
                          .minCoeff()
                          .cwiseSqrt();
    setting.halfAngle = features.col(0).array().exp() - 2;
    return setting;
}

double slopeOf(double value) {
    return (lightness(value * 1.01) - lightness(value * 0.99)) / 0.02;
}

/// Deviation of the predictions of a mixture's terms about their mean, in ln(value).
Eigen::VectorXd spreadOf(const Setting& setting, const Eigen::VectorXd& luminance) {
    const PriorModel& model = setting.model;
    const LogSamples logs = logSamples(model, luminance);
    const PairGroups isotropic = isotropicPairs(model.outputs);
    const auto rows = static_cast<Eigen::Index>(model.outputs.size());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(rows);
    Eigen::VectorXd square = Eigen::VectorXd::Zero(rows);
    for (PriorTerm term : chooseTerms(model, luminance, 0)) {
        const double weight = term.weight;
        term.weight = 1;
        const bool few = isIsotropic(model, {term});
        const PriorMap map =
            priorMap(model, {term}, few ? isotropic.distinct : model.outputs, isotropic.rowOf);
        Eigen::VectorXd x = (map.offset + map.matrix * logs.z.cast<float>()).cast<double>();
        if (few) x = x(isotropic.rowOf).eval();
        mean += weight * x;
        square += weight * x.cwiseAbs2();
    }
    return (square - mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
}

Seen seenOf(const Setting& setting, const GreyPrior& prior, const Eigen::VectorXd& luminance,
            const Eigen::VectorXd& estimate) {
    Seen seen;
    seen.slope = estimate.unaryExpr([](double value) { return slopeOf(std::max(value, 1e-6)); });
    seen.spread = seen.slope.cwiseProduct(spreadOf(setting, luminance));
    const GreyEstimate own = prior.estimate(luminance);
    for (Eigen::Index k = 0; k < luminance.size(); ++k) {
        seen.leftOut += static_cast<double>(prior.shares()[static_cast<std::size_t>(k)]) *
                        std::abs(lightness(own.leftOut(k)) - lightness(luminance(k)));
    }
    seen.isIsotropic = own.isotropicShare >= kIsotropicShare;
    return seen;
}

std::vector<Seen> ofRandom(const Setting& setting, const GreyPrior& prior) {
    std::vector<Seen> all(kMaterials);
    const std::vector<VectorPair> samples = vectorPairs(setting.model.samples);
    const std::vector<VectorPair> outputs = vectorPairs(setting.model.outputs);
    forEachImage(kMaterials, [&](std::size_t i) {
        Random random(0xc0f1de, i);
        const PreparedMaterial material(
            randomMaterial(kMaterialClasses[i % kMaterialClasses.size()], random));
        const Eigen::VectorXd luminance = valuesOf(material, samples);
        const Eigen::VectorXd estimate = prior.estimate(luminance).outputs;
        all[i] = seenOf(setting, prior, luminance, estimate);
        const Eigen::VectorXd truth = valuesOf(material, outputs);
        all[i].error = estimate.binaryExpr(
            truth, [](double a, double b) { return std::abs(lightness(a) - lightness(b)); });
    });
    return all;
}

std::vector<Seen> ofMeasured(const Setting& setting, const GreyPrior& prior) {
    std::vector<Seen> all;
    std::vector<std::size_t> rows(setting.pairs.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    for (const std::vector<Rgb>& table : measuredMaterials()) {
        std::vector<Rgb> values;
        std::vector<Rgb> truth;
        for (const std::size_t pair : setting.samples.pairs) values.push_back(table[pair]);
        for (const std::size_t pair : setting.pairs) truth.push_back(table[pair]);
        std::vector<Rgb> abrdf(rows.size());
        PriorMaterial(setting.model, rows, values, {}).reconstruct(values, abrdf);
        const auto luminances = [](const std::vector<Rgb>& colors) {
            Eigen::VectorXd result(static_cast<Eigen::Index>(colors.size()));
            for (std::size_t i = 0; i < colors.size(); ++i) {
                result(static_cast<Eigen::Index>(i)) =
                    static_cast<double>(colors[i].r + colors[i].g + colors[i].b) / 3;
            }
            return result;
        };
        Seen seen = seenOf(setting, prior, luminances(values), luminances(abrdf));
        const std::vector<float> errors = deltaEMap(truth, abrdf, 1);
        seen.error =
            Eigen::Map<const Eigen::VectorXf>(errors.data(), std::ssize(errors)).cast<double>();
        all.push_back(std::move(seen));
    }
    return all;
}

/// Something that grows with the error at each pair.
using Score = Eigen::VectorXd;

Score logOf(const Eigen::VectorXd& values) {
    return values.array().max(kLeast).log();
}

/// Least squares of ln(error) by what is seen, over the random materials.
class LearnedScore {
  public:
    LearnedScore(const Setting& setting, const std::vector<Seen>& lessons) {
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kCount, kCount);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(kCount);
        for (const Seen& seen : lessons) {
            const Eigen::MatrixXd f = featuresOf(setting, seen);
            normal += f.transpose() * f;
            right += f.transpose() * logOf(seen.error);
        }
        weights_ = normal.ldlt().solve(right);
    }
    Score operator()(const Setting& setting, const Seen& seen) const {
        return (featuresOf(setting, seen) * weights_).array().exp();
    }

  private:
    static constexpr Eigen::Index kCount = 6;
    static Eigen::MatrixXd featuresOf(const Setting& setting, const Seen& seen) {
        Eigen::MatrixXd f(seen.slope.size(), kCount);
        f << Eigen::VectorXd::Ones(f.rows()), logOf(seen.slope), logOf(seen.spread),
            logOf(setting.nearest), (setting.halfAngle.array() + 2).log().matrix(),
            Eigen::VectorXd::Constant(f.rows(), std::log(std::max(seen.leftOut, kLeast)));
        return f;
    }
    Eigen::VectorXd weights_;
};

double quantileOf(std::vector<double> values, double q) {
    const auto place = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + place);
    return values[static_cast<std::size_t>(place)];
}

/// Of each pair the q-quantile, over the random materials of a kind, of its error beside what
/// left-out samples err.
Score conformal(const std::vector<Seen>& lessons, bool isIsotropic, double q) {
    Score result(lessons.front().error.size());
    for (Eigen::Index pair = 0; pair < result.size(); ++pair) {
        std::vector<double> ratios;
        for (const Seen& seen : lessons) {
            if (seen.isIsotropic == isIsotropic && seen.leftOut > 0.1) {
                ratios.push_back(seen.error(pair) / seen.leftOut);
            }
        }
        result(pair) = quantileOf(std::move(ratios), q);
    }
    return result;
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::ArrayXd x = a.array() - a.mean();
    const Eigen::ArrayXd y = b.array() - b.mean();
    return (x * y).sum() / std::sqrt(std::max(x.square().sum() * y.square().sum(), 1e-30));
}

Eigen::VectorXd ranksOf(const Eigen::VectorXd& values) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::ranges::sort(order, {}, [&](Eigen::Index i) { return values(i); });
    Eigen::VectorXd ranks(values.size());
    for (std::size_t k = 0; k < order.size(); ++k) ranks(order[k]) = static_cast<double>(k);
    return ranks;
}

using Scorer = std::function<Score(const Seen&)>;

/// Scores as bounds: times what 68 and 95 % of the random materials' errors keep to.
void tryScore(const std::string& name, const std::vector<Seen>& lessons,
              const std::vector<Seen>& subjects, const Scorer& at68, const Scorer& at95) {
    const auto factor = [&](const Scorer& scorer, double q) {
        std::vector<double> ratios;
        for (const Seen& seen : lessons) {
            const Score score = scorer(seen);
            for (Eigen::Index i = 0; i < score.size(); ++i) {
                ratios.push_back(seen.error(i) / std::max(score(i), 1e-9));
            }
        }
        return quantileOf(std::move(ratios), q);
    };
    const double f68 = factor(at68, 0.68);
    const double f95 = factor(at95, 0.95);
    double linear = 0;
    double ranked = 0;
    double least = 1;
    double within68 = 0;
    double within95 = 0;
    for (const Seen& seen : subjects) {
        const auto share = 1 / static_cast<double>(subjects.size());
        const Score s68 = at68(seen);
        const double own = correlation(s68, seen.error);
        linear += share * own;
        least = std::min(least, own);
        ranked += share * correlation(ranksOf(s68), ranksOf(seen.error));
        const auto within = [&](const Score& score, double f) {
            return (seen.error.array() <= f * score.array()).cast<double>().mean();
        };
        within68 += share * within(s68, f68);
        within95 += share * within(at95(seen), f95);
    }
    fmt::print("| | {} | {:.2f} | {:.2f} | {:.2f} | {:.0f} % | {:.0f} % |\n", name, linear, least,
               ranked, 100 * within68, 100 * within95);
}

void tryAll(const SamplePlan& plan) {
    const Setting setting = settingOf(plan);
    const GreyPrior prior(setting.model);
    const std::vector<Seen> lessons = ofRandom(setting, prior);
    const std::vector<Seen> subjects = ofMeasured(setting, prior);
    fmt::print("| `{}` | | | | | | |\n", plan.name);
    const auto same = [&](const std::string& name, const Scorer& scorer) {
        tryScore(name, lessons, subjects, scorer, scorer);
    };
    same("what a relative error shows there", [](const Seen& s) { return s.slope; });
    same("distance to the nearest sample, times that",
         [&](const Seen& s) { return Score(s.slope.cwiseProduct(setting.nearest) * s.leftOut); });
    same("nearness to the mirror, times that", [&](const Seen& s) {
        return Score(s.slope.array() / (setting.halfAngle.array() + 5) * s.leftOut);
    });
    same("spread over the mixture's terms", [](const Seen& s) { return s.spread; });
    const Score iso68 = conformal(lessons, true, 0.68);
    const Score iso95 = conformal(lessons, true, 0.95);
    const Score other68 = conformal(lessons, false, 0.68);
    const Score other95 = conformal(lessons, false, 0.95);
    tryScore(
        "quantiles of random materials' errors a pair and kind", lessons, subjects,
        [&](const Seen& s) { return Score((s.isIsotropic ? iso68 : other68) * s.leftOut); },
        [&](const Seen& s) { return Score((s.isIsotropic ? iso95 : other95) * s.leftOut); });
    const LearnedScore learned(setting, lessons);
    same("all of it, least squares over random materials",
         [&](const Seen& s) { return learned(setting, s); });
}

}  // namespace

int main() {
    if (measuredMaterials().empty()) {
        fmt::print("there are no measured materials beside this checkout\n");
        return 0;
    }
    fmt::print("| plan | what is to tell | correlation | least | of ranks | 68 % | 95 % |\n");
    const AngularGrid grid(ubo81Directions());
    const std::vector<std::size_t>& greedy = greedyPairsOfUbo81();
    for (const std::ptrdiff_t count : {204, 52}) {
        tryAll(pairsPlan(fmt::format("greedy:{}", count), grid,
                         {greedy.begin(), greedy.begin() + count}));
    }
    tryAll(sixteenSlicesPlan(0, &grid));
    tryAll(eightPlan(0, &grid));
}
