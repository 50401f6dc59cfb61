// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace abrdf {

/// The names nearest to what was typed, best first, at most three and at most one a thing; none
/// where all have too little in common with it. known: for each thing all its names.
std::vector<std::string> nearNames(const std::string& typed,
                                   const std::vector<std::vector<std::string>>& known);

/// True where the names differ in nothing but the case of ASCII letters.
bool sameLetters(const std::string& a, const std::string& b);

}  // namespace abrdf
