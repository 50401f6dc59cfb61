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

/// How a picture is to be shown, by names of the config.
struct DisplayView {
    std::string display;  ///< Empty: the config's default display.
    std::string view;     ///< Empty: the display's default view for the space that is shown.
    std::string look;     ///< Looks with commas, as OpenColorIO takes them; empty: the view's own.

    bool operator==(const DisplayView&) const = default;
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

    /// True where spaceName() has an answer.
    bool has(const std::string& nameOrRole) const;

    /// Names of all colour spaces, in the config's order.
    std::vector<std::string> spaceNames() const;

    /// True where transform() knows `name`: a space, alias or role of the config, or, in a config
    /// with the role aces_interchange, one of the known spaces (color/known_space.h), which come
    /// over that bridge from the shipped config.
    bool reaches(const std::string& name) const;

    /// The transform between two spaces that are reached. Throws as spaceName().
    ColorTransform transform(const std::string& from, const std::string& to) const;

    /// Names under which the config knows `name`: the name itself and its aliases.
    std::vector<std::string> aliases(const std::string& name) const;

    /// True for a space of data (angles, weights), whose values are never converted.
    bool isData(const std::string& name) const;

    /// Active displays, the views of one (active first), and looks, in the config's order.
    std::vector<std::string> displayNames() const;
    std::vector<std::string> viewNames(const std::string& display) const;
    std::vector<std::string> lookNames() const;

    /// `wanted` with the config's own names, defaults filled in for a picture in space `from`.
    /// Throws std::runtime_error that lists near names where a display, view or look is unknown.
    DisplayView resolved(const DisplayView& wanted, const std::string& from) const;

    /// Name and aliases of the space in which such a picture is encoded: "sRGB - Display".
    /// The space is of data for a view that leaves values as they are. Throws as resolved().
    std::vector<std::string> encodedSpace(const DisplayView& shown, const std::string& from) const;

    /// From space `from` to the codes of a display, 0 .. 1. Throws as resolved(), and where `from`
    /// is a space of data: there is nothing to show in angles and weights.
    ColorTransform displayTransform(const std::string& from, const DisplayView& shown) const;

  private:
    struct Loaded;

    std::shared_ptr<const Loaded> loaded_;
    std::string origin_;
};

/// The text of color/config.ocio, built into the program.
std::string_view shippedColorConfig();

}  // namespace abrdf
