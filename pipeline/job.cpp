// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/job.h"

#include "abrdf/for_each_texel.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace abrdf {

Texels texelsFromName(const std::string& name) {
    if (name == "full") return {0, 0};
    Texels texels{0, 0};
    const char* end = name.data() + name.size();
    const auto [by, error] = std::from_chars(name.data(), end, texels.width);
    if (error == std::errc() && by != end && *by == 'x') {
        const auto [rest, heightError] = std::from_chars(by + 1, end, texels.height);
        if (heightError == std::errc() && rest == end && texels.width > 0 && texels.height > 0) {
            return texels;
        }
    }
    throw std::invalid_argument(fmt::format(
        "the texels '{}' are not understood: write WxH, as 1x1 or 64x64, or full", name));
}

OpenedInput openInput(const InputOptions& options) {
    OpenedInput input;
    input.missing = options.missing;
    input.warn = options.warn;
    callBoth([&] { input.reader = openBtf(options.input, options.read); },
             [&] { input.colors = ColorConfig::load(options.colorConfig); });
    const BtfDescription& description = input.description();
    if (!description.duplicates.empty()) {
        throw std::runtime_error(fmt::format(
            "{}: {} pairs of directions have two images, so that it is not clear which counts; the "
            "first: {}; remove one of each",
            options.input.string(), description.duplicates.size(), description.duplicates[0]));
    }
    input.inputSpace = input.colors.spaceName(options.inputSpace.empty() ? description.colorSpace
                                                                         : options.inputSpace);
    return input;
}

bool OpenedInput::hasCodes() const {
    return reader->table() == nullptr && description().colorSpace == "sRGB - Texture";
}

Texels resolvedTexels(Texels texels, const BtfDescription& description) {
    if (texels.width == 0) return {description.width, description.height};
    if (texels.width > description.width || texels.height > description.height) {
        throw std::invalid_argument(
            fmt::format("{} x {} texels are more than the images' {} x {} pixels", texels.width,
                        texels.height, description.width, description.height));
    }
    return texels;
}

}  // namespace abrdf
