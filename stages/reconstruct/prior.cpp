// SPDX-License-Identifier: BSD-3-Clause
//
// `prior`: the conditional mean of log luminance under what random materials show, chroma by
// kriging (design: estimator.md, 2). Class and kernel are chosen once a material, by some of its
// texels; a texel then costs a few products with fixed matrices.
#include "abrdf/pair_features.h"
#include "stages/reconstruct/neighbour_error.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/reconstruct/reconstructor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abrdf {

// A new method is one file in this folder: the one to fall back to.
std::unique_ptr<Reconstructor> makeInverseDistance(const ReconstructionTask& task);

namespace {

/// Samples contradict every model where the four nearest others predict each sample better than the
/// models do, and the models err visibly. Of random materials that the models know, 1 in 60 is
/// taken for such, and comes out better for it; of measured ones none (tests/bench/README.md).
constexpr double kVisible = 1;
constexpr double kBetter = 0.95;

/// What the bound of such a material is over what its samples' neighbours say: of 248 with steps
/// or glitches the worst was 1.5 times as far from the truth.
constexpr float kUnlike = 2;

/// Doubles keep four digits beyond it.
constexpr double kMostCondition = 1e12;

/// Largest condition number of the systems that the terms were solved with.
double conditionOf(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    double condition = 1;
    for (const PriorTerm& term : terms) {
        if (term.isLambert) continue;
        const Eigen::VectorXd& values =
            model.classes[term.classIndex].spectra[term.spectrum].eigenvalues;
        condition = std::max(condition, (values.maxCoeff() + term.nu) /
                                            (std::max(values.minCoeff(), 0.0) + term.nu));
        if (!(values.minCoeff() + term.nu > 0 && condition <= kMostCondition)) {
            throw std::invalid_argument(fmt::format(
                "the prior's model is singular for these samples (eigenvalues {:.1e} to {:.1e}, "
                "noise {:.1e}, condition number at most {:g}); train it anew, with more "
                "--materials",
                values.minCoeff(), values.maxCoeff(), term.nu, kMostCondition));
        }
    }
    return condition;
}

class Prior : public Reconstructor {
  public:
    explicit Prior(const ReconstructionTask& task)
        : model_(task.prior),
          options_(task.options),
          rowOf_(distinctPairs(pairsOf(task.output)).rowOf),
          material_(*task.prior, rowOf_, task.mean, options_, task.someTexels),
          condition_(conditionOf(*task.prior, material_.terms())) {
        const double error = material_.leaveOneOutError();
        if (error <= kVisible) return;
        const std::vector<Rgb>& texels = task.someTexels.empty() ? task.mean : task.someTexels;
        const double neighbours =
            neighbourError(task.samples.directions, texels, material_.shownExposure());
        if (neighbours >= kBetter * error) return;
        fallback_ = makeInverseDistance(task);
        remark_ = fmt::format(
            "the samples contradict every model of the prior: they predict one another to {:.1f} "
            "Delta E, their nearest neighbours do so to {:.1f}; inverse distances are used instead",
            error, neighbours);
    }

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const override {
        if (fallback_) {
            const std::size_t count = model_->samples.size();
            const std::size_t texels = samples.size() / count;
            for (std::size_t t = 0; t < texels; ++t) {
                fallback_->reconstruct(samples.subspan(t * count, count),
                                       abrdfs.subspan(t * rowOf_.size(), rowOf_.size()));
            }
        } else if (options_.perTexel) {
            PriorMaterial(*model_, rowOf_, samples, options_).reconstruct(samples, abrdfs);
        } else {
            material_.reconstruct(samples, abrdfs);
        }
    }

    bool knowsError() const override { return !options_.perTexel; }

    void reconstructKnowing(std::span<const Rgb> samples, std::span<Rgb> abrdfs,
                            std::span<float> deltaE) const override {
        if (options_.perTexel) {
            Reconstructor::reconstructKnowing(samples, abrdfs, deltaE);
            return;
        }
        if (fallback_) {
            reconstruct(samples, abrdfs);
            const std::vector<float> errors =
                neighbourErrors(model_->samples, samples, options_.exposure);
            std::ranges::transform(errors, deltaE.begin(), [](float e) { return kUnlike * e; });
            return;
        }
        material_.model().evaluate(material_.encode(samples, deltaE), abrdfs);
    }

    const TexelModel* model() const override {
        return fallback_ || options_.perTexel ? nullptr : &material_.model();
    }
    TexelCodes encode(std::span<const Rgb> samples, std::span<float> deltaE) const override {
        return material_.encode(samples, deltaE);
    }
    double multiplyAddsOfRank(std::uint16_t rank) const override {
        return material_.multiplyAddsOfRank(rank);
    }

    std::size_t texelsAtOnce() const override { return options_.perTexel ? 1 : 32; }
    double multiplyAdds() const override {
        return fallback_ ? fallback_->multiplyAdds() : material_.multiplyAdds();
    }
    double condition() const override { return condition_; }
    std::string remark() const override { return remark_; }
    double modelBytes() const override { return material_.modelBytes(); }

  private:
    std::shared_ptr<const PriorModel> model_;
    ReconstructOptions options_;
    std::vector<std::size_t> rowOf_;
    PriorMaterial material_;
    double condition_;
    std::unique_ptr<Reconstructor> fallback_;  ///< Where the samples contradict every model.
    std::string remark_;
};

}  // namespace

std::unique_ptr<Reconstructor> makePrior(const ReconstructionTask& task) {
    const ReconstructOptions& options = task.options;
    const bool areNumbers = std::isfinite(options.noise) && options.noise >= 0 &&
                            std::isfinite(options.saturated) && options.saturated >= 0 &&
                            options.rank >= 0;
    if (!areNumbers) {
        throw std::invalid_argument(
            fmt::format("noise {}, saturated {} and rank {} of the prior must be numbers of at "
                        "least 0",
                        options.noise, options.saturated, options.rank));
    }
    if (!task.prior || task.prior->samples.size() != task.samples.count() ||
        task.prior->outputs.size() != distinctPairs(pairsOf(task.output)).distinct.size()) {
        throw std::invalid_argument(
            "the prior's model is of another plan or grid than the job's; train one for it");
    }
    return std::make_unique<Prior>(task);
}

}  // namespace abrdf
