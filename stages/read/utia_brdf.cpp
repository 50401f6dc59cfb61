// SPDX-License-Identifier: BSD-3-Clause
//
// UTIA BRDF database [Filip and Vavra 2014]: theta 0, 15 .. 75 degrees by 48 azimuths of 7.5.
#include "stages/read/utia_brdf.h"

#include "abrdf/reciprocity.h"
#include "abrdf/sampled_brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

using Stored = std::vector<std::array<double, 3>>;

/// Half of all values lie above it.
double medianOf(const Stored& stored) {
    std::vector<double> values;
    for (const auto& rgb : stored) {
        for (const double v : rgb) {
            if (std::isfinite(v)) values.push_back(v);
        }
    }
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// A reflectance factor cannot be above 2 at half of all pairs: then the numbers go up to 140.
constexpr double kLargestMedian = 2;

UtiaEncoding chosenEncoding(const Stored& stored, const ReadOptions& options, std::string& note) {
    if (options.utiaEncoding) {
        note = fmt::format("encoding {}, as asked for", nameOf(*options.utiaEncoding));
        return *options.utiaEncoding;
    }
    const double median = medianOf(stored);
    const auto guess = median > kLargestMedian ? UtiaEncoding::kSrgb140 : UtiaEncoding::kLinear;
    note = fmt::format(
        "encoding {} assumed, as the median of the numbers is {:.3g}; readers of these files "
        "disagree, and --utia-encoding linear|srgb|srgb140 says otherwise",
        nameOf(guess), median);
    return guess;
}

}  // namespace

std::unique_ptr<BtfReader> makeUtiaBrdfReader(const DatabasePath& path, const char* format,
                                              const Stored& stored) {
    BtfDescription description = tableDescription(path, format);
    description.grid = AngularGrid(regularDirections(6, 48));
    description.maxMeasuredTheta = description.grid.maxTheta();
    std::string note;
    const UtiaEncoding encoding = chosenEncoding(stored, path.options, note);
    description.notes.push_back(note);
    std::vector<Rgb> values;
    values.reserve(stored.size());
    std::size_t negative = 0;
    for (const auto& rgb : stored) {
        std::array<float, 3> linear{};
        for (std::size_t c = 0; c < 3; ++c) {
            linear[c] = static_cast<float>(linearFromUtia(rgb[c], encoding));
            if (linear[c] < 0) {
                linear[c] = 0;
                ++negative;
            }
        }
        values.push_back({linear[0], linear[1], linear[2]});
    }
    if (negative > 0) {
        description.notes.push_back(fmt::format("{} numbers below 0 are read as 0", negative));
    }
    const Reciprocity reciprocity = reciprocityOf(description.grid, values, Cosine::kKept);
    description.cosine = cosineFromReciprocity(reciprocity, Cosine::kKept);
    description.cosineFrom = fmt::format(
        "guess from the data: rms deviation from reciprocity {:.3f} as stored, {:.3f} divided by "
        "cos(theta_i)",
        reciprocity.rmsAsStored, reciprocity.rmsDivided);
    auto table = std::make_unique<SampledBrdf>(description.grid, std::move(values));
    return makeTableReader(path, std::move(description), std::move(table));
}

}  // namespace abrdf
