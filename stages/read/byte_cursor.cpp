// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/byte_cursor.h"

#include <fmt/format.h>
#include <half.h>

#include <stdexcept>

namespace abrdf {

namespace {

template <typename T>
std::vector<float> converted(std::span<const char> bytes) {
    std::vector<float> values(bytes.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) {
        T value;
        std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
        values[i] = static_cast<float>(value);
    }
    return values;
}

}  // namespace

void ByteCursor::seek(std::uint64_t place) {
    if (place > bytes_.size()) {
        fail(fmt::format("its header points to byte {} of {}", place, bytes_.size()));
    }
    place_ = static_cast<std::size_t>(place);
}

std::span<const char> ByteCursor::take(std::uint64_t count, const char* what) {
    if (count > left()) failCut(count, 1, what);
    const auto taken = bytes_.subspan(place_, static_cast<std::size_t>(count));
    place_ += static_cast<std::size_t>(count);
    return taken;
}

std::vector<float> ByteCursor::floats(std::uint64_t count, unsigned scalarBytes, const char* what) {
    if (scalarBytes != 2 && scalarBytes != 4 && scalarBytes != 8) {
        fail(fmt::format("its {} are of {} bytes a number, not of 2, 4 or 8", what, scalarBytes));
    }
    if (count > left() / scalarBytes) failCut(count, scalarBytes, what);
    const auto bytes = take(count * scalarBytes, what);
    if (scalarBytes == 2) return converted<Imath::half>(bytes);
    if (scalarBytes == 4) return converted<float>(bytes);
    return converted<double>(bytes);
}

void ByteCursor::fail(std::string_view why) const {
    throw std::runtime_error(fmt::format("{}: is damaged or cut: {}; fetch it again", name_, why));
}

void ByteCursor::failCut(std::uint64_t count, std::size_t size, const char* what) const {
    fail(fmt::format("it declares {} x {} bytes of {} at byte {}, and has {} bytes left", count,
                     size, what, place_, left()));
}

std::uint64_t boundedProduct(std::uint64_t a, std::uint64_t b, std::uint64_t limit) {
    if (a == 0 || b == 0) return 0;
    return a > limit / b ? limit + 1 : a * b;
}

}  // namespace abrdf
