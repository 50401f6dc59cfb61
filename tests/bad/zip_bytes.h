// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// A member of an archive, and what the archive claims of it.
struct ZipMember {
    std::string name;
    std::string bytes;
    bool deflate = false;
    std::optional<std::uint32_t> claimedSize = {};  ///< Unpacked; else the true one.
    std::optional<std::uint32_t> claimedCrc = {};
    std::uint16_t flags = 0;   ///< 1: encrypted.
    std::uint16_t method = 0;  ///< Where not 0, said in place of stored or deflated.
};

/// An archive that libzip would not write: names and sizes are taken as they are.
std::string zipBytes(const std::vector<ZipMember>& members);

}  // namespace abrdf
