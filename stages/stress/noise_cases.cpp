// SPDX-License-Identifier: BSD-3-Clause
//
// Noise of the samples: of the sensor, of few codes, of JPEG.
#include "color/delta_e.h"
#include "stages/stress/stress_case.h"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace abrdf {

namespace {

float decoded(double code) {
    return static_cast<float>(linearFromSrgb(code));
}

/// A sample as a display-referred image of so many bits holds it.
Rgb quantized(Rgb color, double bits) {
    const double last = std::exp2(bits) - 1;
    const auto code = [&](float linear) {
        return decoded(std::round(srgbEncoded(static_cast<double>(linear)) * last) / last);
    };
    return {code(color.r), code(color.g), code(color.b)};
}

constexpr int kBlock = 16;  ///< Two of JPEG's blocks each way, so that chroma has one of its own.

/// One texel of a small image whose texels are `color` times a texture of +-30 %, through JPEG
/// with chroma of half the resolution. The texel's own factor is taken out again.
Rgb throughJpeg(Rgb color, int quality, Random& random) {
    std::array<float, kBlock * kBlock> texture{};
    for (float& factor : texture) factor = static_cast<float>(random.uniform(0.7, 1.3));
    std::array<std::uint8_t, 3 * kBlock * kBlock> codes{};
    for (std::size_t i = 0; i < texture.size(); ++i) {
        const std::array<float, 3> channels = {color.r, color.g, color.b};
        for (std::size_t c = 0; c < 3; ++c) {
            codes[3 * i + c] = static_cast<std::uint8_t>(
                std::lround(255 * srgbEncoded(static_cast<double>(texture[i] * channels[c]))));
        }
    }
    const std::unique_ptr<void, int (*)(tjhandle)> in(tjInitCompress(), tjDestroy);
    const std::unique_ptr<void, int (*)(tjhandle)> out(tjInitDecompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    const bool done = in && out &&
                      tjCompress2(in.get(), codes.data(), kBlock, 0, kBlock, TJPF_RGB, &bytes,
                                  &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT) == 0 &&
                      tjDecompress2(out.get(), bytes, size, codes.data(), kBlock, 0, kBlock,
                                    TJPF_RGB, TJFLAG_ACCURATEDCT) == 0;
    tjFree(bytes);
    if (!done) throw std::runtime_error("libjpeg-turbo does not encode a block of a stress test");
    const std::size_t texel = random.below(texture.size());
    const auto channel = [&](std::size_t c) {
        return decoded(codes[3 * texel + c] / 255.0) / texture[texel];
    };
    return {channel(0), channel(1), channel(2)};
}

using Change = std::function<Rgb(Rgb color, Random& random)>;

StressTrial changed(const StressMaterial& material, Change change, double noise) {
    StressTrial trial;
    trial.truth = material;
    trial.measured = [value = material.value, change = std::move(change)](const LightAndView& pair,
                                                                          Random& random) {
        return change(value(pair), random);
    };
    trial.noise = noise;
    return trial;
}

float atLeast0(double value) {
    return static_cast<float>(std::max(0.0, value));
}

}  // namespace

std::vector<StressCase> noiseCases() {
    constexpr double kNoiseOfCodes = 0.01;  // What the pipeline takes 8-bit images to have.
    return {
        {"noise", "multiplicative noise of the samples", "deviation", true, false,
         stepsOf({0, 0.01, 0.02, 0.05, 0.1, 0.2}, 100, " %"),
         [](const StressMaterial& material, double sigma) {
             return changed(
                 material,
                 [sigma](Rgb c, Random& random) {
                     return atLeast0(1 + sigma * random.normal()) * c;
                 },
                 sigma);
         }},
        {"offset", "additive noise of the samples, white is 1", "deviation", true, false,
         stepsOf({0, 0.001, 0.003, 0.01, 0.03, 0.1}),
         [](const StressMaterial& material, double sigma) {
             return changed(
                 material,
                 [sigma](Rgb c, Random& random) {
                     const auto noisy = [&](float v) {
                         return atLeast0(static_cast<double>(v) + sigma * random.normal());
                     };
                     return Rgb{noisy(c.r), noisy(c.g), noisy(c.b)};
                 },
                 0);
         }},
        {"bits", "samples in sRGB codes, clipped at 1", "bits", true, false,
         stepsOf({16, 12, 10, 8, 6, 5, 4}, 1, " bits"),
         [](const StressMaterial& material, double bits) {
             StressTrial trial = changed(
                 material, [bits](Rgb c, Random&) { return quantized(c, bits); }, kNoiseOfCodes);
             trial.saturated = 0.99;
             return trial;
         }},
        {"jpeg", "single texels of a texture, through JPEG 4:2:0", "quality", true, false,
         stepsOf({100, 95, 90, 80, 60, 45, 30}),
         [](const StressMaterial& material, double quality) {
             StressTrial trial = changed(
                 material,
                 [quality](Rgb c, Random& random) {
                     return throughJpeg(c, static_cast<int>(quality), random);
                 },
                 kNoiseOfCodes);
             trial.saturated = 0.99;
             return trial;
         }},
    };
}

}  // namespace abrdf
