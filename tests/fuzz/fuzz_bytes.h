// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

namespace abrdf {

/// Takes numbers out of a fuzzer's bytes; zeros after their end.
class FuzzBytes {
  public:
    explicit FuzzBytes(std::span<const char> bytes) : bytes_(bytes) {}

    bool isEmpty() const { return bytes_.empty(); }

    /// Any bits.
    template <typename T>
    T any() {
        T value{};
        const std::size_t count = std::min(bytes_.size(), sizeof value);
        if (count > 0) std::memcpy(&value, bytes_.data(), count);
        bytes_ = bytes_.subspan(count);
        return value;
    }

    /// first .. last.
    int between(int first, int last) { return first + any<std::uint8_t>() % (last - first + 1); }

    /// Of any bits; NaN and infinity too.
    double number() { return static_cast<double>(any<float>()); }

    /// Finite and not negative: what samples are.
    float light() {
        const float value = std::abs(any<float>());
        return std::isfinite(value) ? value : 0;
    }

    /// An angle from 0 up to `end`, in 256 steps.
    double angle(double end) { return end * any<std::uint8_t>() / 256.0; }

  private:
    std::span<const char> bytes_;
};

}  // namespace abrdf
