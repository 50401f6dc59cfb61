// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/btf_reader.h"
#include "stages/read/database_path.h"

#include <memory>

namespace abrdf {

/// What the readers of tabulated BRDFs start from: ubo81 for a grid, all pairs present, linear
/// Rec.709, the cosine put into the values by the reader.
BtfDescription tableDescription(const DatabasePath& path, const char* format);

/// The reader that all tabulated BRDFs share: "images" of 1 x 1 at the pairs of description.grid.
std::unique_ptr<BtfReader> makeTableReader(const DatabasePath& path, BtfDescription description,
                                           std::unique_ptr<const BrdfTable> table);

}  // namespace abrdf
