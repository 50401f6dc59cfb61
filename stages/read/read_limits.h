// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace abrdf {

/// How much a database may make the program take for one of its files, whatever headers declare:
/// checked before memory is taken.
struct ReadLimits {
    std::uint64_t imagePixels = std::uint64_t{1} << 26;  ///< Of one image; 8192 x 8192.
    std::uint64_t fileBytes = std::uint64_t{1} << 30;    ///< Of one image file, unpacked.
};

}  // namespace abrdf
