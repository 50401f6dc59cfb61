// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/measures.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<Rgb> ramp(std::size_t count, float last) {
    std::vector<Rgb> colors(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float value = last * static_cast<float>(i + 1) / static_cast<float>(count);
        colors[i] = {value, 0.7F * value, 0.4F * value};
    }
    return colors;
}

Rgb grey(double value) {
    return {static_cast<float>(value), static_cast<float>(value), static_cast<float>(value)};
}

Accuracy measureAll(const std::vector<Rgb>& truth, const std::vector<Rgb>& reconstruction,
                    double exposure = 1) {
    return measureAccuracy(truth, reconstruction, {}, {exposure});
}

void checkSame(const Measures& a, const Measures& b) {
    CHECK(a.deltaE == b.deltaE);
    CHECK(a.deltaE2000 == b.deltaE2000);
    CHECK(a.rmse == b.rmse);
    CHECK(a.psnr == b.psnr);
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("equal inputs have no error and a PSNR that is bounded") {
        const auto colors = ramp(100, 3);
        const Accuracy accuracy = measureAll(colors, colors);
        CHECK(accuracy.pairs == 100);
        CHECK(accuracy.stops == 0);
        for (const Measures& m : {accuracy.natural, accuracy.highlight}) {
            CHECK(m.deltaE == 0);
            CHECK(m.deltaE2000 == 0);
            CHECK(m.rmse == 0);
            CHECK(m.psnr == doctest::Approx(20 * std::log10(255e9)));
        }
    }

    TEST_CASE("a uniform offset of ten code values is an RMSE of ten and its PSNR") {
        const std::vector<Rgb> truth(9, grey(linearFromSrgb(100.0 / 255)));
        const std::vector<Rgb> shifted(9, grey(linearFromSrgb(110.0 / 255)));
        const Measures natural = measureAll(truth, shifted).natural;
        CHECK(natural.rmse == doctest::Approx(10).epsilon(1e-6));
        CHECK(natural.psnr == doctest::Approx(20 * std::log10(25.5)).epsilon(1e-6));
    }

    TEST_CASE("greys differ by their lightness alone: 116 (cbrt(Y^) - cbrt(Y))") {
        const Measures natural = measureAll({grey(0.125)}, {grey(0.216)}).natural;
        CHECK(natural.deltaE == doctest::Approx(116 * 0.1).epsilon(1e-5));
    }

    TEST_CASE("both sides are clipped to what a display shows") {
        const Accuracy accuracy = measureAll({grey(1), grey(0)}, {grey(5), grey(-1)});
        CHECK(accuracy.natural.rmse == 0);
        CHECK(accuracy.natural.deltaE == 0);
    }

    TEST_CASE("the exposure multiplies both sides of the natural measures only") {
        const auto truth = ramp(50, 0.2F);
        const auto other = ramp(50, 0.3F);
        const Accuracy exposed = measureAll(truth, other, 3);
        const auto truth3 = ramp(50, 0.2F * 3);
        const auto other3 = ramp(50, 0.3F * 3);
        CHECK(exposed.natural.deltaE ==
              doctest::Approx(measureAll(truth3, other3).natural.deltaE).epsilon(1e-6));
        checkSame(exposed.highlight, measureAll(truth, other).highlight);
    }

    TEST_CASE("the highlight exposure shows the 99.5 % quantile of all channel values as 1") {
        // Rank 0.995 * 602 = 598.99 lies among the 600 values of 0.5, just below the bright ones.
        std::vector<Rgb> truth(201, grey(0.5));
        truth.back() = grey(40);
        std::vector<Rgb> other(201, grey(0.25));
        other.back() = grey(40);
        const Measures highlight = measureAll(truth, other).highlight;
        const double code = 255 * (1 - srgbEncoded(0.5));
        CHECK(highlight.rmse == doctest::Approx(code * std::sqrt(200.0 / 201)).epsilon(1e-5));
    }

    TEST_CASE("the highlight measures and the stops do not depend on the unit of the values") {
        const Accuracy small = measureAll(ramp(300, 1e-4F), ramp(300, 1.3e-4F));
        const Accuracy large = measureAll(ramp(300, 1e3F), ramp(300, 1.3e3F));
        CHECK(small.highlight.deltaE == doctest::Approx(large.highlight.deltaE).epsilon(1e-5));
        CHECK(small.stops == doctest::Approx(large.stops).epsilon(1e-5));
    }

    TEST_CASE("twice a value is one stop where the median is far below it") {
        std::vector<Rgb> truth(10, grey(1e-6));
        std::vector<Rgb> doubled = truth;
        std::vector<std::uint8_t> mask(10, 0);
        truth[3] = grey(0.3);
        doubled[3] = grey(0.6);
        mask[3] = 1;
        CHECK(measureAccuracy(truth, doubled, mask, {}).stops == doctest::Approx(1).epsilon(1e-5));
    }

    TEST_CASE("stops take a tenth of the median as the offset, and negative values as 0") {
        const Accuracy accuracy = measureAll({grey(1), grey(1)}, {grey(2), grey(-7)});
        const double expected = (std::log2(2.1 / 1.1) + std::log2(1.1 / 0.1)) / 2;
        CHECK(accuracy.stops == doctest::Approx(expected));
    }

    TEST_CASE("a black measurement has finite measures") {
        const Accuracy accuracy = measureAll({grey(0), grey(0)}, {grey(0.5), grey(0)});
        CHECK(std::isfinite(accuracy.stops));
        CHECK(std::isfinite(accuracy.highlight.deltaE));
    }

    TEST_CASE("a mask chooses the pairs but not the exposure nor the median") {
        const auto truth = ramp(90, 2);
        auto other = truth;
        other[89] = grey(0);
        std::vector<std::uint8_t> mask(90, 1);
        mask[89] = 0;
        const Accuracy masked = measureAccuracy(truth, other, mask, {});
        CHECK(masked.pairs == 89);
        CHECK(masked.highlight.rmse == 0);

        std::fill(mask.begin(), mask.end(), std::uint8_t{1});
        checkSame(measureAccuracy(truth, other, mask, {}).highlight,
                  measureAll(truth, other).highlight);

        std::fill(mask.begin(), mask.end(), std::uint8_t{0});
        mask[89] = 1;
        CHECK(measureAccuracy(truth, other, mask, {}).highlight.rmse ==
              doctest::Approx(measureAll(truth, other).highlight.rmse * std::sqrt(90.0)));
    }

    TEST_CASE("an empty choice of pairs has zeros, never NaN") {
        const auto colors = ramp(5, 1);
        const std::vector<std::uint8_t> none(5, 0);
        for (const Accuracy& accuracy :
             {measureAccuracy(colors, colors, none, {}), measureAll({}, {})}) {
            CHECK(accuracy.pairs == 0);
            CHECK(accuracy.stops == 0);
            checkSame(accuracy.natural, Measures{});
            checkSame(accuracy.highlight, Measures{});
        }
    }

    TEST_CASE("pairs without a measurement are left out, a NaN of the reconstruction shows") {
        std::vector<Rgb> truth = ramp(4, 1);
        std::vector<Rgb> other = truth;
        truth[1] = {kNan, 0, 0};
        CHECK(measureAll(truth, other).pairs == 3);
        CHECK(measureAll(truth, other).natural.deltaE == 0);

        other[2] = {kNan, kNan, kNan};
        CHECK(std::isnan(measureAll(truth, other).natural.deltaE));
        CHECK(std::isnan(measureAll(truth, other).natural.psnr));
        CHECK(std::isnan(measureAll(truth, other).stops));
    }

    TEST_CASE("the mean of the Delta E map is the mean Delta E at its exposure") {
        const auto truth = ramp(200, 0.4F);
        const auto other = ramp(200, 0.5F);
        const std::vector<float> map = deltaEMap(truth, other, 2);
        double mean = 0;
        for (const float deltaE : map) mean += deltaE / 200.0;
        CHECK(mean == doctest::Approx(measureAll(truth, other, 2).natural.deltaE).epsilon(1e-6));
    }
}

