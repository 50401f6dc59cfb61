// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/job.h"

#include "abrdf/content_hash.h"
#include "abrdf/flow.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/mean_color.h"
#include "stages/average/average_image.h"
#include "stages/slice/choose_samples.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace abrdf {

namespace {

/// Throws where images that the job needs are absent.
[[noreturn]] void failMissing(const std::vector<std::size_t>& missing, const OpenedInput& input) {
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(5, missing.size()); ++i) {
        names += fmt::format("{}{}", i > 0 ? ", " : "",
                             pairName(input.description().grid.pair(missing[i])));
    }
    throw std::runtime_error(fmt::format(
        "{}: {} of the images that this job needs {} missing ({}{}); --missing fill would "
        "interpolate them from their neighbours and count them",
        input.description().source, missing.size(), missing.size() == 1 ? "is" : "are", names,
        missing.size() > 5 ? " ..." : ""));
}

/// The slices can be interpolated between measured elevations only.
void checkElevations(const SlicePlan& plan, const OpenedInput& input) {
    const auto check = [&](const std::vector<Direction>& directions, const char* what) {
        Radians least = directions.front().theta;
        Radians greatest = least;
        for (const Direction& d : directions) {
            least = std::min(least, d.theta);
            greatest = std::max(greatest, d.theta);
        }
        for (const Radians theta : plan.elevations) {
            constexpr Radians kRounding = radiansFromDegrees(0.1);
            if (theta >= least - kRounding && theta <= greatest + kRounding) continue;
            throw std::runtime_error(fmt::format(
                "{}: the plan's elevation of {:g} degrees lies outside the measured {} directions, "
                "whose theta goes from {:g} to {:g} degrees; choose others with --elevations, or "
                "--method measured",
                input.description().source, degreesFromRadians(theta), what,
                degreesFromRadians(least), degreesFromRadians(greatest)));
        }
    };
    check(input.description().grid.lights(), "light");
    check(input.description().grid.views(), "view");
}

struct AveragedImage {
    std::uint64_t leftOut = 0;  ///< As averageImage().
    std::uint64_t outside = 0;  ///< As shiftImage().
};

/// Linear texels of an image that is shifted at its own resolution first.
AveragedImage averageShifted(const EncodedImage& image, const Linearizer& linearizer, Shift shift,
                             Edges edges, Texels texels, std::span<Rgb> result) {
    if (shift.x == 0 && shift.y == 0) {
        return {averageImage(image, linearizer, texels.width, texels.height, result), 0};
    }
    std::vector<Rgb> pixels(static_cast<std::size_t>(image.width) *
                            static_cast<std::size_t>(image.height));
    std::vector<Rgb> shifted(pixels.size());
    AveragedImage averaged;
    averaged.leftOut = averageImage(image, linearizer, image.width, image.height, pixels);
    averaged.outside = shiftImage(pixels, image.width, image.height, shift, edges, shifted);
    averageColors(shifted, image.width, image.height, texels.width, texels.height, result);
    return averaged;
}

