// SPDX-License-Identifier: BSD-3-Clause
//
// An atlas of this program's own, of either layout, as an input: its texels are the pixels of the
// images, its directions the grid.
#include "stages/read/atlas_reader.h"
#include "stages/read/btf_reader.h"
#include "stages/read/database_path.h"

#include <algorithm>

namespace abrdf {

namespace {

class AtlasInputReader : public BtfReader {
  public:
    explicit AtlasInputReader(const DatabasePath& path)
        : file_(path.path.string()), bytes_(path.size), atlas_(readAtlas(path.path)) {
        const AtlasHeader& header = atlas_.header();
        description_.format = "abrdf atlas";
        description_.source = path.name();
        description_.grid = header.grid;
        description_.present.assign(header.grid.pairCount(), 1);
        description_.width = header.layout.texelsWide;
        description_.height = header.layout.texelsHigh;
        description_.colorSpace = header.colorSpace;
        description_.cosine = header.cosine;
        description_.cosineFrom = "header";
        // What lies between the grid's last elevation and the source's is not in the atlas.
        description_.maxMeasuredTheta = std::min(header.maxMeasuredTheta, header.grid.maxTheta());
    }

    const BtfDescription& description() const override { return description_; }

    EncodedImage read(std::size_t pair) const override {
        const auto light = static_cast<int>(description_.grid.lightOf(pair));
        const auto view = static_cast<int>(description_.grid.viewOf(pair));
        std::vector<float> rgb;
        rgb.reserve(3 * atlas_.header().layout.texelCount());
        for (int y = 0; y < description_.height; ++y) {
            for (int x = 0; x < description_.width; ++x) {
                const Rgb value = atlas_.at({x, y, light, view});
                rgb.insert(rgb.end(), {value.r, value.g, value.b});
            }
        }
        return {description_.width, description_.height, std::move(rgb)};
    }

    std::string fileOf(std::size_t) const override { return file_; }
    std::uint64_t bytesOf(std::size_t) const override {
        return bytes_ / description_.grid.pairCount();
    }

  private:
    std::string file_;
    std::uint64_t bytes_;
    Atlas atlas_;
    BtfDescription description_;
};

}  // namespace

bool recognizesAtlas(const DatabasePath& path) {
    return !path.files && isAtlas(path.path);
}

std::unique_ptr<BtfReader> makeAtlasInputReader(const DatabasePath& path) {
    return std::make_unique<AtlasInputReader>(path);
}

}  // namespace abrdf
