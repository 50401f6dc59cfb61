// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/encode_picture.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/random.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abrdf {

std::uint16_t ditheredCode(float value, int bits, std::size_t pixel, int channel) {
    const double most = bits == 16 ? 65535 : 255;
    const double scaled = most * std::clamp(static_cast<double>(value), 0.0, 1.0);
    const double threshold = uniformFromHash(
        hashOf({static_cast<std::uint64_t>(pixel), static_cast<std::uint64_t>(channel)}));
    return static_cast<std::uint16_t>(std::min(most, std::floor(scaled + threshold)));
}

CodedPicture encodePicture(const Picture& picture, const ColorTransform& toDisplay,
                           const EncodeOptions& options) {
    if (options.bits != 8 && options.bits != 16) {
        throw std::invalid_argument("a picture for a display has 8 or 16 bits");
    }
    if (!(options.exposure > 0)) throw std::invalid_argument("the exposure must be above 0");
    CodedPicture coded;
    coded.width = picture.width;
    coded.height = picture.height;
    coded.bits = options.bits;
    coded.channels = options.background ? 3 : 4;
    const auto channels = static_cast<std::size_t>(coded.channels);
    coded.codes.resize(picture.count() * channels);
    const auto exposure = static_cast<float>(options.exposure);
    forEachTexelBlock(picture.count(), 4096, [&](std::size_t begin, std::size_t end) {
        std::vector<Rgb> colors(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const float alpha = picture.alpha[i];
            Rgb color = exposure * picture.color[i];
            if (options.background) {
                color += (1 - alpha) * *options.background;
            } else if (alpha > 0) {
                color *= 1 / alpha;
            }
            colors[i - begin] = color;
        }
        toDisplay.apply(colors);
        const auto code = [&](float value, std::size_t pixel, int channel) {
            if (options.dither) return ditheredCode(value, options.bits, pixel, channel);
            const float most = options.bits == 16 ? 65535.0F : 255.0F;
            return static_cast<std::uint16_t>(std::lround(most * std::clamp(value, 0.0F, 1.0F)));
        };
        for (std::size_t i = begin; i < end; ++i) {
            const Rgb& c = colors[i - begin];
            std::uint16_t* codes = &coded.codes[i * channels];
            codes[0] = code(c.r, i, 0);
            codes[1] = code(c.g, i, 1);
            codes[2] = code(c.b, i, 2);
            if (channels == 4) codes[3] = code(picture.alpha[i], i, 3);
        }
    });
    return coded;
}

}  // namespace abrdf
