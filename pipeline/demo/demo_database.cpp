// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/demo/demo_database.h"

#include "abrdf/angular_grid.h"
#include "abrdf/demo_cloth.h"
#include "abrdf/direction.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/lock_file.h"
#include "abrdf/output_file.h"
#include "pipeline/demo/demo_image.h"
#include "pipeline/demo/zip_folder.h"
#include "stages/align/shift_image.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// A folder for the unfinished `target`, beside it; gone, with all in it, when this object is. It
/// has one name for all processes, so that the next one takes away what a killed one left; a lock
/// in it keeps a second process away.
class StagingFolder {
  public:
    explicit StagingFolder(const fs::path& target)
        : path_(target.parent_path() /
                fmt::format(".{}.abrdf-unfinished", target.filename().string())) {
        std::error_code error;
        fs::create_directory(path_, error);
        if (error) {
            throw std::runtime_error(
                fmt::format("{}: the folder cannot be made: {}; see to it and run again",
                            path_.string(), error.message()));
        }
        try {
            lock_.emplace(path_ / "lock");
        } catch (const std::runtime_error&) {
            fs::remove(path_, error);
            throw;
        }
        if (!lock_->isHeld()) {
            throw std::runtime_error(fmt::format(
                "{}: another abrdf is writing it; wait for that one or choose another target",
                target.string()));
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
            if (entry.path().filename() != "lock") fs::remove_all(entry.path());
        }
    }
    ~StagingFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    StagingFolder(const StagingFolder&) = delete;
    StagingFolder& operator=(const StagingFolder&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
    std::optional<LockFile> lock_;
};

long degrees(Radians angle) {
    return std::lround(degreesFromRadians(angle));
}

std::string folderOfView(Direction view) {
    return fmt::format("tv{:03}_pv{:03}", degrees(view.theta), degrees(view.phi));
}

std::string imageName(const AngularGrid& grid, std::size_t pair, DemoFormat format) {
    const auto [light, view] = grid.pair(pair);
    return fmt::format("{}/{:05} tl{:03} pl{:03} tv{:03} pv{:03}.{}", folderOfView(view), pair,
                       degrees(light.theta), degrees(light.phi), degrees(view.theta),
                       degrees(view.phi), extension(format));
}

DemoFormat formatOf(const DemoOptions& options) {
    return options.hdr ? DemoFormat::kExr : DemoFormat::kJpeg;
}

/// `target` without a slash at its end, and with its name where it was "." or "..".
fs::path named(const fs::path& target) {
    const fs::path path = fs::absolute(target).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

/// Throws where no database can be put at `target`.
void checkTarget(const fs::path& target, bool isZip) {
    if (isZip || !fs::exists(target)) {
        checkOutputPath(target);
    } else if (!fs::is_directory(target)) {
        throw std::runtime_error(fmt::format(
            "{}: is a file; name a folder, or a file that ends in .zip", target.string()));
    } else if (!fs::is_empty(target)) {
        throw std::runtime_error(
            fmt::format("{}: the folder is not empty; name a new or an empty one, or remove it",
                        target.string()));
    }
}

void renderImages(const DemoCloth& cloth, const DemoImageWriter& writer, const DemoOptions& options,
                  const fs::path& folder, const ProgressSink& progress) {
    const DemoFormat format = formatOf(options);
    const AngularGrid grid(ubo81Directions());
    for (const Direction& view : grid.views()) fs::create_directory(folder / folderOfView(view));

    const auto texels =
        static_cast<std::size_t>(cloth.size()) * static_cast<std::size_t>(cloth.size());
    std::atomic<std::size_t> done = 0;
    forEachImage(grid.pairCount(), [&](std::size_t pair) {
        const auto [light, view] = grid.pair(pair);
        std::vector<Rgb> image(texels);
        cloth.render(Imath::V3f(vectorFromDirection(light)), Imath::V3f(vectorFromDirection(view)),
                     image);
        const Shift shift = parallax(-options.height, view);
        if (shift.x != 0 || shift.y != 0) {
            const std::vector<Rgb> atSurface = image;
            shiftImage(atSurface, cloth.size(), cloth.size(), shift, Edges::kPeriodic, image);
        }
        writer.write(folder / imageName(grid, pair, format), image);
        if (progress) progress({"render", "images", ++done, grid.pairCount()});
    });
}

/// Moves all that is in `from` into the empty folder `target`; all or nothing.
void moveContents(const fs::path& from, const fs::path& target) {
    std::vector<fs::path> moved;
    try {
        for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
            const fs::path to = target / entry.path().filename();
            fs::rename(entry.path(), to);
            moved.push_back(to);
        }
    } catch (...) {
        std::error_code ignored;
        for (const fs::path& path : moved) fs::remove_all(path, ignored);
        throw;
    }
}

}  // namespace

void writeDemoDatabase(const fs::path& target, const DemoOptions& options,
                       const ProgressSink& progress) {
    const fs::path path = named(target);
    const bool isZip = path.extension() == ".zip";
    checkTarget(path, isZip);
    const DemoCloth cloth(options.size, options.seed, options.relief);
    const DemoImageWriter writer(options.size, formatOf(options));

    // An empty folder may be a disk of its own: then the work is done on that disk.
    const bool fillFolder = !isZip && fs::exists(path);
    const StagingFolder staging(fillFolder ? path / "images" : path);
    const fs::path images = staging.path() / "images";
    fs::create_directory(images);
    renderImages(cloth, writer, options, images, progress);

    if (isZip) {
        const fs::path archive = staging.path() / "database.zip";
        zipFolder(images, archive);
        fs::rename(archive, path);
    } else if (fillFolder) {
        moveContents(images, path);
    } else {
        fs::rename(images, path);
    }
}

}  // namespace abrdf
