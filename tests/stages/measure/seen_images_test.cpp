// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/seen_images.h"

#include "abrdf/direction.h"
#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "stages/measure/gaussian_blur.h"
#include "stages/measure/measures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace abrdf;

namespace {

constexpr int kSize = 32;
constexpr std::size_t kPairs = 3;

AbrdfTile tileOf(const std::function<Rgb(int x, int y, std::size_t pair)>& color) {
    AbrdfTile tile(kSize * kSize, kPairs);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            for (std::size_t pair = 0; pair < kPairs; ++pair) {
                tile[static_cast<std::size_t>(y * kSize + x)][pair] = color(x, y, pair);
            }
        }
    }
    return tile;
}

SeenMeasures seen(const AbrdfTile& truth, const AbrdfTile& reconstruction) {
    const std::vector<std::uint8_t> all(kPairs, 1);
    return measureSeenImages(truth, reconstruction, kSize, kSize, all, {.isPeriodic = true});
}

const Rgb kBlue{0.1F, 0.2F, 0.5F};
const Rgb kSand{0.5F, 0.4F, 0.3F};

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("uniform images differ to the eye by their plain colour difference") {
    const AbrdfTile blue = tileOf([](int, int, std::size_t) { return kBlue; });
    const AbrdfTile sand = tileOf([](int, int, std::size_t) { return kSand; });
    const SeenMeasures m = seen(blue, sand);
    CHECK(m.images == kPairs);
    CHECK(m.sCielab ==
          doctest::Approx(deltaE76(labFromLinearRec709(kBlue), labFromLinearRec709(kSand)))
              .epsilon(1e-3));
    const SeenMeasures same = seen(blue, blue);
    CHECK(same.sCielab == 0);
    CHECK(same.ssim == doctest::Approx(1));
}

TEST_CASE("a pattern of single texels is seen as its mean, a coarse one as it is") {
    const auto board = [](int texels) {
        return [texels](int x, int y, std::size_t) {
            return (x / texels + y / texels) % 2 == 0 ? Rgb{0.4F, 0.4F, 0.4F}
                                                      : Rgb{0.2F, 0.2F, 0.2F};
        };
    };
    const AbrdfTile mean = tileOf([](int, int, std::size_t) { return Rgb{0.3F, 0.3F, 0.3F}; });
    const double plain =
        deltaE76(labFromLinearRec709({0.4F, 0.4F, 0.4F}), labFromLinearRec709({0.3F, 0.3F, 0.3F}));
    CHECK(seen(tileOf(board(1)), mean).sCielab < 0.05 * plain);
    CHECK(seen(tileOf(board(16)), mean).sCielab > 0.7 * plain);
}

TEST_CASE("structure that is turned upside down is unlike, a brighter image is alike") {
    const auto wave = [](double sign, float factor) {
        return [=](int x, int, std::size_t) {
            const auto c = static_cast<float>(0.3 + sign * 0.2 * std::sin(x * kPi / 4));
            return Rgb{factor * c, factor * c, factor * c};
        };
    };
    const AbrdfTile truth = tileOf(wave(1, 1));
    CHECK(seen(truth, tileOf(wave(-1, 1))).ssim < 0);
    CHECK(seen(truth, tileOf(wave(1, 1.1F))).ssim > 0.98);
}

TEST_CASE("what the measurement lacks is left out") {
    AbrdfTile truth = tileOf([](int, int, std::size_t) { return kBlue; });
    AbrdfTile other = truth;
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    truth[5][1] = {kNaN, kNaN, kNaN};
    other[5][1] = kSand;
    const SeenMeasures m = seen(truth, other);
    CHECK(m.sCielab == 0);
    CHECK(m.ssim == doctest::Approx(1));
}

TEST_CASE("blur weights sum to one, keep constants and follow the Gaussian") {
    for (const bool isPeriodic : {false, true}) {
        for (const double spread : {0.4, 3.0, 90.0}) {
            const Eigen::MatrixXf weights = blurWeights(20, spread, isPeriodic);
            for (Eigen::Index i = 0; i < 20; ++i) {
                CHECK(weights.row(i).sum() == doctest::Approx(1));
            }
        }
        const Eigen::MatrixXf weights = blurWeights(20, 1.5, isPeriodic);
        CHECK(weights(10, 12) / weights(10, 10) ==
              doctest::Approx(std::exp(-4 / 2.25)).epsilon(1e-4));
    }
    CHECK(blurWeights(20, 2, true)(0, 19) == blurWeights(20, 2, true)(0, 1));
    CHECK(blurWeights(20, 2, false)(0, 19) == 0);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("what is seen has the same bits on any number of threads") {
    const AbrdfTile truth = tileOf([](int x, int y, std::size_t pair) {
        const auto c =
            static_cast<float>(0.2 + 0.01 * ((x * 7 + y * 3 + 5 * static_cast<int>(pair)) % 40));
        return Rgb{c, 0.5F * c, 0.3F};
    });
    const AbrdfTile other = tileOf([](int x, int, std::size_t) {
        return Rgb{0.3F, 0.2F, 0.01F * static_cast<float>(x)};
    });
    const std::vector<std::vector<std::uint8_t>> masks = {{1, 1, 1}, {0, 1, 0}};
    const SeenMeasures first = seen(truth, other);
    const auto texels = measureTexels(truth, other, masks, {});
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        CHECK(seen(truth, other).sCielab == first.sCielab);
        CHECK(seen(truth, other).ssim == first.ssim);
        CHECK(measureTexels(truth, other, masks, {})[1].accuracy.natural.deltaE ==
              texels[1].accuracy.natural.deltaE);
    }
}

TEST_SUITE_END();
