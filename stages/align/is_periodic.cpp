// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "stages/align/find_plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace abrdf {

namespace {

double squaredLength(Rgb c) {
    return static_cast<double>(c.r * c.r + c.g * c.g + c.b * c.b);
}

/// Squared differences of neighbouring lines of an image (columns, or rows): of line i and line
/// i + 1; the last is that of the two edges.
std::vector<double> stepsOf(std::span<const Rgb> image, std::size_t count, std::size_t step,
                            std::size_t length, std::size_t lengthStep) {
    std::vector<double> steps(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        for (std::size_t k = 0; k < length; ++k) {
            steps[i] += squaredLength(image[i * step + k * lengthStep] -
                                      image[next * step + k * lengthStep]);
        }
    }
    return steps;
}

double squaredDeviation(std::span<const Rgb> image) {
    Rgb mean;
    for (const Rgb& c : image) mean += 1 / static_cast<float>(image.size()) * c;
    double sum = 0;
    for (const Rgb& c : image) sum += squaredLength(c - mean);
    return sum;
}

/// The edges join where they differ less than two unrelated lines, by half of what these differ
/// more than neighbours; or no more than the most unlike neighbours, as between two yarns.
bool join(std::vector<double> steps, double unrelated) {
    const double across = steps.back();
    steps.pop_back();
    const double mean =
        std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
    constexpr double kTolerance = 1.1;
    return across <= (mean + unrelated) / 2 ||
           across <= kTolerance * *std::ranges::max_element(steps);
}

}  // namespace

bool isPeriodic(const ImageStack& images) {
    const auto w = static_cast<std::size_t>(images.width());
    const auto h = static_cast<std::size_t>(images.height());
    if (w < 3 || h < 3) return false;
    struct OfImage {
        std::vector<double> columns;
        std::vector<double> rows;
        double deviation = 0;
    };
    std::vector<OfImage> each(images.pairs().size());
    forEachImage(each.size(), [&](std::size_t i) {
        const auto image = images.image(i);
        each[i] = {stepsOf(image, w, 1, h, w), stepsOf(image, h, w, w, 1), squaredDeviation(image)};
    });
    OfImage sums{std::vector<double>(w), std::vector<double>(h), 0};
    for (const OfImage& image : each) {
        if (!std::isfinite(image.deviation)) continue;  // A texel that is no number.
        for (std::size_t i = 0; i < w; ++i) sums.columns[i] += image.columns[i];
        for (std::size_t i = 0; i < h; ++i) sums.rows[i] += image.rows[i];
        sums.deviation += image.deviation;
    }
    const auto unrelated = [&](std::size_t lines) {
        return 2 * sums.deviation / static_cast<double>(lines);
    };
    return join(std::move(sums.columns), unrelated(w)) && join(std::move(sums.rows), unrelated(h));
}

}  // namespace abrdf
