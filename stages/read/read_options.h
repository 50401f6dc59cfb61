// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/utia_encoding.h"
#include "stages/read/read_limits.h"

#include <optional>
#include <string>

namespace abrdf {

/// What only the user can say of a database.
struct ReadOptions {
    std::string pattern;  ///< The images' names, as "view_{tv}_{pv}/light_{tl}_{pl}.exr"; or empty.
    std::optional<UtiaEncoding> utiaEncoding;  ///< Of UTIA BRDF files; else told from the values.
    ReadLimits limits;
};

}  // namespace abrdf
