// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_colors.h"

#include "abrdf/register_bytes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

using namespace abrdf;

namespace {

struct Numbers {
    std::vector<std::vector<float>> lists;
    TexelRows rows;

    explicit Numbers(std::size_t count) {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> log(-12, 4);
        std::uniform_real_distribution<float> chroma(-1.5F, 1.5F);
        for (int i = 0; i < 12; ++i) {
            std::vector<float>& list = lists.emplace_back(count);
            for (float& x : list) x = i < 8 ? log(random) : chroma(random);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            rows.logs[i] = lists[i].data();
            rows.logCenters[i] = lists[4 + i].data();
        }
        for (std::size_t c = 0; c < 2; ++c) {
            rows.chroma[c] = lists[8 + c].data();
            rows.chromaCenters[c] = lists[10 + c].data();
        }
        rows.meanChroma = {1.2F, 0.9F};
        rows.luminance = 0.4F;
        rows.channel = {0.5F, 0.3F, 0.2F};
        rows.cap = 1.7F;
        rows.floor = 2e-4F;
    }
};

void checkColors(int bytes) {
    const RegisterLimit limit(bytes);
    for (const std::size_t count : {1U, 7U, 255U, 256U, 700U}) {
        Numbers numbers(count);
        // Past the bounds of the exponential, and of an unreal texel.
        numbers.lists[0][0] = 1e9F;
        numbers.lists[1][0] = -1e9F;
        numbers.lists[2][count / 2] = std::numeric_limits<float>::quiet_NaN();
        for (const float blend : {0.0F, 0.25F, 0.5F, 1.0F}) {
            for (const Rgb channel : {Rgb{0.5F, 0.3F, 0.2F}, Rgb{0, 0.3F, 0.2F}, Rgb{}}) {
                TexelRows rows = numbers.rows;
                rows.blend = blend;
                rows.channel = channel;
                if (blend == 0) rows.logs[1] = rows.logs[2] = rows.logs[3] = nullptr;
                if (blend == 1) rows.chroma = {};
                std::vector<Rgb> colors(count + 1, Rgb{7, 7, 7});
                texelColors(rows, count, colors.data());
                CHECK(colors[count] == Rgb{7, 7, 7});
                std::size_t wrong = 0;
                for (std::size_t row = 0; row < count; ++row) {
                    const Rgb slow = slowTexelColor(rows, row);
                    wrong += std::memcmp(&slow, &colors[row], sizeof slow) == 0 ? 0U : 1U;
                    CHECK(colors[row].r >= 0);
                    if (channel.r == 0) CHECK(colors[row].r == 0);
                }
                CHECK(wrong == 0);
            }
        }
    }
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE(
    "colours of many rows have the bits of one at a time, for every blend, odd counts and all "
    "registers") {
    for (const int bytes : {16, 32, 64}) checkColors(bytes);
}

TEST_CASE("a colour's channels have the luminance of its logarithm in the mean") {
    Numbers numbers(300);
    std::vector<Rgb> colors(300);
    texelColors(numbers.rows, colors.size(), colors.data());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const double x = std::min(1.7, static_cast<double>(numbers.lists[0][i]) +
                                           static_cast<double>(numbers.lists[4][i]));
        const double luminance = 0.4 * std::max(0.0, std::exp(x) - 2e-4);
        const Rgb c = colors[i];
        CHECK(static_cast<double>(c.r + c.g + c.b) / 3 ==
              doctest::Approx(luminance).epsilon(1e-5).scale(1e-4));
    }
}

TEST_SUITE_END();
