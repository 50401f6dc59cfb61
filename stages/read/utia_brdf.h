// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/table_reader.h"

#include <array>
#include <vector>

namespace abrdf {

/// The reader of a UTIA BRDF, whatever file it comes from: 288 x 288 colours, rows light, columns
/// view, as stored; negative ones are kept in description's counts and read as 0. The encoding is
/// that of the options, else told from the values; whether cos(theta_i) is in them is told from
/// their reciprocity, and kept is assumed where that does not tell.
std::unique_ptr<BtfReader> makeUtiaBrdfReader(const DatabasePath& path, const char* format,
                                              const std::vector<std::array<double, 3>>& stored);

}  // namespace abrdf