TEST_SUITE("unit") {
    TEST_CASE("of many texels: the whole as one list, and 95 % of the texels") {
        // Texel t is off by t; the last one is unknown.
        constexpr std::size_t kTexels = 101;
        AbrdfTile truth(kTexels + 1, 2);
        AbrdfTile other(kTexels + 1, 2);
        for (std::size_t t = 0; t < kTexels; ++t) {
            for (std::size_t pair = 0; pair < 2; ++pair) {
                truth[t][pair] = grey(0.2);
                other[t][pair] = grey(0.2 + (pair == 0 ? 0.002 * static_cast<double>(t) : 0));
            }
        }
        for (Rgb& c : truth[kTexels]) c = {kNan, kNan, kNan};
        const std::vector<std::vector<std::uint8_t>> masks = {{1, 1}, {1, 0}, {0, 1}};
        const auto measures = measureTexels(truth, other, masks, {});
        const Accuracy all = measureAccuracy(truth.values(), other.values(), {}, MeasureOptions{});
        CHECK(measures[0].accuracy.pairs == 2 * kTexels);
        CHECK(measures[0].accuracy.natural.deltaE == doctest::Approx(all.natural.deltaE));
        CHECK(measures[0].accuracy.highlight.rmse == doctest::Approx(all.highlight.rmse));
        CHECK(measures[0].accuracy.stops == doctest::Approx(all.stops));
        CHECK(measures[1].deltaE == doctest::Approx(2 * measures[0].deltaE));
        CHECK(measures[2].deltaE == 0);
        const auto ofTexel = [&](std::size_t t) {
            return measureAccuracy(truth[t].first(1), other[t].first(1), {}, {}).natural;
        };
        CHECK(measures[1].deltaE95 == doctest::Approx(ofTexel(95).deltaE));
        CHECK(measures[1].psnr95 == doctest::Approx(ofTexel(95).psnr));
    }
}

