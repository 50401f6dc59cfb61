// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace abrdf {

/// Whether cos(theta_i) is in the values.
enum class Cosine { kKept, kDivided, kAbsent };

/// "kept", "divided" or "absent"; the inverse throws std::invalid_argument for other names.
std::string nameOf(Cosine cosine);
Cosine cosineFromName(const std::string& name);

}  // namespace abrdf
