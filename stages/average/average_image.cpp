// SPDX-License-Identifier: BSD-3-Clause
#include "stages/average/average_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <variant>
#include <vector>

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

/// isFinite() of all. Channel by channel and without a branch: compilers make vectors of that, and
/// every pixel of every image is asked.
bool areFinite(std::span<const Rgb> row) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const float* channels = &row.front().r;
    constexpr float kMax = std::numeric_limits<float>::max();
    int others = 0;
    for (std::size_t i = 0; i < 3 * row.size(); ++i) {
        const auto aboveLeast = static_cast<int>(channels[i] >= -kMax);
        others += 1 - (aboveLeast & static_cast<int>(channels[i] <= kMax));
    }
    return others == 0;
}

void addTo(Sum& total, const Sum& sum, double weight) {
    total.r += weight * sum.r;
    total.g += weight * sum.g;
    total.b += weight * sum.b;
    total.weight += weight * sum.weight;
}

/// The sum of count pixels, all valid. Four partial sums, as one alone would wait for each
/// addition. add(x, sum) adds pixel x.
template <typename Add>
Sum sumOf(std::size_t count, const Add& add) {
    constexpr std::size_t kParts = 4;
    std::array<Sum, kParts> parts;
    std::size_t x = 0;
    for (; x + kParts <= count; x += kParts) {
        for (std::size_t part = 0; part < kParts; ++part) add(x + part, parts[part]);
    }
    for (std::size_t part = 1; part < kParts; ++part) addTo(parts[0], parts[part], 1);
    for (; x < count; ++x) add(x, parts[0]);
    parts[0].weight = static_cast<double>(count);
    return parts[0];
}

/// A row of linear colours; NaN where a pixel is to be left out.
class LinearRow {
  public:
    LinearRow(std::span<const Rgb> colors, bool allValid) : colors_(colors), allValid_(allValid) {}

    std::size_t size() const { return colors_.size(); }
    Sum at(std::size_t x) const {
        const Rgb& c = colors_[x];
        return allValid_ || isFinite(c) ? Sum{c.r, c.g, c.b, 1} : Sum{};
    }
    Sum over(std::size_t begin, std::size_t end) const {
        Sum sum;
        if (!allValid_) {
            for (std::size_t x = begin; x < end; ++x) addTo(sum, at(x), 1);
            return sum;
        }
        return sumOf(end - begin, [&](std::size_t x, Sum& part) {
            const Rgb& c = colors_[begin + x];
            part.r += static_cast<double>(c.r);
            part.g += static_cast<double>(c.g);
            part.b += static_cast<double>(c.b);
        });
    }

  private:
    std::span<const Rgb> colors_;
    bool allValid_;
};

/// A row of eight-bit codes, R G B R G B ..., summed straight from the table of their light.
class CodedRow {
  public:
    CodedRow(std::span<const std::uint8_t> codes, const CodeTable& table)
        : codes_(codes), table_(table) {}

    std::size_t size() const { return codes_.size() / 3; }
    Sum at(std::size_t x) const { return over(x, x + 1); }
    Sum over(std::size_t begin, std::size_t end) const {
        const std::uint8_t* code = codes_.data() + 3 * begin;
        return sumOf(end - begin, [&](std::size_t x, Sum& part) {
            part.r += table_.curves[0][code[3 * x]];
            part.g += table_.curves[1][code[3 * x + 1]];
            part.b += table_.curves[2][code[3 * x + 2]];
        });
    }

  private:
    std::span<const std::uint8_t> codes_;
    const CodeTable& table_;
};

/// Adds one row of pixels to one row of texels, with weight `rowShare`.
template <typename Row>
void addRow(const Row& row, double rowShare, std::span<Sum> sums) {
    const int pixels = static_cast<int>(row.size());
    const int width = static_cast<int>(sums.size());
    for (int texel = 0; texel < width; ++texel) {
        const int begin = texelOfPixel(texel, width, pixels);
        const int end = std::min(pixels, texelOfPixel(texel + 1, width, pixels) + 1);
        Sum& total = sums[static_cast<std::size_t>(texel)];
        // Only the two outermost pixels can be cut by a border.
        addTo(total, row.at(static_cast<std::size_t>(begin)),
              rowShare * share(begin, pixels, texel, width));
        if (begin + 1 == end) continue;
        addTo(total,
              row.over(static_cast<std::size_t>(begin + 1), static_cast<std::size_t>(end - 1)),
              rowShare);
        addTo(total, row.at(static_cast<std::size_t>(end - 1)),
              rowShare * share(end - 1, pixels, texel, width));
    }
}

