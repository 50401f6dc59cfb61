// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "color/color_config.h"
#include "stages/read/btf_reader.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace abrdf {

enum class MissingImages {
    kError,  ///< A needed image that is absent ends the job.
    kFill,   ///< It is interpolated from its neighbours, and counted.
};

/// What every job on a database says of its input.
struct InputOptions {
    std::filesystem::path input;
    std::optional<std::filesystem::path> colorConfig;  ///< Else $OCIO, else the shipped config.
    std::string inputSpace;  ///< OpenColorIO name; empty: the database's own convention.
    MissingImages missing = MissingImages::kError;
    MessageSink warn;  ///< Told of what goes on though it should not be.
    ReadOptions read;
};

/// Spatial resolution of a job; 0 x 0 stands for every texel of the images.
struct Texels {
    int width = 1;
    int height = 1;

    std::size_t count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

/// "WxH" or "full". Throws std::invalid_argument.
Texels texelsFromName(const std::string& name);

/// A database that is open and checked, with the colours' way in.
struct OpenedInput {
    std::unique_ptr<BtfReader> reader;
    ColorConfig colors;
    std::string inputSpace;  ///< The config's own name of it.
    MissingImages missing = MissingImages::kError;
    MessageSink warn;

    /// True where the images hold codes of few bits, not light.
    bool hasCodes() const;
    const BtfDescription& description() const { return reader->description(); }
};

/// Throws std::runtime_error for anything that cannot be used: no database, two images for a pair,
/// a colour space that the config lacks.
OpenedInput openInput(const InputOptions& options);

/// Replaces 0 x 0 by the images' size; throws std::invalid_argument for more texels than pixels.
Texels resolvedTexels(Texels texels, const BtfDescription& description);

}  // namespace abrdf