/// A sample of a table as an image of one texel: NaN where it is no light.
std::uint64_t evaluateTable(const BrdfTable& table, const LightAndView& direction,
                            const ColorTransform& toSceneLinear, std::span<Rgb> texel) {
    texel[0] = table.evaluate(direction);
    if (isFinite(texel[0]) && !isNegative(texel[0])) {
        toSceneLinear.apply(texel);
        return 0;
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    texel[0] = {kNaN, kNaN, kNaN};
    return 1;
}

/// More do not change a choice.
constexpr std::size_t kSomeTexels = 64;

/// Places of texels that are spread over an image, row by row; none where it has only one.
std::vector<std::size_t> someTexels(Texels texels) {
    std::vector<std::size_t> places;
    if (texels.count() == 1) return places;
    // The additive sequence of the plastic number: as many as there are, evenly spread, in step
    // with no weave.
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    const auto place = [](std::size_t i, double step, int count) {
        const double share = 0.5 + static_cast<double>(i) * step;
        return static_cast<std::size_t>((share - std::floor(share)) * count);
    };
    for (std::size_t i = 0; i < std::min(kSomeTexels, texels.count()); ++i) {
        places.push_back(place(i, kStepY, texels.height) * static_cast<std::size_t>(texels.width) +
                         place(i, kStepX, texels.width));
    }
    return places;
}

template <typename T>
std::span<const char> bytesOf(std::span<const T> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

Texels texelsFromName(const std::string& name) {
    if (name == "full") return {0, 0};
    Texels texels{0, 0};
    const char* end = name.data() + name.size();
    const auto [by, error] = std::from_chars(name.data(), end, texels.width);
    if (error == std::errc() && by != end && *by == 'x') {
        const auto [rest, heightError] = std::from_chars(by + 1, end, texels.height);
        if (heightError == std::errc() && rest == end && texels.width > 0 && texels.height > 0) {
            return texels;
        }
    }
    throw std::invalid_argument(fmt::format(
        "the texels '{}' are not understood: write WxH, as 1x1 or 64x64, or full", name));
}

OpenedInput openInput(const InputOptions& options) {
    OpenedInput input;
    input.missing = options.missing;
    input.warn = options.warn;
    callBoth([&] { input.reader = openBtf(options.input, options.read); },
             [&] { input.colors = ColorConfig::load(options.colorConfig); });
    const BtfDescription& description = input.description();
    if (!description.duplicates.empty()) {
        throw std::runtime_error(fmt::format(
            "{}: {} pairs of directions have two images, so that it is not clear which counts; the "
            "first: {}; remove one of each",
            options.input.string(), description.duplicates.size(), description.duplicates[0]));
    }
    input.inputSpace = input.colors.spaceName(options.inputSpace.empty() ? description.colorSpace
                                                                         : options.inputSpace);
    return input;
}

bool OpenedInput::hasCodes() const {
    return reader->table() == nullptr && description().colorSpace == "sRGB - Texture";
}

Texels resolvedTexels(Texels texels, const BtfDescription& description) {
    if (texels.width == 0) return {description.width, description.height};
    if (texels.width > description.width || texels.height > description.height) {
        throw std::invalid_argument(
            fmt::format("{} x {} texels are more than the images' {} x {} pixels", texels.width,
                        texels.height, description.width, description.height));
    }
    return texels;
}

const AngularGrid& sampledGrid(const Method& method, const OpenedInput& input,
                               const AngularGrid& output) {
    const bool anywhere = input.reader->table() != nullptr;
    return anywhere && method.wish == SampleWish::kEverything ? output : input.description().grid;
}

SampleSet samplesFor(const Method& method, const SamplePlan& plan, const OpenedInput& input,
                     const AngularGrid& output) {
    if (input.reader->table() != nullptr) {
        switch (method.wish) {
            case SampleWish::kEverything:
                return exactSamples(pairsOf(output));
            case SampleWish::kSlices:
                return exactSamples(plan.posterSlices->samples());
            case SampleWish::kMeasuredPairs:
                return exactSamples(plan.samples);
        }
    }
    const BtfDescription& description = input.description();
    if (method.wish == SampleWish::kSlices) checkElevations(*plan.posterSlices, input);
    // Another grid than the database's may not need all of it.
    SampleSet samples =
        method.wish == SampleWish::kEverything && output != description.grid
            ? samplesOfPairs(description.grid, PairInterpolation(description.grid).pairsFor(output))
            : chooseSamples(plan, description.grid, method.wish);
    const std::vector<std::size_t> missing = missingPairs(samples, description.present);
    if (missing.empty()) return samples;
    if (input.missing == MissingImages::kError) failMissing(missing, input);
    // Methods that take any set of pairs do without the missing ones.
    return method.wish == SampleWish::kMeasuredPairs
               ? dropMissing(std::move(samples), description.present)
               : fillMissing(std::move(samples), description.grid, description.present);
}

ReadFacts readImages(const OpenedInput& input, const SampleSet& samples, Texels texels,
                     const Plane& plane, std::size_t atOnce, const ImageSink& sink,
                     const ProgressSink& progress) {
    const ColorTransform toSceneLinear = input.colors.transform(input.inputSpace, "scene_linear");
    const BrdfTable* table = input.reader->table();
    const Linearizer linearizer(toSceneLinear);
    const std::vector<std::size_t>& pairs = samples.pairs;
    const std::vector<std::size_t> some = someTexels(texels);
    ReadFacts facts;
    facts.means.resize(pairs.size());
    facts.someTexels.resize(pairs.size() * some.size());
    std::vector<std::uint64_t> hashes(pairs.size());
    std::vector<std::vector<Rgb>> buffers(atOnce);
    std::atomic<std::uint64_t> leftOut = 0;
    std::atomic<std::uint64_t> outside = 0;
    std::atomic<std::size_t> done = 0;
    const auto readInto = [&](std::size_t i, std::span<Rgb> image) {
        if (table != nullptr) {
            leftOut += evaluateTable(*table, samples.directions[i], toSceneLinear, image);
            return;
        }
        const Shift shift = parallax(plane.height, input.description().grid.pair(pairs[i]).view);
        const AveragedImage averaged = averageShifted(input.reader->read(pairs[i]), linearizer,
                                                      shift, plane.edges, texels, image);
        leftOut += averaged.leftOut;
        outside += averaged.outside;
        if (progress) progress({"read", "images", ++done, pairs.size()});
    };
    const auto read = [&](std::size_t i, std::size_t slot) {
        std::vector<Rgb>& image = buffers[slot];
        image.resize(texels.count());
        readInto(i, image);
        facts.means[i] = meanOfFinite(image);
        for (std::size_t t = 0; t < some.size(); ++t) {
            facts.someTexels[i * some.size() + t] = image[some[t]];
        }
        hashes[i] = contentHash(bytesOf(std::span<const Rgb>(image)));
        sink(i, image);
    };
    runFlow({pairs.size(), atOnce, {}, read, {}});
    facts.leftOut = leftOut;
    facts.outside = outside;
    facts.hash = contentHash(bytesOf(std::span<const std::uint64_t>(hashes)));
    return facts;
}

ReadStack readStack(const OpenedInput& input, const SampleSet& samples, Texels texels,
                    const Plane& plane, const ProgressSink& progress) {
    if (input.reader->table() != nullptr) texels = {1, 1};
    ReadStack result{ImageStack(samples.pairs, texels.width, texels.height), {}};
    result.facts = readImages(
        input, samples, texels, plane, 2 * static_cast<std::size_t>(threadsInUse()),
        [&](std::size_t i, std::span<const Rgb> image) {
            std::ranges::copy(image, result.stack.image(i).begin());
        },
        progress);
    return result;
}

std::string pairName(const LightAndView& pair) {
    const auto key = [](Radians angle) {
        const double degrees = std::round(degreesFromRadians(angle) * 1e4) / 1e4;
        return degrees == std::round(degrees) ? fmt::format("{:03.0f}", degrees)
                                              : fmt::format("{}", degrees);
    };
    return fmt::format("tl{} pl{} tv{} pv{}", key(pair.light.theta), key(pair.light.phi),
                       key(pair.view.theta), key(pair.view.phi));
}

std::uint64_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t residentMemory() {
    std::ifstream stream("/proc/self/statm");
    std::uint64_t pages = 0;
    stream >> pages >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace abrdf
