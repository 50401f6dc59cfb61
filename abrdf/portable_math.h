// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Elementary functions of floats from arithmetic and sqrt alone: the same bits with every libm,
/// and short enough for the compiler to inline. Polynomials of [Cephes]; relative errors, or
/// absolute ones near a zero, are a few 1e-7.
namespace abrdf::portable {

inline int roundedToInt(float x) {
    return static_cast<int>(x + std::copysign(0.5F, x));
}

inline constexpr float kLeastExponent = -87;
inline constexpr float kLargestExponent = 88;

/// e^x, with x bounded to -87 .. 88.
inline float exp(float x) {
    x = x > kLeastExponent ? x : kLeastExponent;
    x = x < kLargestExponent ? x : kLargestExponent;
    // e^x = 2^n e^r, |r| <= ln(2) / 2; ln(2) in two parts, the first one exact in n ln(2).
    const int n = roundedToInt(x * 1.44269504F);
    const auto nf = static_cast<float>(n);
    const float r = (x - nf * 0.693359375F) + nf * 2.12194440e-4F;
    float p = 1.9875691500e-4F;
    p = p * r + 1.3981999507e-3F;
    p = p * r + 8.3334519073e-3F;
    p = p * r + 4.1665795894e-2F;
    p = p * r + 1.6666665459e-1F;
    p = p * r + 5.0000001201e-1F;
    return (p * r * r + r + 1) * std::bit_cast<float>((n + 127) << 23);
}

/// Natural logarithm of a normal x > 0.
inline float log(float x) {
    // x = 2^n m, m from sqrt(1/2) to sqrt(2).
    const auto bits = std::bit_cast<std::int32_t>(x);
    const int n = (bits - 0x3f3504f3) >> 23;
    const float f = std::bit_cast<float>(bits - n * (1 << 23)) - 1;
    const auto nf = static_cast<float>(n);
    float p = 7.0376836292e-2F;
    p = p * f - 1.1514610310e-1F;
    p = p * f + 1.1676998740e-1F;
    p = p * f - 1.2420140846e-1F;
    p = p * f + 1.4249322787e-1F;
    p = p * f - 1.6668057665e-1F;
    p = p * f + 2.0000714765e-1F;
    p = p * f - 2.4999993993e-1F;
    p = p * f + 3.3333331174e-1F;
    const float f2 = f * f;
    return f + (p * f * f2 - nf * 2.12194440e-4F - 0.5F * f2) + nf * 0.693359375F;
}

/// x^y for a normal x > 0.
inline float pow(float x, float y) {
    return exp(y * log(x));
}

/// Cosine of |x| < 1e4.
inline float cos(float x) {
    // x = n pi/2 + r, |r| <= pi/4; pi/2 in three parts.
    const int n = roundedToInt(x * 0.636619772F);
    const auto nf = static_cast<float>(n);
    const float r = ((x - nf * 1.5703125F) - nf * 4.837512969970703125e-4F) - nf * 7.54978995e-8F;
    const float r2 = r * r;
    const float sine = ((-1.9515295891e-4F * r2 + 8.3321608736e-3F) * r2 - 1.6666654611e-1F) * r2;
    const float cosine =
        ((2.443315711809948e-5F * r2 - 1.388731625493765e-3F) * r2 + 4.166664568298827e-2F) * r2;
    // Both are worked out, so that compilers make vectors of this.
    const float odd = r + r * sine;
    const float even = 1 - 0.5F * r2 + cosine * r2;
    const float value = (n & 1) != 0 ? odd : even;
    const float negated = -value;
    return ((n + 1) & 2) != 0 ? negated : value;
}

/// Arc sine of x, bounded to -1 .. 1.
inline float asin(float x) {
    const float size = std::fabs(x) < 1 ? std::fabs(x) : 1.0F;
    // Past 1/2: asin(x) = pi/2 - 2 asin(sqrt((1 - x) / 2)).
    const bool large = size > 0.5F;
    const float z = large ? 0.5F * (1 - size) : size * size;
    const float s = large ? std::sqrt(z) : size;
    float p = 4.2163199048e-2F;
    p = p * z + 2.4181311049e-2F;
    p = p * z + 4.5470025998e-2F;
    p = p * z + 7.4953002686e-2F;
    p = p * z + 1.6666752422e-1F;
    const float arc = s + s * z * p;
    return std::copysign(large ? 1.57079633F - 2 * arc : arc, x);
}

}  // namespace abrdf::portable
