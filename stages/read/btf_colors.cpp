// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/btf_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

using Triple = std::array<float, 3>;

Triple rgbFromYuv(const Triple& v) {
    return {v[0] + 1.13983F * v[2], v[0] - 0.39465F * v[1] - 0.5806F * v[2],
            v[0] + 2.03211F * v[1]};
}

float signedExp(float v) {
    return std::copysign(kBtfEpsilon * std::exp(std::abs(v)), v);
}

Triple converted(const BtfColorModel& model, const Triple& v) {
    const float luminance = std::exp(v[0]);
    switch (model.number) {
        case 1:
            return rgbFromYuv(v);
        case 3: {
            Triple rgb = model.mean;
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j) rgb[j] += v[i] * model.matrix[3 * i + j];
            }
            return rgb;
        }
        case 4:
            return {v[0] + v[1] - v[2], v[0] + v[2], v[0] - v[1] - v[2]};
        case 9:
            return rgbFromYuv({luminance - kBtfEpsilon, v[1], v[2]});
        case 10:
            return rgbFromYuv({luminance - kBtfEpsilon, signedExp(v[1]), signedExp(v[2])});
        case 11:
            return rgbFromYuv({luminance - kBtfEpsilon, v[1] * luminance, v[2] * luminance});
        default:
            return v;
    }
}

}  // namespace

BtfColorModel readBtfColorModel(ByteCursor& file, std::size_t channels) {
    BtfColorModel model;
    model.number = file.number<std::int32_t>("colour model");
    for (float& m : model.mean) m = file.f32("colour mean");
    for (float& m : model.matrix) m = file.f32("colour matrix");
    constexpr std::array<std::int32_t, 8> kKnown = {0, 1, 3, 4, 9, 10, 11, 12};
    if (std::ranges::count(kKnown, model.number) == 0) {
        file.fail(
            fmt::format("its colour model {} is not one that can be decoded (0, 1, 3, 4, 9 "
                        "to 12)",
                        model.number));
    }
    if (channels != 3 && model.number != 0 && model.number != 12) {
        file.fail(fmt::format("its colour model {} needs three channels, and it has {}",
                              model.number, channels));
    }
    return model;
}

void applyColorModel(const BtfColorModel& model, std::size_t channels, std::span<float> values) {
    if (model.number == 0) return;
    if (model.number == 12) {
        for (float& v : values) v = std::exp(v) - kBtfEpsilon;
        return;
    }
    for (std::size_t i = 0; i + channels <= values.size(); i += channels) {
        const Triple rgb = converted(model, {values[i], values[i + 1], values[i + 2]});
        std::ranges::copy(rgb, values.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

}  // namespace abrdf
