// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/environment_reader.h"

#include "stages/read/decode_image.h"
#include "stages/read/exr_header_check.h"
#include "stages/read/mapped_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

EnvironmentFile readEnvironment(const std::filesystem::path& path) {
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error(fmt::format(
            "{}: is no environment: {}; name a picture of longitude and latitude, .exr or .hdr, or "
            "studio, or sky",
            path.string(), why));
    };
    if (!std::filesystem::is_regular_file(path)) fail("there is no such file");
    {
        const MappedFile map(path);
        if (beginsAsExr(map.bytes())) checkExrHeader(map.bytes(), path.string());
    }
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) fail(OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < 3) fail(fmt::format("it has {} channels", spec.nchannels));
    if (spec.width < 2) fail(fmt::format("it has {} x {} pixels", spec.width, spec.height));
    checkImageSize(spec.width, spec.height, std::filesystem::file_size(path), path.string(), {});
    EnvironmentFile file;
    file.map.width = spec.width;
    file.map.height = spec.height;
    file.map.radiance.resize(static_cast<std::size_t>(spec.width) *
                             static_cast<std::size_t>(spec.height));
    file.interopId = spec.get_string_attribute("colorInteropID");
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, file.map.radiance.data())) {
        fail(input->geterror());
    }
    return file;
}

}  // namespace abrdf
