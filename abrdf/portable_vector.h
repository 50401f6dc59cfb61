// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/portable_math.h"

#include <cstddef>
#include <cstdint>

/// portable_math.h for whole registers: the same operations in the same order, so the same bits.
/// For loops that compilers leave scalar. All of it is inline: it has the registers of its caller.
namespace abrdf::portable {

/// So many bytes of floats: one register, or several that are worked on together.
template <std::size_t kBytes>
struct Vector {
    using Float [[gnu::vector_size(kBytes)]] = float;
    using Int [[gnu::vector_size(kBytes)]] = std::int32_t;
    using Stored [[gnu::vector_size(kBytes), gnu::aligned(alignof(float)), gnu::may_alias]] = float;
    static constexpr std::size_t kCount = kBytes / sizeof(float);

    Float v;

    [[gnu::always_inline]] static Vector all(float x) { return {Float{} + x}; }
    [[gnu::always_inline]] static Vector at(const float* x) {
        return {*reinterpret_cast<const Stored*>(x)};
    }
    [[gnu::always_inline]] void store(float* x) const { *reinterpret_cast<Stored*>(x) = v; }
};

/// a > b ? a : b, and a < b ? a : b, as one instruction does them: of a NaN, b.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> larger(const Vector<kBytes>& a,
                                                    const Vector<kBytes>& b) {
    return {a.v > b.v ? a.v : b.v};
}
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> smaller(const Vector<kBytes>& a,
                                                     const Vector<kBytes>& b) {
    return {a.v < b.v ? a.v : b.v};
}

/// portable_math.h's exp() of values within its bounds, in place. Step by step for all: one value's
/// steps wait for one another, and a processor looks only so far ahead for others.
template <std::size_t kBytes, std::size_t kVectors>
[[gnu::always_inline]] inline void takeBoundedExp(Vector<kBytes> (&x)[kVectors]) {
    using Int = typename Vector<kBytes>::Int;
    using Float = typename Vector<kBytes>::Float;
    Int power[kVectors];
    Float p[kVectors];
    for (std::size_t i = 0; i < kVectors; ++i) {
        const Float turns = x[i].v * 1.44269504F;
        const Int half = (reinterpret_cast<Int>(turns) & INT32_MIN) | 0x3f000000;
        power[i] = __builtin_convertvector(turns + reinterpret_cast<Float>(half), Int);
    }
    for (std::size_t i = 0; i < kVectors; ++i) {
        const Float n = __builtin_convertvector(power[i], Float);
        power[i] = (power[i] + 127) << 23;
        x[i].v = (x[i].v - n * 0.693359375F) + n * 2.12194440e-4F;
    }
    for (std::size_t i = 0; i < kVectors; ++i) p[i] = x[i].v * 1.9875691500e-4F + 1.3981999507e-3F;
    constexpr float kFactors[] = {8.3334519073e-3F, 4.1665795894e-2F, 1.6666665459e-1F,
                                  5.0000001201e-1F};
    for (const float c : kFactors) {
        for (std::size_t i = 0; i < kVectors; ++i) p[i] = p[i] * x[i].v + c;
    }
    for (std::size_t i = 0; i < kVectors; ++i) p[i] = p[i] * x[i].v * x[i].v + x[i].v + 1;
    for (std::size_t i = 0; i < kVectors; ++i) x[i].v = p[i] * reinterpret_cast<Float>(power[i]);
}

/// portable_math.h's.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> exp(const Vector<kBytes>& value) {
    using V = Vector<kBytes>;
    V x[] = {smaller(larger(value, V::all(kLeastExponent)), V::all(kLargestExponent))};
    takeBoundedExp(x);
    return x[0];
}

/// portable_math.h's.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> log(const Vector<kBytes>& x) {
    using V = Vector<kBytes>;
    const auto bits = reinterpret_cast<typename V::Int>(x.v);
    const auto n = (bits - 0x3f3504f3) >> 23;
    const auto f = reinterpret_cast<typename V::Float>(bits - (n << 23)) - 1;
    const auto nf = __builtin_convertvector(n, typename V::Float);
    auto p = f * 7.0376836292e-2F - 1.1514610310e-1F;
    p = p * f + 1.1676998740e-1F;
    p = p * f - 1.2420140846e-1F;
    p = p * f + 1.4249322787e-1F;
    p = p * f - 1.6668057665e-1F;
    p = p * f + 2.0000714765e-1F;
    p = p * f - 2.4999993993e-1F;
    p = p * f + 3.3333331174e-1F;
    const auto f2 = f * f;
    return {f + (p * f * f2 - nf * 2.12194440e-4F - 0.5F * f2) + nf * 0.693359375F};
}

}  // namespace abrdf::portable
