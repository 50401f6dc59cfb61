// SPDX-License-Identifier: BSD-3-Clause
//
// UBO2003 (University of Bonn): a folder or zip of tvTTT_pvPPP/NNNNN tlTTT plPPP tvTTT pvPPP.jpg,
// 81 lights x 81 views, rectified photographs in sRGB, the cosine of theta_i in the values.
#include "abrdf/for_each_texel.h"
#include "stages/read/angle_keys.h"
#include "stages/read/btf_reader.h"
#include "stages/read/database_path.h"
#include "stages/read/decode_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace abrdf {

namespace {

Direction checkedDirection(double theta, double phi, const std::string& file) {
    if (!(theta >= 0 && theta < 90) || !(phi >= -360 && phi <= 360)) {
        throw std::runtime_error(fmt::format(
            "{}: the angles theta {} phi {} in its name are not those of a direction above the "
            "surface: theta must be from 0 to below 90 degrees, phi from -360 to 360",
            file, theta, phi));
    }
    return {radiansFromDegrees(theta), wrappedAzimuth(radiansFromDegrees(phi))};
}

struct ByAngle {
    bool operator()(const Direction& a, const Direction& b) const {
        return a.theta != b.theta ? a.theta < b.theta : a.phi < b.phi;
    }
};
/// The index of each direction in the sorted list of all.
using DirectionIndex = std::map<Direction, std::size_t, ByAngle>;

std::vector<Direction> numbered(DirectionIndex& index) {
    std::vector<Direction> directions;
    for (auto& [direction, number] : index) {
        number = directions.size();
        directions.push_back(direction);
    }
    return directions;
}

class Ubo2003Reader : public BtfReader {
  public:
    explicit Ubo2003Reader(const DatabasePath& path) : files_(path.files) {
        description_.format = "UBO2003";
        description_.source = path.name();
        indexFiles();
        readFirstImage();
    }

    const BtfDescription& description() const override { return description_; }

    EncodedImage read(std::size_t pair) const override {
        const std::size_t file = fileOfPair_[pair];
        EncodedImage image = decodeImage(files_->read(file), files_->fullName(file));
        if (image.width != description_.width || image.height != description_.height) {
            throw std::runtime_error(fmt::format(
                "{}: is {} x {} pixels, the database's first image {} x {}; all must have one size",
                files_->fullName(file), image.width, image.height, description_.width,
                description_.height));
        }
        return image;
    }

    std::string fileOf(std::size_t pair) const override {
        return files_->fullName(fileOfPair_[pair]);
    }

    std::uint64_t bytesOf(std::size_t pair) const override {
        return files_->sizeOf(fileOfPair_[pair]);
    }

  private:
    struct Photograph {
        std::size_t file;
        LightAndView pair;
    };

    void indexFiles() {
        std::vector<Photograph> photographs;
        DirectionIndex lights;
        DirectionIndex views;
        const std::vector<std::string>& names = files_->names();
        std::vector<std::optional<AngleKeys>> keysOf(names.size());
        forEachTexelBlock(names.size(), 512, [&](std::size_t begin, std::size_t end) {
            for (std::size_t file = begin; file < end; ++file) {
                if (isImageName(names[file])) keysOf[file] = angleKeysFromName(names[file]);
            }
        });
        for (std::size_t file = 0; file < names.size(); ++file) {
            const std::optional<AngleKeys>& keys = keysOf[file];
            if (!keys) continue;
            const LightAndView pair = {
                checkedDirection(keys->tl, keys->pl, files_->fullName(file)),
                checkedDirection(keys->tv, keys->pv, files_->fullName(file))};
            photographs.push_back({file, pair});
            lights.emplace(pair.light, 0);
            views.emplace(pair.view, 0);
        }
        // What matters is that no small archive makes a huge table.
        if (lights.size() * views.size() > 64 * photographs.size() + 65536) {
            throw std::runtime_error(fmt::format(
                "{}: its {} images have {} light and {} view directions: they do not form a grid",
                files_->path().string(), photographs.size(), lights.size(), views.size()));
        }
        std::vector<Direction> lightList = numbered(lights);
        std::vector<Direction> viewList = numbered(views);
        description_.grid = AngularGrid(std::move(lightList), std::move(viewList));
        description_.present.assign(description_.grid.pairCount(), 0);
        fileOfPair_.assign(description_.grid.pairCount(), 0);
        for (const Photograph& photograph : photographs) {
            const std::size_t pair = description_.grid.pairIndex(lights.at(photograph.pair.light),
                                                                 views.at(photograph.pair.view));
            if (description_.present[pair] != 0) {
                description_.duplicates.push_back(fmt::format("{} and {}",
                                                              files_->names()[fileOfPair_[pair]],
                                                              files_->names()[photograph.file]));
            }
            description_.present[pair] = 1;
            fileOfPair_[pair] = photograph.file;
        }
    }

    void readFirstImage() {
        const auto first = std::ranges::find(description_.present, std::uint8_t{1});
        const std::size_t file =
            fileOfPair_[static_cast<std::size_t>(first - description_.present.begin())];
        const EncodedImage image = decodeImage(files_->read(file), files_->fullName(file));
        description_.width = image.width;
        description_.height = image.height;
        description_.colorSpace =
            isLinearFormat(files_->names()[file]) ? "Linear Rec.709 (sRGB)" : "sRGB - Texture";
    }

    std::shared_ptr<const FileSource> files_;
    BtfDescription description_;
    std::vector<std::size_t> fileOfPair_;
};

}  // namespace

bool recognizesUbo2003(const DatabasePath& path) {
    return path.files && std::ranges::any_of(path.files->names(), [](const std::string& name) {
               return isImageName(name) && angleKeysFromName(name);
           });
}

std::unique_ptr<BtfReader> makeUbo2003Reader(const DatabasePath& path) {
    return std::make_unique<Ubo2003Reader>(path);
}

}  // namespace abrdf
