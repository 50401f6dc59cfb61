// SPDX-License-Identifier: BSD-3-Clause
#include "stages/average/average_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace abrdf {

namespace {

struct Sum {
    double r = 0;
    double g = 0;
    double b = 0;
    double weight = 0;
};

/// The share of pixel `pixel` (of `pixels`) that lies in texel `texel` (of `texels`), 0 .. 1.
double share(int pixel, int pixels, int texel, int texels) {
    const double scale = static_cast<double>(pixels) / texels;
    const double begin = std::max(static_cast<double>(pixel), texel * scale);
    const double end = std::min(pixel + 1.0, (texel + 1) * scale);
    return std::max(0.0, end - begin);
}

int texelOfPixel(int pixel, int pixels, int texels) {
    return static_cast<int>(static_cast<std::int64_t>(pixel) * texels / pixels);
}

/// Adds one row of pixels to one row of texels, with weight `rowShare`.
void addRow(std::span<const Rgb> row, int width, double rowShare, std::span<Sum> sums) {
    const int pixels = static_cast<int>(row.size());
    for (int texel = 0; texel < width; ++texel) {
        const int begin = texelOfPixel(texel, width, pixels);
        const int end = std::min(pixels, texelOfPixel(texel + 1, width, pixels) + 1);
        Sum sum;
        for (int x = begin; x < end; ++x) {
            const Rgb& c = row[static_cast<std::size_t>(x)];
            // Comparisons with NaN are false, so one test finds all that is not a light.
            const bool valid = c.r >= 0 && c.g >= 0 && c.b >= 0 && isFinite(c);
            const bool inside = x > begin && x + 1 < end;
            const double w =
                valid ? rowShare * (inside ? 1.0 : share(x, pixels, texel, width)) : 0.0;
            if (w == 0) continue;
            sum.r += w * static_cast<double>(c.r);
            sum.g += w * static_cast<double>(c.g);
            sum.b += w * static_cast<double>(c.b);
            sum.weight += w;
        }
        Sum& total = sums[static_cast<std::size_t>(texel)];
        total.r += sum.r;
        total.g += sum.g;
        total.b += sum.b;
        total.weight += sum.weight;
    }
}

}  // namespace

Linearizer::Linearizer(ColorTransform toSceneLinear) : transform_(std::move(toSceneLinear)) {
    if (!transform_.isPerChannel()) return;
    for (int code = 0; code < 256; ++code) {
        const float grey = static_cast<float>(code) / 255.0F;
        table_.push_back({grey, grey, grey});
    }
    transform_.apply(table_);
}

void Linearizer::linearize(const EncodedImage& image, std::size_t first, std::span<Rgb> row) const {
    if (const auto* floats = std::get_if<std::vector<float>>(&image.rgb)) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const float* p = floats->data() + 3 * (first + i);
            // A negative or unreal light stays one: a conversion could hide it.
            const Rgb c = {p[0], p[1], p[2]};
            constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
            row[i] = isFinite(c) && !isNegative(c) ? c : Rgb{kNaN, kNaN, kNaN};
        }
        if (!transform_.isIdentity()) transform_.apply(row);
        return;
    }
    const std::uint8_t* codes = std::get<std::vector<std::uint8_t>>(image.rgb).data() + 3 * first;
    if (!table_.empty()) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            row[i] = {table_[codes[3 * i]].r, table_[codes[3 * i + 1]].g,
                      table_[codes[3 * i + 2]].b};
        }
        return;
    }
    constexpr float kScale = 1.0F / 255.0F;
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = {static_cast<float>(codes[3 * i]) * kScale,
                  static_cast<float>(codes[3 * i + 1]) * kScale,
                  static_cast<float>(codes[3 * i + 2]) * kScale};
    }
    transform_.apply(row);
}

std::size_t averageImage(const EncodedImage& image, const Linearizer& linearizer, int width,
                         int height, std::span<Rgb> texels) {
    if (width < 1 || height < 1 || width > image.width || height > image.height) {
        throw std::invalid_argument(
            fmt::format("{} x {} texels cannot be made of images of {} x {} pixels", width, height,
                        image.width, image.height));
    }
    const auto columns = static_cast<std::size_t>(image.width);
    std::vector<Rgb> row(columns);
    std::vector<Sum> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::size_t leftOut = 0;
    for (int y = 0; y < image.height; ++y) {
        linearizer.linearize(image, static_cast<std::size_t>(y) * columns, row);
        for (const Rgb& c : row) leftOut += isFinite(c) && !isNegative(c) ? 0U : 1U;
        const int firstTexel = texelOfPixel(y, image.height, height);
        for (int texel = firstTexel; texel < height; ++texel) {
            const double rowShare = share(y, image.height, texel, height);
            if (rowShare == 0) break;
            addRow(row, width, rowShare,
                   std::span(sums).subspan(static_cast<std::size_t>(texel * width),
                                           static_cast<std::size_t>(width)));
        }
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Sum& s = sums[i];
        texels[i] = s.weight > 0 ? Rgb{static_cast<float>(s.r / s.weight),
                                       static_cast<float>(s.g / s.weight),
                                       static_cast<float>(s.b / s.weight)}
                                 : Rgb{kNaN, kNaN, kNaN};
    }
    return leftOut;
}

}  // namespace abrdf
