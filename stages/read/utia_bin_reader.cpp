// SPDX-License-Identifier: BSD-3-Clause
//
// UTIA BRDF .bin: 288 x 288 little-endian doubles, three planes R G B; rows light, columns view. No
// header: it is known by its size and by numbers that a reflectance can have.
#include "stages/read/byte_cursor.h"
#include "stages/read/mapped_file.h"
#include "stages/read/utia_brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace abrdf {

namespace {

constexpr std::size_t kPairs = std::size_t{288} * 288;
constexpr std::size_t kBytes = 3 * kPairs * sizeof(double);

std::uint64_t swappedBytes(std::uint64_t bits) {
    return __builtin_bswap64(bits);
}

/// True where all of the first numbers are 0 or of a size that light has.
bool areReflectances(std::string_view head, bool bigEndian) {
    const std::size_t count = head.size() / sizeof(std::uint64_t);
    bool anyNonzero = false;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, head.data() + i * sizeof bits, sizeof bits);
        const auto value = std::bit_cast<double>(bigEndian ? swappedBytes(bits) : bits);
        if (value != 0 && !(std::abs(value) > 1e-12 && std::abs(value) < 1e6)) return false;
        anyNonzero = anyNonzero || value != 0;
    }
    return count > 0 && anyNonzero;
}

bool isBin(const DatabasePath& path) {
    std::string name = path.name();
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name.ends_with(".bin");
}

}  // namespace

bool recognizesUtiaBin(const DatabasePath& path) {
    if (path.files) return false;
    const bool numbers = areReflectances(path.head, false) || areReflectances(path.head, true);
    return path.size == kBytes ? numbers || isBin(path) : numbers && isBin(path);
}

std::unique_ptr<BtfReader> makeUtiaBinReader(const DatabasePath& path) {
    const MappedFile map(path.path);
    ByteCursor file(map.bytes(), path.path.string());
    if (map.bytes().size() != kBytes) {
        file.fail(fmt::format("it has {} bytes, a UTIA BRDF of 288 x 288 x 3 doubles {}",
                              map.bytes().size(), kBytes));
    }
    if (!areReflectances(path.head, false) && areReflectances(path.head, true)) {
        file.fail("its doubles are big-endian, and UTIA's files are little-endian");
    }
    const auto numbers = file.numbers<double>(3 * kPairs, "doubles");
    map.checkWhole();
    std::vector<std::array<double, 3>> stored(kPairs);
    for (std::size_t pair = 0; pair < kPairs; ++pair) {
        for (std::size_t c = 0; c < 3; ++c) stored[pair][c] = numbers[c * kPairs + pair];
    }
    return makeUtiaBrdfReader(path, "UTIA BRDF .bin", stored);
}

}  // namespace abrdf
