// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace abrdf {

/// Random numbers that are the same on every machine, which those of <random>'s distributions are
/// not. PCG32: 64 bits of state, 32 bits a number [O'Neill 2014].
class Random {
  public:
    /// Different streams of one seed are independent, so that work may be split among threads.
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

    /// Uniform over all 32-bit numbers.
    std::uint32_t next();

    /// Uniform in [0, 1), a multiple of 2^-32.
    double uniform() { return next() * 0x1p-32; }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// The logarithm is uniform; 0 < low <= high.
    double logUniform(double low, double high);

    /// Uniform among 0 .. count - 1; count >= 1.
    std::size_t below(std::size_t count);

    /// True with this probability.
    bool chance(double probability) { return uniform() < probability; }

    /// Normal with mean 0 and deviation 1, by the ratio of uniforms: the value is one division,
    /// and the logarithm only decides whether it is taken, so that a last bit of libm cannot show.
    double normal();

  private:
    std::uint64_t state_;
    std::uint64_t increment_;
};

/// A number that looks random and depends on all of `numbers` and their order (splitmix64).
std::uint64_t hashOf(std::initializer_list<std::uint64_t> numbers);

/// The hash as a number in [0, 1).
constexpr double uniformFromHash(std::uint64_t hash) {
    return static_cast<double>(hash >> 11) * 0x1p-53;
}

}  // namespace abrdf
