// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/random.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace abrdf {

namespace {

// [Steele, Lea, Flood 2014], the finaliser of splitmix64: a bijection of 64 bits.
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(hashOf({seed, stream})), increment_(2 * stream + 1) {
    next();
}

std::uint32_t Random::next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005U + increment_;
    const auto xorshifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    return std::rotr(xorshifted, static_cast<int>(old >> 59));
}

double Random::logUniform(double low, double high) {
    assert(low > 0 && low <= high);
    return low * std::exp(uniform() * std::log(high / low));
}

std::size_t Random::below(std::size_t count) {
    assert(count >= 1);
    // The product's upper half [Lemire 2019]; its bias, count / 2^32, is of no importance here.
    return static_cast<std::size_t>((std::uint64_t{next()} * count) >> 32);
}

double Random::normal() {
    // [Kinderman, Monahan 1977]: v / u is normal where v^2 <= -4 u^2 ln u; |v| <= sqrt(2 / e).
    constexpr double kLargestV = 0.857763884960706796;
    while (true) {
        const double u = 1 - uniform();  // in (0, 1]
        const double v = uniform(-kLargestV, kLargestV);
        const double ratio = v / u;
        if (ratio * ratio <= -4 * std::log(u)) return ratio;
    }
}

std::uint64_t hashOf(std::initializer_list<std::uint64_t> numbers) {
    std::uint64_t hash = 0;
    for (const std::uint64_t number : numbers) {
        hash = mixed((hash ^ mixed(number)) + 0x9e3779b97f4a7c15U);
    }
    return hash;
}

}  // namespace abrdf
