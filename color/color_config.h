// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abrdf {

/// One conversion between two colour spaces, ready to run; safe to use from many threads at once.
class ColorTransform {
  public:
    /// True where the spaces are the same: apply() changes nothing.
    bool isIdentity() const;

    /// True where each output channel depends on its own input channel alone, so that a table
    /// of one value a code (a 256-entry one for 8-bit images) says all.
    bool isPerChannel() const;

    /// Converts packed colours in place.
    void apply(std::span<Rgb> colors) const;

  private:
    friend class ColorConfig;
    struct Processor;
    std::shared_ptr<const Processor> processor_;
};

/// An OpenColorIO config, loaded once; the only source of colour conversions.
class ColorConfig {
  public:
    /// Precedence: `file` (--colorconfig), then $OCIO, then the shipped config.
    /// Throws std::runtime_error, naming the config, where the chosen one does not load:
    /// there is no silent fallback.
    static ColorConfig load(const std::optional<std::filesystem::path>& file = {});

    /// Where it came from, for messages and reports: a file's path, or "shipped".
    const std::string& origin() const { return origin_; }

    /// The full name of the space called `nameOrRole` (a name, an alias or a role).
    /// Throws std::runtime_error that lists the config's spaces where there is none.
    std::string spaceName(const std::string& nameOrRole) const;

    /// Names of all colour spaces, in the config's order.
    std::vector<std::string> spaceNames() const;

    /// The transform between two named spaces, aliases or roles. Throws as spaceName().
    ColorTransform transform(const std::string& from, const std::string& to) const;

    /// Names under which the config knows `name`: the name itself and its aliases.
    std::vector<std::string> aliases(const std::string& name) const;

  private:
    struct Loaded;
    std::shared_ptr<const Loaded> loaded_;
    std::string origin_;
};

/// The text of color/config.ocio, built into the program.
std::string_view shippedColorConfig();

}  // namespace abrdf
