// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/photograph_reader.h"

#include <optional>
#include <string_view>
#include <vector>

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

/// The number at the beginning of `text`: "-7.5.exr" -> -7.5 and the 4 characters it takes. It ends
/// before a dot that no digit follows.
struct NumberInName {
    double value = 0;
    std::size_t length = 0;
};
std::optional<NumberInName> numberAtBegin(std::string_view text);

/// All images of `files` whose names have the four keys.
std::vector<Photograph> photographsNamedByAngles(const FileSource& files);

/// The first of them, without going through all: what databases are recognized by.
std::optional<std::size_t> firstNamedByAngles(const FileSource& files);

}  // namespace abrdf
