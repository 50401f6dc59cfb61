// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace abrdf {

static_assert(std::endian::native == std::endian::little, "the databases are little-endian");

/// Walks through the bytes of a binary file, and never past their end.
class ByteCursor {
  public:
    /// `name` stands in messages.
    ByteCursor(std::span<const char> bytes, std::string name)
        : bytes_(bytes), name_(std::move(name)) {}

    std::size_t place() const { return place_; }
    std::size_t left() const { return bytes_.size() - place_; }
    const std::string& name() const { return name_; }

    /// Throws where `place` lies past the end.
    void seek(std::uint64_t place);

    /// The next `count` bytes; `what` they are, for the message where the file ends before.
    std::span<const char> take(std::uint64_t count, const char* what);

    template <typename T>
    T number(const char* what) {
        static_assert(std::is_trivially_copyable_v<T>);
        T value;
        std::memcpy(&value, take(sizeof value, what).data(), sizeof value);
        return value;
    }

    std::uint32_t u32(const char* what) { return number<std::uint32_t>(what); }
    float f32(const char* what) { return number<float>(what); }

    /// `count` little-endian numbers, checked against the file's size before memory is taken.
    template <typename T>
    std::vector<T> numbers(std::uint64_t count, const char* what) {
        if (count > left() / sizeof(T)) failCut(count, sizeof(T), what);
        std::vector<T> values(count);
        const auto source = take(count * sizeof(T), what);
        if (count > 0) std::memcpy(values.data(), source.data(), source.size());
        return values;
    }

    /// `count` scalars of 2 (half), 4 or 8 bytes each, as floats.
    std::vector<float> floats(std::uint64_t count, unsigned scalarBytes, const char* what);

    /// Throws std::runtime_error: "NAME: is not a whole ...: `why`".
    [[noreturn]] void fail(std::string_view why) const;

  private:
    [[noreturn]] void failCut(std::uint64_t count, std::size_t size, const char* what) const;

    std::span<const char> bytes_;
    std::size_t place_ = 0;
    std::string name_;
};

/// a * b, where it is at most `limit`; else limit + 1, so that no product of a lying header wraps.
std::uint64_t boundedProduct(std::uint64_t a, std::uint64_t b, std::uint64_t limit);

}  // namespace abrdf