TEST_SUITE("threads") {
    TEST_CASE("the measures have the same bits on one thread and on many") {
        const auto truth = ramp(10007, 1.5F);
        auto other = ramp(10007, 1.2F);
        std::reverse(other.begin(), other.begin() + 5000);
        Accuracy one;
        {
            const ThreadLimit limit(1);
            one = measureAll(truth, other);
        }
        const ThreadLimit limit(4);
        const Accuracy many = measureAll(truth, other);
        checkSame(one.natural, many.natural);
        checkSame(one.highlight, many.highlight);
        CHECK(one.stops == many.stops);
    }
}

TEST_CASE("a pair of weight two counts as two pairs, one of weight zero as none") {
    const std::vector<Rgb> truth = ramp(6, 0.9F);
    const std::vector<Rgb> other = ramp(6, 0.5F);
    const std::vector<double> weights = {0, 2, 1, 0, 1, 2};
    std::vector<Rgb> manyTruth;
    std::vector<Rgb> manyOther;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        for (int k = 0; k < static_cast<int>(weights[i]); ++k) {
            manyTruth.push_back(truth[i]);
            manyOther.push_back(other[i]);
        }
    }
    const Accuracy weighed = measureAccuracy(truth, other, {}, {1, weights});
    const Accuracy many = measureAccuracy(manyTruth, manyOther, {}, {1});
    CHECK(weighed.natural.deltaE == doctest::Approx(many.natural.deltaE));
    CHECK(weighed.natural.psnr == doctest::Approx(many.natural.psnr));
    CHECK(weighed.pairs == 4);
    AbrdfTile truths(1, truth.size());
    AbrdfTile others(1, truth.size());
    std::ranges::copy(truth, truths[0].begin());
    std::ranges::copy(other, others[0].begin());
    const std::vector<std::vector<std::uint8_t>> masks = {{1, 1, 1, 1, 1, 1}, {1, 0, 0, 1, 0, 0}};
    const auto texels = measureTexels(truths, others, masks, {1, weights});
    CHECK(texels[0].accuracy.natural.deltaE == doctest::Approx(weighed.natural.deltaE));
    CHECK(texels[1].accuracy.natural.deltaE == 0);  // All that it holds weighs nothing.
    CHECK(texels[1].accuracy.pairs == 0);
}

}  // namespace abrdf