/// Sums of an image row by row: addPixels(y, rowShare, sums of a row of texels) for each row of
/// pixels and each row of texels that it has a share in.
template <typename AddPixels>
std::vector<Sum> sumTexels(int imageHeight, int width, int height, const AddPixels& addPixels) {
    std::vector<Sum> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < imageHeight; ++y) {
        for (int texel = texelOfPixel(y, imageHeight, height); texel < height; ++texel) {
            const double rowShare = share(y, imageHeight, texel, height);
            if (rowShare == 0) break;
            addPixels(y, rowShare,
                      std::span(sums).subspan(static_cast<std::size_t>(texel * width),
                                              static_cast<std::size_t>(width)));
        }
    }
    return sums;
}

void checkTexels(int imageWidth, int imageHeight, int width, int height) {
    if (width >= 1 && height >= 1 && width <= imageWidth && height <= imageHeight) return;
    throw std::invalid_argument(
        fmt::format("{} x {} texels cannot be made of images of {} x {} pixels", width, height,
                    imageWidth, imageHeight));
}

/// An average outside the working space is moved to its border.
Rgb light(const std::array<double, 3>& mean) {
    const auto atLeast0 = [](double v) { return static_cast<float>(std::max(0.0, v)); };
    return {atLeast0(mean[0]), atLeast0(mean[1]), atLeast0(mean[2])};
}

/// table: of the codes that were summed, or null where light was.
void meansOf(std::span<const Sum> sums, const CodeTable* table, std::span<Rgb> texels) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Sum& s = sums[i];
        if (s.weight <= 0) {
            texels[i] = {kNaN, kNaN, kNaN};
            continue;
        }
        std::array<double, 3> mean = {s.r / s.weight, s.g / s.weight, s.b / s.weight};
        if (table != nullptr) mean = table->light(mean);
        texels[i] = light(mean);
    }
}

}  // namespace

std::size_t averageImage(const EncodedImage& image, const Linearizer& linearizer, int width,
                         int height, std::span<Rgb> texels) {
    checkTexels(image.width, image.height, width, height);
    const auto columns = static_cast<std::size_t>(image.width);
    const auto* codes = std::get_if<std::vector<std::uint8_t>>(&image.rgb);
    const CodeTable* table = codes != nullptr ? linearizer.table() : nullptr;
    if (table != nullptr) {
        const auto addCodes = [&](int y, double rowShare, std::span<Sum> row) {
            const std::size_t first = 3 * static_cast<std::size_t>(y) * columns;
            addRow(CodedRow(std::span(*codes).subspan(first, 3 * columns), *table), rowShare, row);
        };
        meansOf(sumTexels(image.height, width, height, addCodes), table, texels);
        return 0;
    }
    std::vector<Rgb> colors(columns);
    std::size_t leftOut = 0;
    bool allValid = true;
    int linear = -1;  // The row that `colors` holds.
    const std::vector<Sum> sums =
        sumTexels(image.height, width, height, [&](int y, double rowShare, std::span<Sum> row) {
            if (y != linear) {
                linear = y;
                linearizer.linearize(image, static_cast<std::size_t>(y) * columns, colors);
                // Bad pixels are NaN now; a negative channel is a colour outside the working space.
                allValid = areFinite(colors);
                if (!allValid) {
                    leftOut +=
                        columns - static_cast<std::size_t>(std::ranges::count_if(colors, isFinite));
                }
            }
            addRow(LinearRow(colors, allValid), rowShare, row);
        });
    meansOf(sums, nullptr, texels);
    return leftOut;
}

void averageColors(std::span<const Rgb> colors, int imageWidth, int imageHeight, int width,
                   int height, std::span<Rgb> texels) {
    checkTexels(imageWidth, imageHeight, width, height);
    const auto columns = static_cast<std::size_t>(imageWidth);
    const auto addColors = [&](int y, double rowShare, std::span<Sum> row) {
        const auto pixels = colors.subspan(static_cast<std::size_t>(y) * columns, columns);
        addRow(LinearRow(pixels, areFinite(pixels)), rowShare, row);
    };
    meansOf(sumTexels(imageHeight, width, height, addColors), nullptr, texels);
}

}  // namespace abrdf
