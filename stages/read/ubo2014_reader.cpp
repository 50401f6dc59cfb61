// SPDX-License-Identifier: BSD-3-Clause
//
// UBO2014 and all .btf files of the University of Bonn: 151 x 151 directions of dome 1, or whatever
// the file lists; linear RGB with no clamp at 1; the header says whether cos(theta_i) is in.
#include "stages/read/btf_colors.h"
#include "stages/read/btf_factors.h"
#include "stages/read/btf_reader.h"
#include "stages/read/btf_table.h"
#include "stages/read/database_path.h"
#include "stages/read/mapped_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace abrdf {

namespace {

struct Dfmf {
    BtfColorModel colors;
    std::vector<BtfFactors> channels;
};
struct Fmf {
    bool isLogarithm = false;
    BtfFactors factors;
};
struct Pvf {
    std::vector<BtfViewComponents> views;
};

void readSize(ByteCursor& file, const BtfHeader& header, BtfExtent& extent) {
    extent.width = file.u32("width");
    extent.height = file.u32("height");
    if (extent.width == 0 || extent.height == 0) {
        file.fail(fmt::format("it declares {} x {} texels", extent.width, extent.height));
    }
    if (header.hasRotations) skipBtfRotations(file);
}

Dfmf readDfmf(ByteCursor& file, const BtfExtent& extent) {
    file.u32("component count");  // The largest of all channels.
    Dfmf data{readBtfColorModel(file, extent.channels), {}};
    for (std::size_t c = 0; c < extent.channels; ++c) {
        data.channels.push_back(readBtfFactors(file, extent, 1));
    }
    return data;
}

Fmf readFmf(ByteCursor& file, const BtfHeader& header, const BtfExtent& extent) {
    constexpr std::uint8_t kNewest = 2;
    Fmf data;
    if (header.hasVersionByte) {
        const auto version = file.number<std::uint8_t>("version");
        if (version > kNewest) file.fail(fmt::format("its FMF header has version {}", version));
        if (version >= 1) data.isLogarithm = file.u32("range reduction") != 0;
        if (version >= 2) {
            const std::uint64_t width = file.u32("height map");
            const std::uint64_t height = file.u32("height map");
            constexpr std::uint64_t kHuge = std::uint64_t{1} << 48;
            file.take(2 * boundedProduct(width, height, kHuge), "height map");
        }
    }
    file.u32("component count");
    data.factors = readBtfFactors(file, extent, extent.channels);
    return data;
}

Pvf readPvf(ByteCursor& file, const BtfExtent& extent) {
    file.u32("component count");
    const std::uint32_t slots = file.u32("view slots");
    if (slots != extent.views) {
        file.fail(fmt::format("it has components for {} of {} views", slots, extent.views));
    }
    Pvf data;
    for (std::uint32_t v = 0; v < slots; ++v) {
        data.views.push_back(readBtfViewComponents(file, extent));
    }
    return data;
}

/// Which channels of the file are red, green and blue.
std::array<std::size_t, 3> rgbChannels(const ByteCursor& file,
                                       const std::vector<std::string>& names) {
    if (names.size() == 1) return {0, 0, 0};
    std::array<std::size_t, 3> channels{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto found = std::ranges::find(names, std::string(1, "RGB"[c]));
        if (found == names.end()) {
            file.fail(fmt::format("its {} channels are spectral, first '{}'; only RGB is read",
                                  names.size(), names[0]));
        }
        channels[c] = static_cast<std::size_t>(found - names.begin());
    }
    return channels;
}

class Ubo2014Reader : public BtfReader {
  public:
    explicit Ubo2014Reader(const DatabasePath& path) : name_(path.path.string()), map_(path.path) {
        ByteCursor file(map_.bytes(), name_);
        const BtfHeader header = readBtfHeader(file);
        extent_.lights = header.lights.size();
        extent_.views = header.views.size();
        extent_.channels = header.channels.size();
        rgb_ = rgbChannels(file, header.channels);
        readData(file, header);
        map_.checkWhole();
        describe(path, header);
    }

    const BtfDescription& description() const override { return description_; }

