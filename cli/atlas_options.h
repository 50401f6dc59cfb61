// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_layout.h"
#include "pipeline/convert/convert.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace abrdf {

/// How an atlas is written, as text until the command runs.
struct AtlasOptions {
    std::string layout = "angular";
    PixelChoice pixel = PixelChoice::kAuto;
    std::string compression = "zip";
    std::string outputSpace;
    std::string cosine = "keep";

    /// Into the job, ConvertOptions or ExpandOptions. Throws std::invalid_argument for names that
    /// are not known.
    template <typename Job>
    void giveTo(Job& job) const {
        job.layout = atlasKindFromName(layout);
        job.pixel = pixel;
        job.compression = compressionFromName(compression);
        job.outputSpace = outputSpace;
        job.divideCosine = cosine == "divide";
    }
};

/// --layout, --pixel, --compression, --output-space and --cosine. layouts, spaces: what the help
/// says of the two whose choices differ from command to command.
void addAtlasOptions(CLI::App& command, AtlasOptions& options, const std::string& layouts,
                     const std::string& spaces);

/// -o for commands whose output is an atlas.
void addAtlasOutput(CLI::App& command, std::filesystem::path& output);

}  // namespace abrdf
