// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/prior_model.h"
#include "abrdf/real_light.h"
#include "abrdf/sample_set.h"
#include "abrdf/slice_plan.h"
#include "abrdf/texel_model.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// Numbers that methods may heed.
struct ReconstructOptions {
    double exposure = 1;   ///< Factor on the values at which errors are weighed, > 0.
    double noise = 0;      ///< Relative deviation of the samples' noise; larger trusts them less.
    double saturated = 0;  ///< Samples with a channel at or above it are clipped; 0: none are.
    int rank = 0;          ///< Of `prior`'s maps, 1 .. samples; 0 is full.
    /// Maps of low rank are exact for the material's mean: right for many texels that are alike,
    /// and no saving for one.
    bool centered = true;
    /// Mean CIE 1976 Delta E that is good enough: each texel takes the smallest model whose
    /// estimated error is within it. 0: the whole model.
    double tolerance = 0;
    /// The mean is the only texel: no other may be asked for, and no maps for others are made. For
    /// whole models of a fixed rank.
    bool alone = false;
    bool perTexel = false;  ///< Choose the model anew for each texel: slow, and a little better.
    /// How much each output pair matters, their sum is 1; empty: all alike. Ranks and estimated
    /// errors are meant so.
    std::vector<double> weights = {};
};

/// What a method is built from.
struct ReconstructionTask {
    SlicePlan plan;
    SampleSet samples;           ///< In the form the method wished for, of this plan.
    AngularGrid input;           ///< The database's grid.
    AngularGrid output;          ///< The atlas's grid.
    std::vector<Rgb> mean = {};  ///< Of the material's samples over all its texels.
    /// Samples of texels spread over the material, one after the other, to choose models by; none
    /// where the mean is all there is.
    std::vector<Rgb> someTexels = {};
    std::shared_ptr<const PriorModel> prior = {};  ///< For methods that need it: of these samples.
    ReconstructOptions options = {};
};

/// Fills in the pairs that were not measured. Built once a job, then used from any thread.
class Reconstructor {
  public:
    virtual ~Reconstructor() = default;

    /// samples: values of one texel after the other, at most texelsAtOnce(), each in the order of
    /// the task's samples, finite, not negative; abrdfs: one value for each pair of the output
    /// grid, texel after texel. May leave negative values. What a texel becomes does not depend on
    /// its neighbours.
    virtual void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const = 0;

    /// Does it know how far its results may be from the truth?
    virtual bool knowsError() const { return false; }

    /// reconstruct(), to the same bits, and of each texel a bound of the mean CIE 1976 Delta E of
    /// its ABRDF at the options' exposure; NaN where there is none. deltaE: one number a texel.
    virtual void reconstructKnowing(std::span<const Rgb> samples, std::span<Rgb> abrdfs,
                                    std::span<float> deltaE) const;

    /// What its texels have in common, where they can be kept as few numbers; else null.
    virtual const TexelModel* model() const { return nullptr; }

    /// Texels as numbers of model(), which makes of them what reconstruct() does. deltaE: as
    /// reconstructKnowing(), or empty.
    virtual TexelCodes encode(std::span<const Rgb> /*samples*/, std::span<float> /*deltaE*/) const {
        return {};
    }

    /// Multiply-adds of a texel of model() of this rank, with what it takes to choose it.
    virtual double multiplyAddsOfRank(std::uint16_t /*rank*/) const { return multiplyAdds(); }

    /// How many texels are best done together.
    virtual std::size_t texelsAtOnce() const { return 1; }

    /// Multiply-adds a texel, all three channels.
    virtual double multiplyAdds() const = 0;

    /// Bytes of what a texel's ABRDF is made from, in floats; what all texels share is not counted.
    virtual double modelBytes() const = 0;

    /// Largest condition number (2-norm, or 1-norm's estimate) of the linear systems that were
    /// solved for it; 1 where there are none.
    virtual double condition() const { return 1; }

    /// A sentence that a user should know of this material; empty where there is nothing to say.
    virtual std::string remark() const { return {}; }
};

/// What a method's equations give of one texel in other floats and solved another way: what shows
/// how much of an answer is rounding.
struct TwinAnswer {
    std::vector<std::array<double, 3>> abrdf;  ///< A value an output pair; may be negative.
    /// Largest condition number (2-norm, or 1-norm's estimate) of its systems.
    double condition = 1;
};

/// A reconstruction method: one file in this folder.
struct Method {
    const char* name;
    const char* description;  ///< One line for --list-methods.
    const char* cost;         ///< In words, for --list-methods.
    SampleWish wish;
    bool needsPrior;  ///< Does its task need a prior model?
    std::unique_ptr<Reconstructor> (*make)(const ReconstructionTask& task);
    /// Slow; of the texel task.mean. Null for methods that solve no system.
    TwinAnswer (*twin)(const ReconstructionTask& task) = nullptr;
};

/// All methods, the most accurate first.
std::span<const Method> methods();

/// Throws std::invalid_argument for an unknown name, listing the known ones.
const Method& methodFromName(const std::string& name);

/// The stage for `texels` texels, at most reconstructor.texelsAtOnce(), where it is called. No
/// negative, infinite or NaN value leaves it, and none above kMostOfSamples times the texel's
/// largest sample. estimates: where not empty, what reconstructKnowing() says of each texel.
UnrealCounts reconstructBlock(std::span<const Rgb> samples, std::size_t texels,
                              const Reconstructor& reconstructor, std::span<Rgb> abrdfs,
                              std::span<float> estimates = {});

struct ReconstructedTexels {
    AbrdfTile abrdfs;
    UnrealCounts unreal;
    std::vector<float> estimates = {};  ///< Delta E a texel; none where the method knows none.
};

/// The stage for every texel of a tile, in parallel.
ReconstructedTexels reconstructTexels(const AbrdfTile& samples, const AngularGrid& output,
                                      const Reconstructor& reconstructor);

}  // namespace abrdf
