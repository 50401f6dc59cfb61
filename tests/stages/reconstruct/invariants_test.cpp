// SPDX-License-Identifier: BSD-3-Clause
//
// What holds for every method whatever it is given: bounds, units, orders, black, Lambert.
#include "abrdf/pair_features.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/reconstructor.h"
#include "stages/slice/choose_samples.h"
#include "stages/stress/stress_material.h"
#include "stages/train/random_material.h"
#include "stages/train/train_prior.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace abrdf;

namespace {

struct Subject {
    const Method* method;
    ReconstructionTask task;
};

/// Every method on the grid of the small prior.
std::vector<Subject> subjects() {
    std::vector<Subject> all;
    for (const Method& method : methods()) {
        if (method.wish == SampleWish::kEverything) continue;
        Subject subject{&method, {}};
        subject.task.input = subject.task.output = smallPrior().grid;
        subject.task.samples = method.wish == SampleWish::kSlices
                                   ? exactSamples(subject.task.plan.samples())
                                   : smallPrior().samples;
        if (method.needsPrior) subject.task.prior = smallPrior().model;
        all.push_back(std::move(subject));
    }
    return all;
}

std::vector<Rgb> answer(const Subject& subject, const std::vector<Rgb>& samples) {
    ReconstructionTask task = subject.task;
    task.mean = samples;
    AbrdfTile tile(1, samples.size());
    std::ranges::copy(samples, tile[0].begin());
    const auto reconstructor = subject.method->make(task);
    const ReconstructedTexels made = reconstructTexels(tile, task.output, *reconstructor);
    return {made.abrdfs[0].begin(), made.abrdfs[0].end()};
}

std::vector<Rgb> samplesOf(const Subject& subject,
                           const std::function<Rgb(const LightAndView&)>& material) {
    std::vector<Rgb> values;
    for (const LightAndView& pair : subject.task.samples.directions) {
        values.push_back(material(pair));
    }
    return values;
}

float largestChannel(const std::vector<Rgb>& values) {
    float largest = 0;
    for (const Rgb& c : values) largest = std::max({largest, c.r, c.g, c.b});
    return largest;
}

/// Samples as bad as they come: of a random material, anything, spikes, zeros, any unit.
std::vector<Rgb> randomSamples(const Subject& subject, Random& random) {
    std::vector<Rgb> samples;
    const std::size_t kind = random.below(4);
    if (kind < 2) {
        const MaterialClass c = kMaterialClasses[random.below(kMaterialClasses.size())];
        const StressMaterial material = analyticStressMaterial(
            "random", {{randomMaterial(c, random), {1, 0.5F, 0.2F}},
                       {randomMaterial(MaterialClass::kIso, random), {0.1F, 0.5F, 1}}});
        samples = samplesOf(subject, material.value);
    } else {
        const auto value = [&] {
            return static_cast<float>(kind == 2 ? random.uniform() : random.logUniform(1e-6, 1e3));
        };
        for (std::size_t k = 0; k < subject.task.samples.count(); ++k) {
            samples.push_back({value(), value(), value()});
        }
    }
    const auto unit = static_cast<float>(random.logUniform(1e-4, 1e4));
    const double zeros = random.chance(0.3) ? random.uniform() : 0;
    const double spikes = random.chance(0.3) ? 0.05 : 0;
    for (Rgb& c : samples) {
        c *= unit;
        if (random.chance(zeros)) c = {};
        if (random.chance(spikes)) c *= 1000;
    }
    return samples;
}

/// Answers to `count` random inputs are lights, and no brighter than four times the samples.
void checkBounds(int count, std::uint64_t seed) {
    const std::vector<Subject> all = subjects();
    for (int i = 0; i < count; ++i) {
        Random random(seed, static_cast<std::uint64_t>(i));
        const Subject& subject = all[static_cast<std::size_t>(i) % all.size()];
        const std::string where = std::string(subject.method->name) + ", seed " +
                                  std::to_string(seed) + ", case " + std::to_string(i);
        CAPTURE(where);
        const std::vector<Rgb> samples = randomSamples(subject, random);
        const std::vector<Rgb> abrdf = answer(subject, samples);
        CHECK(std::ranges::all_of(
            abrdf, [](const Rgb& c) { return isFinite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0; }));
        CHECK(largestChannel(abrdf) <= 4.0001F * largestChannel(samples));
    }
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("500 random inputs: every answer is light, and bounded by its samples") {
    checkBounds(500, 1);
}

TEST_CASE("a Lambertian comes back from every method that knows of cosines") {
    for (const Subject& subject : subjects()) {
        const std::string name = subject.method->name;
        CAPTURE(name);
        for (const Rgb color : {Rgb{1, 1, 1}, Rgb{0.5F, 0.02F, 0.2F}}) {
            const auto lambert = analyticStressMaterial("lambert", {lambertPart(color)}).value;
            const double error =
                measureAccuracy(smallPrior().abrdfOf(lambert),
                                answer(subject, samplesOf(subject, lambert)), {}, {})
                    .natural.deltaE;
            // The published rule interpolates the cosine between two elevations as it does all
            // else.
            CHECK(error < (name == "published" ? 3 : 0.1));
        }
    }
}

TEST_CASE("a Lambertian comes back whatever the grid and the samples are") {
    const auto lambert =
        analyticStressMaterial("lambert", {lambertPart({0.5F, 0.02F, 0.2F})}).value;
    const auto valuesAt = [&](const std::vector<LightAndView>& pairs) {
        std::vector<Rgb> values;
        for (const LightAndView& pair : pairs) values.push_back(lambert(pair));
        return values;
    };
    Random random(5);
    for (const char* gridName : {"ubo81", "dome151", "regular:5x8", "regular:4x13"}) {
        const AngularGrid grid = gridFromName(gridName);
        for (const std::size_t count : {std::size_t{8}, std::size_t{25}, std::size_t{150}}) {
            std::vector<LightAndView> directions;
            while (directions.size() < count) {
                const LightAndView pair = grid.pair(random.below(grid.pairCount()));
                // At the pole many azimuths are one direction.
                if (pair.light.theta == 0 || pair.view.theta == 0) continue;
                if (std::ranges::count(directions, pair) == 0) directions.push_back(pair);
            }
            ReconstructionTask task;
            task.input = task.output = grid;
            task.samples = exactSamples(directions);
            task.prior = std::make_shared<const PriorModel>(
                trainPrior(directions, distinctPairs(pairsOf(grid)).distinct, {30, 1}, {}));
            for (const Method& method : methods()) {
                if (method.wish != SampleWish::kMeasuredPairs) continue;
                const std::string what = fmt::format("{} on {}, {}", method.name, gridName, count);
                CAPTURE(what);
                const Subject subject{&method, task};
                const auto found = answer(subject, valuesAt(directions));
                const auto accuracy = measureAccuracy(valuesAt(pairsOf(grid)), found, {}, {});
                CHECK(accuracy.natural.deltaE < 0.1);
            }
        }
    }
}

TEST_CASE("the unit of the samples is that of every answer") {
    for (const Subject& subject : subjects()) {
        const std::string name = subject.method->name;
        CAPTURE(name);
        const std::vector<Rgb> samples = samplesOf(subject, plastic);
        const std::vector<Rgb> once = answer(subject, samples);
        const float largest = largestChannel(once);
        for (const float unit : {1e-4F, 1e4F}) {
            std::vector<Rgb> scaled = samples;
            for (Rgb& c : scaled) c *= unit;
            const std::vector<Rgb> abrdf = answer(subject, scaled);
            float off = 0;
            for (std::size_t i = 0; i < once.size(); ++i) {
                off = std::max(off, std::abs(abrdf[i].g / unit - once[i].g));
            }
            CHECK(off <= 1e-4F * largest);
        }
    }
}

TEST_CASE("the order of the samples does not matter") {
    for (Subject subject : subjects()) {
        const std::string name = subject.method->name;
        if (subject.method->wish == SampleWish::kSlices) continue;  // Its samples are places.
        CAPTURE(name);
        const std::vector<Rgb> samples = samplesOf(subject, plastic);
        const std::vector<Rgb> once = answer(subject, samples);
        std::vector<std::size_t> order(samples.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = (k * 7 + 3) % order.size();
        Subject permuted = subject;
        std::vector<LightAndView> directions;
        std::vector<Rgb> values;
        for (const std::size_t k : order) {
            directions.push_back(subject.task.samples.directions[k]);
            values.push_back(samples[k]);
        }
        permuted.task.samples = exactSamples(directions);
        if (subject.method->needsPrior) {
            permuted.task.prior =
                std::make_shared<const PriorModel>(withSamples(*subject.task.prior, order));
        }
        const std::vector<Rgb> again = answer(permuted, values);
        float off = 0;
        for (std::size_t i = 0; i < once.size(); ++i) {
            off = std::max(off, std::abs(again[i].g - once[i].g));
        }
        CHECK(off <= 1e-4F * largestChannel(once));
    }
}

TEST_CASE("a material turned by a step of its grid is answered turned") {
    // Samples that are all turns of some pairs, on a ring of eight azimuths.
    const AngularGrid& grid = smallPrior().grid;
    constexpr Radians kStep = kPi / 4;
    std::vector<LightAndView> directions;
    for (std::size_t pair = 1; pair < grid.pairCount(); pair += 61) {
        for (int k = 0; k < 8; ++k) {
            const LightAndView p = grid.pair(pair);
            directions.push_back({{p.light.theta, wrappedAzimuth(p.light.phi + k * kStep)},
                                  {p.view.theta, wrappedAzimuth(p.view.phi + k * kStep)}});
        }
    }
    const StressMaterial satin = stressMaterials()[2];
    const StressMaterial satinTurned = turned(satin, kStep);
    for (const std::string name : {"constant", "nearest", "idw", "rbf", "microfacet"}) {
        CAPTURE(name);
        Subject subject{&methodFromName(name), {}};
        subject.task.input = subject.task.output = grid;
        subject.task.samples = exactSamples(directions);
        const std::vector<Rgb> once = answer(subject, samplesOf(subject, satin.value));
        const std::vector<Rgb> after = answer(subject, samplesOf(subject, satinTurned.value));
        double off = 0;
        for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
            LightAndView back = grid.pair(pair);
            back.light.phi = wrappedAzimuth(back.light.phi - kStep);
            back.view.phi = wrappedAzimuth(back.view.phi - kStep);
            const std::size_t from = grid.pairIndex(nearestDirection(grid.lights(), back.light),
                                                    nearestDirection(grid.views(), back.view));
            off = std::max(off, static_cast<double>(std::abs(after[pair].g - once[from].g)));
        }
        CHECK(off <= 2e-3 * static_cast<double>(largestChannel(once)));
    }
}

TEST_CASE("black is black, and a channel of zeros stays zero, for every method") {
    for (const Subject& subject : subjects()) {
        const std::string name = subject.method->name;
        CAPTURE(name);
        const std::vector<Rgb> black(subject.task.samples.count());
        CHECK(largestChannel(answer(subject, black)) == 0);
        std::vector<Rgb> noGreen = samplesOf(subject, plastic);
        for (Rgb& c : noGreen) c.g = 0;
        for (const Rgb& c : answer(subject, noGreen)) CHECK(c.g == 0);
    }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow");

TEST_CASE("10,000 random inputs: every answer is light, and bounded by its samples") {
    checkBounds(10000, 2);
}

TEST_SUITE_END();
