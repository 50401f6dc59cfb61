// SPDX-License-Identifier: BSD-3-Clause
//
// Moments of random materials (design: estimator.md, 2.1 to 2.3).
#include "stages/train/train_prior.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/matrix_product.h"
#include "abrdf/pair_features.h"
#include "abrdf/portable_math.h"
#include "stages/train/random_material.h"
#include "stages/train/training_values.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

/// Pairs at which a material's highlight is looked for.
constexpr std::size_t kProbes = 1000;

/// A highlight that all samples miss is learned as this many times the largest of them.
constexpr double kMostOfTop = 10;

/// The materials of one class, and what they show at the samples.
struct Lesson {
    MaterialClass materialClass = MaterialClass::kIso;
    std::vector<PreparedMaterial> materials;
    Eigen::MatrixXf samples;  ///< A column a material.
    std::vector<double> top;  ///< Mean of each material's largest samples.
};

/// Every k-th of the pairs, so that no more than kProbes are left.
std::vector<LightAndView> probesOf(const std::vector<LightAndView>& pairs) {
    const std::size_t step = (pairs.size() + kProbes - 1) / kProbes;
    std::vector<LightAndView> probes;
    for (std::size_t i = 0; i < pairs.size(); i += step) probes.push_back(pairs[i]);
    return probes;
}

/// Draws the class's materials; drops those whose highlight the samples miss altogether. Adds
/// ln(top / 99.5 % quantile) of each to `sumOfLogs`.
Lesson prepareLesson(MaterialClass materialClass, const std::vector<VectorPair>& samples,
                     const std::vector<VectorPair>& probes, const TrainOptions& options,
                     double& sumOfLogs, std::size_t& count) {
    Lesson lesson;
    lesson.materialClass = materialClass;
    std::vector<PreparedMaterial> all;
    for (const AnalyticMaterial& material :
         randomMaterials(materialClass, options.materials, options.seed)) {
        all.emplace_back(material);
    }
    const Eigen::MatrixXf atSamples = valuesOf(all, samples);
    const Eigen::VectorXd highlight = quantileOfColumns(valuesOf(all, probes), 0.995);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index m = 0; m < atSamples.cols(); ++m) {
        const float* column = atSamples.col(m).data();
        const double top = largestMean(std::vector<double>(column, column + atSamples.rows()));
        sumOfLogs += std::log(std::max(top / std::max(highlight(m), 1e-30), 1e-4));
        ++count;
        if (!(top > 3e-3 * highlight(m)) || top <= 0) continue;
        kept.push_back(m);
        lesson.top.push_back(top);
        lesson.materials.push_back(all[static_cast<std::size_t>(m)]);
    }
    lesson.samples = atSamples(Eigen::all, kept);
    return lesson;
}

/// ln(min(value / scale, most / scale) + floor), a column a material.
void takeLogarithms(Eigen::MatrixXf& values, const Lesson& lesson, double scaleFactor,
                    double most) {
    forEachTexelBlock(lesson.materials.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            const auto inverse = static_cast<float>(1 / (scaleFactor * lesson.top[m]));
            const auto cap = static_cast<float>(most / scaleFactor);
            float* column = values.col(static_cast<Eigen::Index>(m)).data();
            for (Eigen::Index i = 0; i < values.rows(); ++i) {
                const float relative = std::max(column[i] * inverse, 0.0F);
                column[i] =
                    portable::log(std::min(relative, cap) + static_cast<float>(kPriorFloor));
            }
        }
    });
}

/// Removes each row's mean over the materials, and returns it.
Eigen::VectorXf centered(Eigen::MatrixXf& logs) {
    Eigen::VectorXf mean = logs.rowwise().mean();
    logs.colwise() -= mean;
    return mean;
}

PriorClass learn(const Lesson& lesson, double scaleFactor, const std::vector<LightAndView>& samples,
                 const std::vector<LightAndView>& outputs) {
    constexpr double kNoCap = 1e30;
    constexpr std::size_t kRows = 512;
    const auto count = static_cast<float>(lesson.materials.size());
    PriorClass learned;
    learned.materialClass = lesson.materialClass;
    Eigen::MatrixXf z = lesson.samples;
    takeLogarithms(z, lesson, scaleFactor, kNoCap);
    learned.sampleMean = centered(z).cast<double>();
    const Eigen::MatrixXf transposed = z.transpose();
    const Eigen::MatrixXd covariance = (z.cast<double>() * z.cast<double>().transpose()) / count;
    learned.spectra = spectraOf(covariance, lesson.materialClass, samples);

    const auto rows = static_cast<Eigen::Index>(outputs.size());
    learned.outputMean.resize(rows);
    learned.cross.resize(rows, z.rows());
    // Blocks of outputs, so that memory does not grow with the grid.
    for (std::size_t first = 0; first < outputs.size(); first += kRows) {
        const std::size_t size = std::min(kRows, outputs.size() - first);
        Eigen::MatrixXf x =
            valuesOf(lesson.materials, vectorPairs(std::span(outputs).subspan(first, size)));
        takeLogarithms(x, lesson, scaleFactor, kMostOfTop);
        const auto block =
            Eigen::seqN(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(size));
        learned.outputMean(block) = centered(x);
        learned.cross(block, Eigen::all) = product(x, transposed) / count;
    }
    return learned;
}

}  // namespace

TrainOptions settled(TrainOptions options, std::size_t outputs) {
    constexpr std::size_t kMost = 2000;
    constexpr std::size_t kLeast = 500;
    if (options.materials == 0) {
        options.materials =
            std::clamp(kMost * 6561 / std::max<std::size_t>(outputs, 1), kLeast, kMost);
    }
    return options;
}

PriorModel trainPrior(const std::vector<LightAndView>& samples,
                      const std::vector<LightAndView>& outputs, const TrainOptions& asked,
                      const ProgressSink& progress) {
    const TrainOptions options = settled(asked, outputs.size());
    if (samples.empty() || outputs.empty() || options.materials < 2) {
        throw std::invalid_argument("the prior needs samples, outputs and at least two materials");
    }
    PriorModel model;
    model.samples = samples;
    model.outputs = outputs;
    const std::vector<VectorPair> sampleVectors = vectorPairs(samples);
    const std::vector<VectorPair> probes = vectorPairs(probesOf(outputs));
    std::vector<Lesson> lessons;
    double sumOfLogs = 0;
    std::size_t count = 0;
    const std::size_t steps = 2 * kMaterialClasses.size() * options.materials;
    std::size_t done = 0;
    const auto tick = [&] {
        done += options.materials;
        if (progress) progress({"train", "materials", done, steps});
    };
    for (const MaterialClass materialClass : kMaterialClasses) {
        lessons.push_back(
            prepareLesson(materialClass, sampleVectors, probes, options, sumOfLogs, count));
        tick();
    }
    model.scaleFactor = std::exp(-sumOfLogs / static_cast<double>(count));
    const PairGroups isotropic = isotropicPairs(outputs);
    for (const Lesson& lesson : lessons) {
        const bool isIso = lesson.materialClass == MaterialClass::kIso;
        model.classes.push_back(
            learn(lesson, model.scaleFactor, samples, isIso ? isotropic.distinct : outputs));
        tick();
    }
    return model;
}

}  // namespace abrdf
