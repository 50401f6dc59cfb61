// SPDX-License-Identifier: BSD-3-Clause
//
// The reconstruction stage alone, with `published` and the poster's 204 samples: time a texel,
// how it grows with the texels, and what a second thread brings.
#include "abrdf/angular_grid.h"
#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/reconstructor.h"
#include "stages/slice/choose_samples.h"

#include <benchmark/benchmark.h>

#include <random>

namespace {

using abrdf::AbrdfTile;
using abrdf::AngularGrid;
using abrdf::Rgb;

const AngularGrid& grid() {
    static const AngularGrid kGrid(abrdf::ubo81Directions());
    return kGrid;
}

const abrdf::Reconstructor& published() {
    static const std::unique_ptr<abrdf::Reconstructor> kPublished = [] {
        const abrdf::Method& method = abrdf::methodFromName("published");
        const abrdf::SlicePlan plan;
        return method.make({plan,
                            abrdf::chooseSamples(abrdf::posterPlan(plan), grid(), method.wish),
                            grid(), grid()});
    }();
    return *kPublished;
}

AbrdfTile samplesOf(std::size_t texels) {
    AbrdfTile samples(texels, abrdf::SlicePlan().samples().size());
    std::mt19937 random(1);
    std::uniform_real_distribution<float> light(0.05F, 0.5F);
    for (Rgb& value : samples.values()) value = {light(random), light(random), light(random)};
    return samples;
}

/// The method alone: one texel, one thread, memory that is there already.
void oneTexel(benchmark::State& state) {
    const AbrdfTile samples = samplesOf(1);
    std::vector<Rgb> abrdf(grid().pairCount());
    for (auto _ : state) {
        published().reconstruct(samples[0], abrdf);
        benchmark::DoNotOptimize(abrdf.data());
        benchmark::ClobberMemory();
    }
    state.counters["multiply-adds"] = published().multiplyAdds();
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(oneTexel)->Unit(benchmark::kMicrosecond)->Repetitions(5)->ReportAggregatesOnly();

/// The stage as convert() calls it, in tiles of 20 MB, memory of the result included: texels,
/// threads.
void stage(benchmark::State& state) {
    constexpr std::int64_t kTile = 256;
    const abrdf::ThreadLimit limit(static_cast<int>(state.range(1)));
    const AbrdfTile samples = samplesOf(static_cast<std::size_t>(std::min(kTile, state.range(0))));
    for (auto _ : state) {
        for (std::int64_t texel = 0; texel < state.range(0); texel += kTile) {
            auto result = abrdf::reconstructTexels(samples, grid(), published());
            benchmark::DoNotOptimize(result);
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * state.range(0));
}
BENCHMARK(stage)
    ->ArgNames({"texels", "threads"})
    ->ArgsProduct({{1, 16, 256, 4096}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MinTime(0.25)
    ->Repetitions(7)
    ->ReportAggregatesOnly();

}  // namespace

BENCHMARK_MAIN();
