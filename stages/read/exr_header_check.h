// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

namespace abrdf {

/// True where bytes begin as an OpenEXR file does.
bool beginsAsExr(std::span<const char> bytes);

/// OpenEXR takes memory for whatever a header declares before it looks for the data: an attribute
/// of a gigabyte, a tile of any size. Throws std::runtime_error, naming `name`, for a header that
/// runs past the end of the file or whose attributes, chunks or tables are beyond all that a file
/// of this size can hold.
void checkExrHeader(std::span<const char> bytes, const std::string& name);

}  // namespace abrdf