    EncodedImage read(std::size_t pair) const override {
        const std::size_t light = lights_[description_.grid.lightOf(pair)];
        const std::size_t view = views_[description_.grid.viewOf(pair)];
        const std::size_t channels = extent_.channels;
        std::vector<float> values(channels * extent_.texels());
        decode(light, view, values);
        map_.checkWhole();
        std::vector<float> rgb(3 * extent_.texels());
        for (std::size_t t = 0; t < extent_.texels(); ++t) {
            for (std::size_t c = 0; c < 3; ++c) {
                // What a factorisation leaves below 0 is its error; NaN stays.
                const float value = values[rgb_[c] + channels * t];
                rgb[c + 3 * t] = value < 0 ? 0 : value;
            }
        }
        return {description_.width, description_.height, std::move(rgb)};
    }

    std::string fileOf(std::size_t) const override { return name_; }

    std::uint64_t bytesOf(std::size_t) const override {
        return map_.bytes().size() / description_.grid.pairCount();
    }

  private:
    void readData(ByteCursor& file, const BtfHeader& header) {
        if (header.kind == BtfKind::kBdi) {
            data_ = BtfTable(file, extent_);
            return;
        }
        readSize(file, header, extent_);
        if (header.kind == BtfKind::kDfmf) data_ = readDfmf(file, extent_);
        if (header.kind == BtfKind::kFmf) data_ = readFmf(file, header, extent_);
        if (header.kind == BtfKind::kPvf) data_ = readPvf(file, extent_);
    }

    void describe(const DatabasePath& path, const BtfHeader& header) {
        std::vector<Direction> lights;
        std::vector<Direction> views;
        const auto keepAbove = [](const std::vector<Direction>& all, std::vector<Direction>& kept,
                                  std::vector<std::size_t>& places) {
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (!(all[i].theta < kPi / 2)) continue;
                kept.push_back(all[i]);
                places.push_back(i);
            }
        };
        keepAbove(header.lights, lights, lights_);
        keepAbove(header.views, views, views_);
        description_.belowHorizon = extent_.pairs() - lights.size() * views.size();
        if (lights.empty() || views.empty()) {
            throw std::runtime_error(fmt::format("{}: has no direction above the surface", name_));
        }
        description_.format = "UBO2014";
        description_.source = path.name();
        description_.grid = AngularGrid(std::move(lights), std::move(views));
        description_.present.assign(description_.grid.pairCount(), 1);
        description_.width = static_cast<int>(extent_.width);
        description_.height = static_cast<int>(extent_.height);
        description_.colorSpace = "Linear Rec.709 (sRGB)";
        description_.cosine = header.cosineIsIn ? Cosine::kKept : Cosine::kAbsent;
        description_.cosineFrom = "header";
        description_.maxMeasuredTheta = description_.grid.maxTheta();
        constexpr std::array kKinds = {"DFMF", "FMF", "PVF", "BDI"};
        description_.notes.push_back(fmt::format("the container is of type {}",
                                                 kKinds[static_cast<std::size_t>(header.kind)]));
    }

    void decode(std::size_t light, std::size_t view, std::span<float> values) const {
        const std::size_t channels = extent_.channels;
        const std::size_t a = light + extent_.lights * view;
        if (const auto* dfmf = std::get_if<Dfmf>(&data_)) {
            for (std::size_t c = 0; c < channels; ++c) {
                addImage(dfmf->channels[c], a, 1, values.subspan(c), channels);
            }
            applyColorModel(dfmf->colors, channels, values);
        } else if (const auto* fmf = std::get_if<Fmf>(&data_)) {
            addImage(fmf->factors, a, channels, values, 1);
            if (fmf->isLogarithm) {
                for (float& v : values) v = std::exp(v) - kBtfEpsilon;
            }
        } else if (const auto* pvf = std::get_if<Pvf>(&data_)) {
            decodeImage(pvf->views[view], extent_, light, values);
        } else {
            std::get<BtfTable>(data_).decode(a, values);
        }
    }

    std::string name_;
    MappedFile map_;
    BtfExtent extent_;
    std::array<std::size_t, 3> rgb_{};
    std::variant<Dfmf, Fmf, Pvf, BtfTable> data_;
    std::vector<std::size_t> lights_;  ///< The file's index of each light of the grid.
    std::vector<std::size_t> views_;
    BtfDescription description_;
};

}  // namespace

bool recognizesUbo2014(const DatabasePath& path) {
    return !path.files && beginsAsBtf(path.head);
}

std::unique_ptr<BtfReader> makeUbo2014Reader(const DatabasePath& path) {
    return std::make_unique<Ubo2014Reader>(path);
}

}  // namespace abrdf
