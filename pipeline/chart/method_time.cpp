// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/method_time.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/stopwatch.h"

#include <algorithm>
#include <vector>

namespace abrdf {

namespace {

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

MethodTime timeMethod(const Reconstructor& reconstructor, std::span<const Rgb> samples,
                      std::size_t pairs, double seconds) {
    const std::size_t block = reconstructor.texelsAtOnce();
    // A few blocks a thread: what a core does alone must fit many times into a turn of all.
    const std::size_t blocks = 2 * static_cast<std::size_t>(availableThreads());
    std::vector<Rgb> inputs;
    for (std::size_t t = 0; t < block; ++t) {
        inputs.insert(inputs.end(), samples.begin(), samples.end());
    }
    std::vector<Rgb> outputs(blocks * block * pairs);
    const auto reconstructBlock = [&](std::size_t b) {
        reconstructor.reconstruct(inputs,
                                  std::span(outputs).subspan(b * block * pairs, block * pairs));
    };
    const auto microsecondsOf = [](const auto& work, std::size_t texels) {
        const Stopwatch time;
        work();
        return 1e6 * time.seconds() / static_cast<double>(texels);
    };
    const auto onOne = [&] { reconstructBlock(0); };
    const auto onAll = [&] { forEachImage(blocks, reconstructBlock); };
    onAll();  // Warm.
    std::vector<double> one;
    std::vector<double> all;
    const Stopwatch time;
    constexpr std::size_t kLeast = 3;
    constexpr std::size_t kMost = 500;
    while (one.size() < kLeast || (one.size() < kMost && time.seconds() < seconds)) {
        one.push_back(microsecondsOf(onOne, block));
        all.push_back(microsecondsOf(onAll, blocks * block));
    }
    return {medianOf(one), medianOf(all)};
}

}  // namespace abrdf
