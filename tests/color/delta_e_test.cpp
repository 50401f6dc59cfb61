// SPDX-License-Identifier: BSD-3-Clause
#include "color/delta_e.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace abrdf {

namespace {

struct Pair {
    Lab first, second;
    double deltaE;
};

// Sharma, Wu, Dalal 2005, table 1: made to find out where implementations go wrong.
constexpr std::array kSharma{
    Pair{{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    Pair{{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    Pair{{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    Pair{{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    Pair{{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    Pair{{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    Pair{{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    Pair{{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    Pair{{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    Pair{{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    Pair{{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    Pair{{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    Pair{{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    Pair{{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    Pair{{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    Pair{{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    Pair{{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    Pair{{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    Pair{{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    Pair{{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    Pair{{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    Pair{{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    Pair{{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    Pair{{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    Pair{{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    Pair{{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    Pair{{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    Pair{{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    Pair{{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    Pair{{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    Pair{{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    Pair{{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    Pair{{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    Pair{{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

bool near(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance;
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("CIEDE2000 gives the published value for each of Sharma's pairs, either way round") {
        for (std::size_t i = 0; i < kSharma.size(); ++i) {
            CAPTURE(i);
            const auto& [first, second, expected] = kSharma[i];
            CHECK(near(deltaE2000(first, second), expected, 0.5001e-4));
            CHECK(near(deltaE2000(second, first), expected, 0.5001e-4));
        }
    }

    TEST_CASE("a colour does not differ from itself") {
        for (const auto& [first, second, expected] : kSharma) {
            CHECK(deltaE76(first, first) == 0);
            CHECK(deltaE2000(second, second) == 0);
        }
    }

    TEST_CASE("the CIE 1976 difference is the Euclidean distance") {
        CHECK(deltaE76({50, 1, 2}, {52, 4, 8}) == 7);
    }

    TEST_CASE("black and white are 100 apart by both formulas") {
        const Lab white = labFromLinearRec709({1, 1, 1});
        const Lab black = labFromLinearRec709({0, 0, 0});
        CHECK(near(deltaE76(black, white), 100, 1e-12));
        CHECK(near(deltaE2000(black, white), 100, 1e-9));
    }

    TEST_CASE("white has L = 100 and no chroma, and no grey has any") {
        const Lab white = labFromLinearRec709({1, 1, 1});
        CHECK(white.L == 100);
        CHECK(white.a == 0);
        CHECK(white.b == 0);
        for (const float grey : {0.001F, 0.01F, 0.18F, 0.5F}) {
            const Lab lab = labFromLinearRec709({grey, grey, grey});
            CHECK(near(lab.a, 0, 1e-12));
            CHECK(near(lab.b, 0, 1e-12));
        }
        CHECK(near(labFromLinearRec709({0.18F, 0.18F, 0.18F}).L, 49.4961, 1e-4));
    }

    TEST_CASE("the sRGB primaries have the Lab coordinates of the standard's matrix") {
        const Lab red = labFromLinearRec709({1, 0, 0});
        CHECK(near(red.L, 53.2329, 1e-4));
        CHECK(near(red.a, 80.1053, 1e-4));
        CHECK(near(red.b, 67.2228, 1e-4));
        // Matrices of more digits give nearly the same: 32.30, 79.19, -107.86.
        const Lab blue = labFromLinearRec709({0, 0, 1});
        CHECK(near(blue.L, 32.30, 0.02));
        CHECK(near(blue.a, 79.19, 0.02));
        CHECK(near(blue.b, -107.86, 0.02));
    }

    TEST_CASE("colours beyond the display count as clipped") {
        CHECK(deltaE76(labFromLinearRec709({7, -1, 0.5F}), labFromLinearRec709({1, 0, 0.5F})) == 0);
    }

    TEST_CASE("the sRGB curve and its inverse undo each other and meet the standard's values") {
        for (int code = 0; code <= 255; ++code) {
            const double encoded = code / 255.0;
            CHECK(near(srgbEncoded(linearFromSrgb(encoded)), encoded, 1e-9));
        }
        CHECK(srgbEncoded(0) == 0);
        CHECK(near(srgbEncoded(1), 1, 1e-15));
        CHECK(srgbEncoded(-3) == 0);
        CHECK(srgbEncoded(42) == srgbEncoded(1));
        CHECK(near(linearFromSrgb(0.5), 0.21404114048223255, 1e-15));
        CHECK(near(linearFromSrgb(10 / 255.0), 10 / 255.0 / 12.92, 1e-18));
    }
}

}  // namespace abrdf
