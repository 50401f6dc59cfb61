// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/search_images.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abrdf {

namespace {

std::size_t at(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
}

}  // namespace

ImageStack cubeRoots(const ImageStack& images) {
    ImageStack roots(images.pairs(), images.width(), images.height());
    forEachImage(images.pairs().size(), [&](std::size_t i) {
        std::ranges::transform(images.image(i), roots.image(i).begin(), [](Rgb c) {
            return Rgb{std::cbrt(c.r), std::cbrt(c.g), std::cbrt(c.b)};
        });
    });
    return roots;
}

ImageStack halved(const ImageStack& images) {
    ImageStack half(images.pairs(), images.width() / 2, images.height() / 2);
    const int w = images.width();
    forEachImage(images.pairs().size(), [&](std::size_t i) {
        const auto from = std::as_const(images).image(i);
        for (int y = 0; y < half.height(); ++y) {
            for (int x = 0; x < half.width(); ++x) {
                half.image(i)[at(x, y, half.width())] =
                    0.25F * (from[at(2 * x, 2 * y, w)] + from[at(2 * x + 1, 2 * y, w)] +
                             from[at(2 * x, 2 * y + 1, w)] + from[at(2 * x + 1, 2 * y + 1, w)]);
            }
        }
    });
    return half;
}

ImageStack smoothed(const ImageStack& images, Edges edges) {
    ImageStack smooth(images.pairs(), images.width(), images.height());
    const int w = images.width();
    const int h = images.height();
    const auto index = [&](int i, int n) {
        return edges == Edges::kPeriodic ? (i + n) % n : std::clamp(i, 0, n - 1);
    };
    forEachImage(images.pairs().size(), [&](std::size_t i) {
        const auto from = std::as_const(images).image(i);
        std::vector<Rgb> rows(from.size());
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                rows[at(x, y, w)] =
                    0.25F * (from[at(index(x - 1, w), y, w)] + 2 * from[at(x, y, w)] +
                             from[at(index(x + 1, w), y, w)]);
            }
        }
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                smooth.image(i)[at(x, y, w)] =
                    0.25F * (rows[at(x, index(y - 1, h), w)] + 2 * rows[at(x, y, w)] +
                             rows[at(x, index(y + 1, h), w)]);
            }
        }
    });
    return smooth;
}

}  // namespace abrdf
