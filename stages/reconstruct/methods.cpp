// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/reconstructor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

// A new method is one file in this folder and one line in each of these two lists.
std::unique_ptr<Reconstructor> makePrior(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makePublished(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makeRadialBasis(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makeInverseDistance(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makeMicrofacet(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makeNearest(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makeConstant(const ReconstructionTask& task);
std::unique_ptr<Reconstructor> makeMeasured(const ReconstructionTask& task);

// Of those that solve linear systems, the same in longer floats: `<method>_twin.cpp`.
TwinAnswer priorTwin(const ReconstructionTask& task);
TwinAnswer publishedTwin(const ReconstructionTask& task);
TwinAnswer radialBasisTwin(const ReconstructionTask& task);
TwinAnswer microfacetTwin(const ReconstructionTask& task);

namespace {

constexpr std::array kMethods{
    Method{"measured", "no reconstruction: every image is read; the reference of all comparisons",
           "a table look-up a pair", SampleWish::kEverything, false, makeMeasured},
    Method{
        "prior",
        "what random materials with these samples show elsewhere, chosen by the samples themselves",
        "four to six multiply-adds a pair and sample", SampleWish::kMeasuredPairs, true, makePrior,
        priorTwin},
    Method{"published", "the poster's method: eight slices, sums of two, radial basis functions",
           "six multiply-adds a pair", SampleWish::kSlices, false, makePublished, publishedTwin},
    Method{"rbf", "radial basis functions over all samples, linear in the distance of directions",
           "three multiply-adds a pair and sample", SampleWish::kMeasuredPairs, false,
           makeRadialBasis, radialBasisTwin},
    Method{"idw", "the four nearest samples by inverse squared distance: renderers of BTFs today",
           "twelve multiply-adds a pair", SampleWish::kMeasuredPairs, false, makeInverseDistance},
    Method{"microfacet", "a diffuse body and an anisotropic GGX lobe, fitted to each texel",
           "some milliseconds a texel", SampleWish::kMeasuredPairs, false, makeMicrofacet,
           microfacetTwin},
    Method{"nearest", "the sample nearest in both directions", "a table look-up a pair",
           SampleWish::kMeasuredPairs, false, makeNearest},
    Method{"constant", "Lambert's law: one colour times cos(theta_i)", "three multiply-adds a pair",
           SampleWish::kMeasuredPairs, false, makeConstant},
};

}  // namespace

std::span<const Method> methods() {
    return kMethods;
}

const Method& methodFromName(const std::string& name) {
    const auto found =
        std::ranges::find_if(kMethods, [&](const Method& method) { return method.name == name; });
    if (found != kMethods.end()) return *found;
    std::string names;
    for (const Method& method : kMethods) names += fmt::format(" {}", method.name);
    throw std::invalid_argument(
        fmt::format("there is no method '{}'; the methods are:{}", name, names));
}

}  // namespace abrdf
