// SPDX-License-Identifier: BSD-3-Clause
//
// What colour costs beside the decoder: one 256 x 256 JPEG by libjpeg-turbo, and the conversions of
// its 65536 pixels, as the program makes them and as OpenColorIO alone would.
#include "abrdf/random.h"
#include "color/color_config.h"
#include "stages/average/average_image.h"

#include <benchmark/benchmark.h>
#include <turbojpeg.h>

#include <memory>
#include <vector>

namespace {

using abrdf::Rgb;

constexpr int kSize = 256;

const std::vector<std::uint8_t>& codes() {
    static const std::vector<std::uint8_t> kCodes = [] {
        std::vector<std::uint8_t> made;
        abrdf::Random random(1);
        for (int i = 0; i < kSize * kSize * 3; ++i) {
            const int wave = 110 + (i / 3 % kSize) / 4 + (i / 3 / kSize) % 40;
            made.push_back(static_cast<std::uint8_t>(wave + static_cast<int>(random.below(16))));
        }
        return made;
    }();
    return kCodes;
}

/// The limit: decoding alone.
void decode(benchmark::State& state) {
    struct Free {
        void operator()(void* handle) const { tjDestroy(handle); }
    };
    const std::unique_ptr<void, Free> encoder(tjInitCompress());
    const std::unique_ptr<void, Free> decoder(tjInitDecompress());
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    tjCompress2(encoder.get(), codes().data(), kSize, 0, kSize, TJPF_RGB, &jpeg, &size, TJSAMP_444,
                95, TJFLAG_ACCURATEDCT);
    std::vector<unsigned char> pixels(codes().size());
    for (auto _ : state) {
        tjDecompress2(decoder.get(), jpeg, size, pixels.data(), kSize, 0, kSize, TJPF_RGB,
                      TJFLAG_ACCURATEDCT);
        benchmark::DoNotOptimize(pixels.data());
    }
    state.counters["bytes"] = static_cast<double>(size);
    tjFree(jpeg);
}
BENCHMARK(decode)->Unit(benchmark::kMicrosecond);

/// What convert does with it, conversion and average, into scene_linear and into a wider gamut.
void average(benchmark::State& state, const char* from, const char* to) {
    const abrdf::Linearizer linearizer(abrdf::ColorConfig::load().transform(from, to));
    const abrdf::EncodedImage image{kSize, kSize, codes()};
    Rgb texel;
    for (auto _ : state) {
        abrdf::averageImage(image, linearizer, 1, 1, {&texel, 1});
        benchmark::DoNotOptimize(texel);
    }
}
BENCHMARK_CAPTURE(average, identity, "Raw", "Raw")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(average, srgb_to_rec709, "srgb_tx", "lin_rec709")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(average, srgb_to_acescg, "srgb_tx", "ACEScg")->Unit(benchmark::kMicrosecond);

/// OpenColorIO alone, on packed floats.
void apply(benchmark::State& state, const char* from, const char* to) {
    const abrdf::ColorTransform transform = abrdf::ColorConfig::load().transform(from, to);
    std::vector<Rgb> colors(std::size_t{kSize} * kSize, {0.2F, 0.3F, 0.4F});
    for (auto _ : state) {
        std::vector<Rgb> copy = colors;
        transform.apply(copy);
        benchmark::DoNotOptimize(copy.data());
    }
}
BENCHMARK_CAPTURE(apply, copy_alone, "lin_rec709", "lin_rec709")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(apply, curve, "srgb_tx", "lin_rec709")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(apply, matrix, "lin_rec709", "ACEScg")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(apply, curve_and_matrix, "srgb_tx", "ACEScg")->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
