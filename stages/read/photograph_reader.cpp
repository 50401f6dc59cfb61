// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/photograph_reader.h"

#include "stages/read/decode_image.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>

namespace abrdf {

namespace {

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

/// Nothing where the direction is not above the surface.
std::optional<Direction> directionFromDegrees(double theta, double phi, const std::string& file) {
    if (!(theta >= 0 && theta <= 180) || !(phi >= -360 && phi <= 360)) {
        throw std::runtime_error(fmt::format(
            "{}: its angles theta {} phi {} are not those of a direction: theta must be from 0 to "
            "180 degrees (below 90 above the surface), phi from -360 to 360",
            file, theta, phi));
    }
    if (theta >= 90) return {};
    return Direction{radiansFromDegrees(theta), wrappedAzimuth(radiansFromDegrees(phi))};
}

class PhotographReader : public BtfReader {
  public:
    PhotographReader(std::shared_ptr<const FileSource> files,
                     const std::vector<Photograph>& photographs, const PhotographFormat& format)
        : files_(std::move(files)) {
        description_.format = format.name;
        description_.source = format.source;
        description_.cosineFrom = format.cosineFrom;
        description_.isList = format.isList;
        description_.notes = format.notes;
        placePhotographs(photographs);
        description_.maxMeasuredTheta = description_.grid.maxTheta();
        readFirstImage(format.linearSpace);
    }

    const BtfDescription& description() const override { return description_; }

    EncodedImage read(std::size_t pair) const override {
        EncodedImage image = decoded(pair);
        if (image.width != description_.width || image.height != description_.height) {
            throw std::runtime_error(fmt::format(
                "{}: is {} x {} pixels, the database's first image {} x {}; all must have one size",
                fileOf(pair), image.width, image.height, description_.width, description_.height));
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
    EncodedImage decoded(std::size_t pair) const {
        return decodeImage(files_->read(fileOfPair_[pair]), fileOf(pair), files_->limits());
    }

    /// Of the database, for messages: a manifest's folder may be the one we are in.
    std::string ownName() const {
        return files_->path().empty() ? description_.source : files_->path().string();
    }

    void placePhotographs(const std::vector<Photograph>& photographs) {
        struct Placed {
            std::size_t file;
            LightAndView pair;
        };
        std::vector<Placed> above;
        DirectionIndex lights;
        DirectionIndex views;
        for (const Photograph& p : photographs) {
            const std::string name = files_->fullName(p.file);
            const auto light = directionFromDegrees(p.thetaLight, p.phiLight, name);
            const auto view = directionFromDegrees(p.thetaView, p.phiView, name);
            if (!light || !view) continue;
            above.push_back({p.file, {*light, *view}});
            lights.emplace(*light, 0);
            views.emplace(*view, 0);
        }
        description_.belowHorizon = photographs.size() - above.size();
        if (above.empty()) {
            throw std::runtime_error(fmt::format(
                "{}: none of its {} images has light and view above the surface: theta must be "
                "below 90 degrees",
                ownName(), photographs.size()));
        }
        // What matters is that no small archive makes a huge table.
        if (lights.size() * views.size() > 64 * above.size() + (std::size_t{1} << 20)) {
            throw std::runtime_error(fmt::format(
                "{}: its {} images have {} light and {} view directions: they do not form a grid",
                ownName(), above.size(), lights.size(), views.size()));
        }
        std::vector<Direction> lightList = numbered(lights);
        std::vector<Direction> viewList = numbered(views);
        description_.grid = AngularGrid(std::move(lightList), std::move(viewList));
        description_.present.assign(description_.grid.pairCount(), 0);
        fileOfPair_.assign(description_.grid.pairCount(), 0);
        for (const Placed& image : above) {
            const std::size_t pair =
                description_.grid.pairIndex(lights.at(image.pair.light), views.at(image.pair.view));
            if (description_.present[pair] != 0) {
                description_.duplicates.push_back(fmt::format(
                    "{} and {}", files_->names()[fileOfPair_[pair]], files_->names()[image.file]));
            }
            description_.present[pair] = 1;
            fileOfPair_[pair] = image.file;
        }
    }

    /// The first image that can be read tells the size of all.
    void readFirstImage(const std::string& linearSpace) {
        std::string fault;
        for (std::size_t pair = 0; pair < description_.present.size(); ++pair) {
            if (description_.present[pair] == 0) continue;
            try {
                const EncodedImage image = decoded(pair);
                description_.width = image.width;
                description_.height = image.height;
                description_.colorSpace = isLinearFormat(files_->names()[fileOfPair_[pair]])
                                              ? linearSpace
                                              : "sRGB - Texture";
                return;
            } catch (const std::runtime_error& error) {
                if (fault.empty()) fault = error.what();
            }
        }
        throw std::runtime_error(fault);
    }

    std::shared_ptr<const FileSource> files_;
    BtfDescription description_;
    std::vector<std::size_t> fileOfPair_;
};

}  // namespace

std::unique_ptr<BtfReader> makePhotographReader(std::shared_ptr<const FileSource> files,
                                                const std::vector<Photograph>& photographs,
                                                const PhotographFormat& format) {
    return std::make_unique<PhotographReader>(std::move(files), photographs, format);
}

}  // namespace abrdf
