// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/plane.h"

#include "abrdf/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

/// A search needs no more texels each way.
constexpr int kSearchTexels = 128;

/// Whole pixels make one texel, so that none is cut.
Texels searchedTexels(const BtfDescription& description) {
    const int most = std::max(description.width, description.height);
    const int pixels = (most + kSearchTexels - 1) / kSearchTexels;
    return {std::max(1, description.width / pixels), std::max(1, description.height / pixels)};
}

std::vector<LightAndView> directionsOf(const AngularGrid& grid,
                                       const std::vector<std::size_t>& pairs) {
    std::vector<LightAndView> directions;
    for (const std::size_t pair : pairs) directions.push_back(grid.pair(pair));
    return directions;
}

void search(FoundPlane& found, const PlaneChoice& choice, const OpenedInput& input,
            const SampleSet& samples, const ProgressSink& progress) {
    const Texels texels = searchedTexels(input.description());
    const ImageStack images = readStack(input, samples, texels, progress).stack;
    Plane& plane = found.plane;
    if (!choice.edges) plane.edges = isPeriodic(images) ? Edges::kPeriodic : Edges::kCropped;
    if (!choice.search) return;
    PlaneFit fit = findPlane(images, directionsOf(input.description().grid, samples.pairs),
                             {.edges = plane.edges});
    const double pixels = static_cast<double>(input.description().width) / texels.width;
    fit.height *= pixels;
    fit.best *= pixels;
    plane.height = fit.height;
    found.fit = fit;
}

}  // namespace

PlaneChoice planeFromName(const std::string& name) {
    PlaneChoice choice;
    if (name == "auto") return choice;
    choice.search = false;
    if (name == "off") return choice;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data(), end, choice.height);
    if (error == std::errc() && rest == end && std::abs(choice.height) < 1e4) return choice;
    throw std::invalid_argument(fmt::format(
        "the plane '{}' is not understood: write auto, off, or its height in texels", name));
}

std::optional<Edges> edgesFromName(const std::string& name) {
    if (name == "auto") return std::nullopt;
    if (name == "periodic") return Edges::kPeriodic;
    if (name == "cropped") return Edges::kCropped;
    throw std::invalid_argument(
        fmt::format("the edges '{}' are not understood: write auto, periodic or cropped", name));
}

FoundPlane planeOf(const PlannedMethod& planned, const PlaneChoice& choice,
                   const OpenedInput& input, Texels texels, const ProgressSink& progress) {
    const Stopwatch time;
    FoundPlane found;
    const bool isOne = texels.width == 1 && texels.height == 1;
    if (input.reader->table() != nullptr || isOne) return found;
    if (choice.search && planned.method->wish == SampleWish::kEverything) return found;
    found.plane.height = choice.height;
    if (choice.edges) found.plane.edges = *choice.edges;
    if (choice.search || (choice.height != 0 && !choice.edges)) {
        search(found, choice, input, planned.samples, progress);
    }
    found.seconds = time.seconds();
    return found;
}

int marginOf(const Plane& plane, const AngularGrid& grid) {
    if (plane.edges == Edges::kPeriodic) return 0;
    double farthest = 0;
    for (const Direction& view : grid.views()) {
        const Shift shift = parallax(plane.height, view);
        farthest = std::max({farthest, std::abs(shift.x), std::abs(shift.y)});
    }
    return static_cast<int>(std::ceil(farthest - 1e-6));
}

int marginOf(const Plane& plane, const BtfDescription& description, Texels texels) {
    const double pixels = std::min(static_cast<double>(description.width) / texels.width,
                                   static_cast<double>(description.height) / texels.height);
    return static_cast<int>(std::ceil(marginOf(plane, description.grid) / pixels));
}

nlohmann::ordered_json jsonOf(const FoundPlane& found, const AngularGrid& grid) {
    const Plane& plane = found.plane;
    nlohmann::ordered_json json = {
        {"height", plane.height},
        {"edges", plane.edges == Edges::kPeriodic ? "periodic" : "cropped"},
        {"margin", marginOf(plane, grid)}};
    if (found.fit) {
        json["best_height"] = found.fit->best;
        json["residual"] = found.fit->residual;
        json["residual_at_zero"] = found.fit->residualAtZero;
    }
    return json;
}

}  // namespace abrdf
