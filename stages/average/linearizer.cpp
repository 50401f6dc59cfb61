// SPDX-License-Identifier: BSD-3-Clause
#include "stages/average/linearizer.h"

#include "abrdf/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace abrdf {

namespace {

bool isLight(const Rgb& c) {
    return isFinite(c) && !isNegative(c);
}

double channel(const Rgb& c, std::size_t index) {
    return static_cast<double>(index == 0 ? c.r : index == 1 ? c.g : c.b);
}

/// The curves of a transform that mixes no channels, where all codes become light.
std::optional<CodeTable> curvesOf(const ColorTransform& transform) {
    std::vector<Rgb> greys;
    for (int code = 0; code < 256; ++code) {
        const float grey = static_cast<float>(code) / 255.0F;
        greys.push_back({grey, grey, grey});
    }
    transform.apply(greys);
    if (!std::ranges::all_of(greys, isLight)) return std::nullopt;
    CodeTable table;
    for (std::size_t code = 0; code < greys.size(); ++code) {
        for (std::size_t c = 0; c < 3; ++c) table.curves[c][code] = channel(greys[code], c);
    }
    return table;
}

/// True where the table says what the transform does, to a float's rounding.
bool explains(const CodeTable& table, const ColorTransform& transform) {
    Random random(1);
    for (int i = 0; i < 1024; ++i) {
        const std::array<std::size_t, 3> codes = {random.below(256), random.below(256),
                                                  random.below(256)};
        std::array<double, 3> channels{};
        for (std::size_t c = 0; c < 3; ++c) {
            channels[c] = table.curves[c][codes[c]];
            if (!(channels[c] >= 0)) return false;
        }
        const std::array<double, 3> found = table.light(channels);
        Rgb wanted = {static_cast<float>(codes[0]) / 255.0F, static_cast<float>(codes[1]) / 255.0F,
                      static_cast<float>(codes[2]) / 255.0F};
        transform.apply({&wanted, 1});
        for (std::size_t c = 0; c < 3; ++c) {
            const double off = std::abs(found[c] - channel(wanted, c));
            if (!(off <= 2e-6 * (1 + std::abs(channel(wanted, c))))) return false;
        }
    }
    return true;
}

/// A curve a channel and then a matrix, where that is what `transform` does: column c is what full
/// channel c alone becomes, its curve the share of that which each code has.
std::optional<CodeTable> curvesAndMatrixOf(const ColorTransform& transform) {
    CodeTable table;
    table.matrix.emplace();
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<Rgb> ramp(256);
        for (std::size_t code = 0; code < ramp.size(); ++code) {
            const float value = static_cast<float>(code) / 255.0F;
            ramp[code] = {c == 0 ? value : 0, c == 1 ? value : 0, c == 2 ? value : 0};
        }
        transform.apply(ramp);
        double square = 0;
        for (std::size_t out = 0; out < 3; ++out) {
            (*table.matrix)[out][c] = channel(ramp[255], out);
            square += channel(ramp[255], out) * channel(ramp[255], out);
        }
        for (std::size_t code = 0; code < ramp.size(); ++code) {
            double dot = 0;
            for (std::size_t out = 0; out < 3; ++out) {
                dot += channel(ramp[code], out) * channel(ramp[255], out);
            }
            table.curves[c][code] = dot / square;
        }
    }
    if (!explains(table, transform)) return std::nullopt;
    return table;
}

}  // namespace

std::array<double, 3> CodeTable::light(const std::array<double, 3>& channels) const {
    if (!matrix) return channels;
    std::array<double, 3> result{};
    for (std::size_t out = 0; out < 3; ++out) {
        const std::array<double, 3>& row = (*matrix)[out];
        result[out] = row[0] * channels[0] + row[1] * channels[1] + row[2] * channels[2];
    }
    return result;
}

Linearizer::Linearizer(ColorTransform toSceneLinear) : transform_(std::move(toSceneLinear)) {
    if (const auto found =
            transform_.isPerChannel() ? curvesOf(transform_) : curvesAndMatrixOf(transform_)) {
        table_ = std::make_shared<const CodeTable>(*found);
    }
}

void Linearizer::linearize(const EncodedImage& image, std::size_t first, std::span<Rgb> row) const {
    if (const auto* floats = std::get_if<std::vector<float>>(&image.rgb)) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const float* p = floats->data() + 3 * (first + i);
            // A negative or unreal light stays one: a conversion could hide it.
            const Rgb c = {p[0], p[1], p[2]};
            constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
            row[i] = isLight(c) ? c : Rgb{kNaN, kNaN, kNaN};
        }
        if (!transform_.isIdentity()) transform_.apply(row);
        return;
    }
    const std::uint8_t* codes = std::get<std::vector<std::uint8_t>>(image.rgb).data() + 3 * first;
    constexpr float kScale = 1.0F / 255.0F;
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = {static_cast<float>(codes[3 * i]) * kScale,
                  static_cast<float>(codes[3 * i + 1]) * kScale,
                  static_cast<float>(codes[3 * i + 2]) * kScale};
    }
    transform_.apply(row);
}

}  // namespace abrdf
