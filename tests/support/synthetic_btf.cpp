// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/synthetic_btf.h"

#include "abrdf/for_each_texel.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

fs::path syntheticFile(const SyntheticBtf& btf, std::size_t pair) {
    const LightAndView p = btf.grid.pair(pair);
    const auto degrees = [](Radians angle) {
        return fmt::format("{:.6g}", degreesFromRadians(angle));
    };
    return fs::path(fmt::format("tv{}_pv{}", degrees(p.view.theta), degrees(p.view.phi))) /
           fmt::format("{:05} tl{} pl{} tv{} pv{}.{}", pair, degrees(p.light.theta),
                       degrees(p.light.phi), degrees(p.view.theta), degrees(p.view.phi),
                       btf.extension);
}

void writeSyntheticBtf(const fs::path& folder, const SyntheticBtf& btf) {
    const bool isFloat = btf.extension == "exr";
    for (std::size_t pair = 0; pair < btf.grid.pairCount(); ++pair) {
        fs::create_directories((folder / syntheticFile(btf, pair)).parent_path());
    }
    forEachImage(btf.grid.pairCount(), [&](std::size_t pair) {
        const fs::path file = folder / syntheticFile(btf, pair);
        std::vector<Rgb> pixels;
        for (int y = 0; y < btf.height; ++y) {
            for (int x = 0; x < btf.width; ++x) {
                pixels.push_back(btf.value(btf.grid.pair(pair), x, y));
            }
        }
        OIIO::ImageSpec spec(btf.width, btf.height, 3,
                             isFloat ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
        if (btf.extension == "jpg") spec.attribute("CompressionQuality", 95);
        const auto output = OIIO::ImageOutput::create(file.string());
        if (!output || !output->open(file.string(), spec) ||
            !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !output->close()) {
            throw std::runtime_error("cannot write " + file.string());
        }
    });
}

std::vector<Rgb> sharedTable(const std::string& name) {
    std::ifstream stream(fs::path(ABRDF_SHARED_DATA) / name, std::ios::binary);
    std::vector<Rgb> table;
    float c[3];
    while (stream.read(reinterpret_cast<char*>(c), sizeof c)) table.push_back({c[0], c[1], c[2]});
    return table;
}

std::string bytesOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace abrdf
