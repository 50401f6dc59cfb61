// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/angle_keys.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abrdf {

/// A user's own convention of names: "view_{tv}_{pv}/light_{tl}_{pl}.exr". {tl} {pl} {tv} {pv}
/// stand for numbers in degrees, * for any characters but '/'. The pattern must fit from a folder's
/// beginning to the end of the name, so that folders above do not matter.
class NamePattern {
  public:
    /// Throws std::invalid_argument where one of the four keys is absent, double or unknown.
    explicit NamePattern(const std::string& text);

    /// Nothing where the name does not fit.
    std::optional<AngleKeys> match(std::string_view path) const;

  private:
    struct Part {
        std::string literal;               ///< Text; or empty, then a key or anything:
        double AngleKeys::*key = nullptr;  ///< Null: any characters but '/'.

        bool isAnything() const { return literal.empty() && key == nullptr; }
    };

    std::optional<AngleKeys> matchWhole(std::string_view name) const;

    /// Characters that the part takes from the beginning of `rest`; nothing where it does not fit.
    static std::optional<std::size_t> matchPart(const Part& part, std::string_view rest,
                                                AngleKeys& keys);

    std::vector<Part> parts_;
};

}  // namespace abrdf
