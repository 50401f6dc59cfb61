// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/choose_samples.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/small_task.h"
#include "tests/fuzz/targets.h"
#include "tests/support/small_files.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

ReconstructOptions someOptions(FuzzBytes& bytes) {
    ReconstructOptions options;
    const int which = bytes.between(0, 31);
    if ((which & 1) != 0) options.exposure = bytes.number();
    if ((which & 2) != 0) options.noise = bytes.number();
    if ((which & 4) != 0) options.saturated = bytes.number();
    if ((which & 8) != 0) options.rank = bytes.any<std::int16_t>();
    options.centered = (which & 16) == 0;
    options.perTexel = bytes.between(0, 3) == 3;
    return options;
}

SlicePlan somePlan(FuzzBytes& bytes) {
    SlicePlan plan;
    plan.axialCount = bytes.between(0, 9);
    plan.diagonalCount = bytes.between(0, 9);
    const int which = bytes.between(0, 7);
    if ((which & 1) != 0) plan.alpha = bytes.number();
    if ((which & 2) != 0) {
        for (Radians& theta : plan.elevations) theta = bytes.angle(kPi / 2);
    }
    if ((which & 4) != 0) plan.elevations[0] = bytes.number();
    return plan;
}

/// Samples in a few regimes: any size at all, one value, codes of 8 bits.
std::vector<Rgb> someSamples(FuzzBytes& bytes, std::size_t count) {
    const int kind = bytes.between(0, 3);
    const float unit = kind == 0 ? 1.0F : bytes.light();
    std::vector<Rgb> samples(count);
    const auto value = [&] {
        if (kind == 0) return bytes.light();
        if (kind == 1) return unit;
        return unit * (static_cast<float>(bytes.any<std::uint8_t>()) / 255);
    };
    for (Rgb& c : samples) {
        for (float* channel : {&c.r, &c.g, &c.b}) *channel = value();
    }
    return samples;
}

void runMethod(const Method& method, std::span<const char> data) {
    FuzzBytes bytes(data);
    ReconstructionTask task = smallTask();
    task.options = someOptions(bytes);
    const bool otherGrid = bytes.between(0, 3) == 3;
    try {
        if (method.wish == SampleWish::kSlices) {
            task.plan = somePlan(bytes);
            checkPlan(task.plan);
            task.samples = exactSamples(task.plan.samples());
        } else if (method.wish == SampleWish::kEverything) {
            task.samples = chooseSamples({}, task.input, SampleWish::kEverything);
        }
        if (otherGrid && !method.needsPrior) {
            const Direction direction{bytes.angle(kPi / 2), bytes.angle(2 * kPi)};
            task.output = AngularGrid({direction, {0.5, 1}});
        }
        const auto texels = static_cast<std::size_t>(bytes.between(1, 3));
        const std::vector<Rgb> samples = someSamples(bytes, texels * task.samples.count());
        task.mean.assign(samples.begin(),
                         samples.begin() + static_cast<std::ptrdiff_t>(task.samples.count()));
        if (texels > 1) task.someTexels = samples;
        const auto reconstructor = method.make(task);
        reconstructAndCheck(*reconstructor, task.output, samples, texels);
    } catch (const std::invalid_argument&) {
    }
}

void runPrior(std::span<const char> bytes) {
    runMethod(methodFromName("prior"), bytes);
}

/// All the others: the first byte says which.
void runReconstruct(std::span<const char> bytes) {
    if (bytes.empty()) return;
    constexpr std::array kNames = {"published", "microfacet", "measured", "rbf",
                                   "idw",       "nearest",    "constant"};
    const auto choice = static_cast<unsigned char>(bytes[0]) % kNames.size();
    runMethod(methodFromName(kNames[choice]), bytes.subspan(1));
}

/// Plain options, then samples of every regime; last, every option.
std::vector<std::string> priorSeeds() {
    std::vector<std::string> seeds;
    for (int kind = 0; kind < 4; ++kind) {
        ByteWriter seed;
        for (const int byte : {0, 0, 0, kind & 1, kind}) seed.put(static_cast<std::uint8_t>(byte));
        if (kind > 0) seed.put(1.0F);
        for (int i = 0; i < 72; ++i) {
            if (kind == 0) seed.put(0.1F + 0.01F * static_cast<float>(i % 12));
            if (kind > 1) seed.put(static_cast<std::uint8_t>(40 + 5 * (i % 36)));
        }
        seeds.push_back(seed.bytes());
    }
    ByteWriter options;
    options.put(std::uint8_t{15}).put(2.0F).put(0.01F).put(0.99F).put(std::int16_t{4});
    for (const int byte : {3, 0, 1, 2}) options.put(static_cast<std::uint8_t>(byte));
    options.put(1.0F);
    for (int i = 0; i < 72; ++i) options.put(static_cast<std::uint8_t>(60 + 11 * i));
    seeds.push_back(options.bytes());
    return seeds;
}

std::vector<std::string> reconstructSeeds() {
    std::vector<std::string> seeds;
    const std::vector<std::string> samples = priorSeeds();
    for (int method = 0; method < 7; ++method) {
        for (const std::string& seed : {samples[0], samples[2]}) {
            // `published` takes its plan between options and samples.
            const std::string plan = method == 0 ? std::string("\4\5\0", 3) : "";
            seeds.push_back(static_cast<char>(method) + seed.substr(0, 3) + plan + seed.substr(3));
        }
    }
    return seeds;
}

constexpr std::array kTargets{
    FuzzTarget{"prior", runPrior, priorSeeds},
    FuzzTarget{"reconstruct", runReconstruct, reconstructSeeds},
};

}  // namespace

std::span<const FuzzTarget> methodTargets() {
    return kTargets;
}

}  // namespace abrdf
