// SPDX-License-Identifier: BSD-3-Clause
#include "stages/average/average_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

bool isLight(const Rgb& c) {
    return isFinite(c) && !isNegative(c);
}

/// isLight() of all. Channel by channel and without a branch: compilers make vectors of that, and
/// every pixel of every image is asked.
bool areLights(std::span<const Rgb> row) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const float* channels = &row.front().r;
    constexpr float kMax = std::numeric_limits<float>::max();
    int others = 0;
    for (std::size_t i = 0; i < 3 * row.size(); ++i) {
        const auto notNegative = static_cast<int>(channels[i] >= 0);
        others += 1 - (notNegative & static_cast<int>(channels[i] <= kMax));
    }
    return others == 0;
}

/// The sum of pixels that are all valid and count whole. Four partial sums, as one alone would
/// wait for each addition.
Sum sumOf(std::span<const Rgb> pixels) {
    constexpr std::size_t kParts = 4;
    std::array<Sum, kParts> parts;
    std::size_t x = 0;
    for (; x + kParts <= pixels.size(); x += kParts) {
        for (std::size_t part = 0; part < kParts; ++part) {
            const Rgb& c = pixels[x + part];
            parts[part].r += static_cast<double>(c.r);
            parts[part].g += static_cast<double>(c.g);
            parts[part].b += static_cast<double>(c.b);
        }
    }
    Sum sum = parts[0];
    for (std::size_t part = 1; part < kParts; ++part) {
        sum.r += parts[part].r;
        sum.g += parts[part].g;
        sum.b += parts[part].b;
    }
    for (; x < pixels.size(); ++x) {
        sum.r += static_cast<double>(pixels[x].r);
        sum.g += static_cast<double>(pixels[x].g);
        sum.b += static_cast<double>(pixels[x].b);
    }
    sum.weight = static_cast<double>(pixels.size());
    return sum;
}

void addTo(Sum& total, const Sum& sum, double weight) {
    total.r += weight * sum.r;
    total.g += weight * sum.g;
    total.b += weight * sum.b;
    total.weight += weight * sum.weight;
}

/// Adds one row of pixels to one row of texels, with weight `rowShare`. allValid: no pixel of the
/// row needs to be left out.
void addRow(std::span<const Rgb> row, bool allValid, int width, double rowShare,
            std::span<Sum> sums) {
    const int pixels = static_cast<int>(row.size());
    for (int texel = 0; texel < width; ++texel) {
        const int begin = texelOfPixel(texel, width, pixels);
        const int end = std::min(pixels, texelOfPixel(texel + 1, width, pixels) + 1);
        Sum& total = sums[static_cast<std::size_t>(texel)];
        const auto addPixel = [&](int x, double weight) {
            const Rgb& c = row[static_cast<std::size_t>(x)];
            if (weight == 0 || !(allValid || isLight(c))) return;
            addTo(total, {c.r, c.g, c.b, 1}, weight);
        };
        // Only the two outermost pixels can be cut by a border.
        addPixel(begin, rowShare * share(begin, pixels, texel, width));
        if (allValid && begin + 2 < end) {
            addTo(total,
                  sumOf(row.subspan(static_cast<std::size_t>(begin + 1),
                                    static_cast<std::size_t>(end - begin - 2))),
                  rowShare);
        } else {
            for (int x = begin + 1; x + 1 < end; ++x) addPixel(x, rowShare);
        }
        if (begin + 1 < end) addPixel(end - 1, rowShare * share(end - 1, pixels, texel, width));
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
            row[i] = isLight(c) ? c : Rgb{kNaN, kNaN, kNaN};
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
        const bool allValid = areLights(row);
        if (!allValid) {
            leftOut += columns - static_cast<std::size_t>(std::ranges::count_if(row, isLight));
        }
        const int firstTexel = texelOfPixel(y, image.height, height);
        for (int texel = firstTexel; texel < height; ++texel) {
            const double rowShare = share(y, image.height, texel, height);
            if (rowShare == 0) break;
            addRow(row, allValid, width, rowShare,
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
