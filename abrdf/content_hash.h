// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace abrdf {

/// A number that tells whether bytes are the same as before: fast, the same on every machine, and
/// no protection against somebody who wants to deceive.
std::uint64_t contentHash(std::span<const char> bytes, std::uint64_t seed = 0);

}  // namespace abrdf
