// SPDX-License-Identifier: BSD-3-Clause
#include "cli/atlas_options.h"

#include <map>

namespace abrdf {

void addAtlasOptions(CLI::App& command, AtlasOptions& options, const std::string& layouts,
                     const std::string& spaces) {
    command.add_option("--layout", options.layout, layouts)->capture_default_str();
    const std::map<std::string, PixelChoice> pixels = {
        {"auto", PixelChoice::kAuto}, {"half", PixelChoice::kHalf}, {"float", PixelChoice::kFloat}};
    command.add_option("--pixel", options.pixel, "auto | half | float")
        ->transform(CLI::CheckedTransformer(pixels));
    command.add_option("--compression", options.compression, "none | zips | zip | piz")
        ->capture_default_str();
    command.add_option("--output-space", options.outputSpace, spaces)->capture_default_str();
    command.add_option("--cosine", options.cosine, "cos(theta_i) in the values: keep | divide")
        ->check(CLI::IsMember({"keep", "divide"}))
        ->capture_default_str();
}

void addAtlasOutput(CLI::App& command, std::filesystem::path& output) {
    command.add_option("-o,--output", output, "the atlas, an OpenEXR file")->required();
}

}  // namespace abrdf
