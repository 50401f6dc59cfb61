// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace abrdf {

/// What the databases write into file names: tl pl (light) and tv pv (view), theta and phi in
/// degrees, whole or decimal.
struct AngleKeys {
    double tl = 0;
    double pl = 0;
    double tv = 0;
    double pv = 0;
};

/// Finds the four keys in any order, each followed by its number, as in
/// "tv015_pv060/00123 tl030 pl090 tv015 pv060.jpg". The last one of a kind counts, so that the
/// file's own name is stronger than its folder's. Nothing where one of the four is absent.
std::optional<AngleKeys> angleKeysFromName(std::string_view path);

}  // namespace abrdf
