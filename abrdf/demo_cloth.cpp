// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/demo_cloth.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/portable_math.h"
#include "abrdf/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

namespace abrdf {

using Imath::V3f;

namespace {

constexpr float kTwist = 0.25F;       // of the fibres about their yarn, radians
constexpr float kStrands = 3;         // bright strands a yarn shows in one pitch
constexpr float kBounce = 0.12F;      // light from the yarns around, where no light falls directly
constexpr float kOcclusion = 0.25F;   // how much the walls around a place darken it
constexpr float kPenumbra = 0.15F;    // softness of a shadow's edge, in the sine of the elevation
constexpr float kLowestView = 0.05F;  // cosine to its own normal under which a texel is still shown

constexpr std::array<Imath::V2f, 4> kSides{
    {{1.0F, 0.0F}, {0.0F, 1.0F}, {-1.0F, 0.0F}, {0.0F, -1.0F}}};

/// A number in -1 .. 1 that belongs to what `numbers` name.
float variation(std::initializer_list<std::uint64_t> numbers) {
    return static_cast<float>(2 * uniformFromHash(hashOf(numbers)) - 1);
}

Rgb bodyColor(const WeavePoint& point, int x, int y, std::uint64_t seed) {
    const bool isWarp = point.family == YarnFamily::kWarp;
    const Rgb color = isWarp ? Rgb{0.035F, 0.07F, 0.22F} : Rgb{0.62F, 0.54F, 0.40F};
    const auto family = static_cast<std::uint64_t>(point.family);
    const auto yarn = static_cast<std::uint64_t>(point.yarn);
    const float dye = variation({seed, 1, family, yarn});
    const float hue = variation({seed, 2, family, yarn});
    const float texel =
        variation({seed, 3, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)});
    const float turns = kStrands * point.along + 0.8F * point.across;
    const float strand = portable::cos(2 * std::numbers::pi_v<float> * turns);
    const float light = (1 + 0.12F * dye) * (1 + 0.08F * texel) * (1 + 0.15F * strand);
    return light * Rgb{color.r * (1 + 0.08F * hue), color.g, color.b * (1 - 0.08F * hue)};
}

}  // namespace

DemoCloth::Yarn DemoCloth::makeYarn(YarnFamily family) {
    const bool isWarp = family == YarnFamily::kWarp;
    // In the frame of a texel: x along the thread.
    AnalyticMaterial body;
    body.facets.resize(1);
    body.facets[0].diffuse.albedo = 1;
    body.facets[0].diffuse.orenNayarSigma = 0.5F;

    // Fibres that rise and dive along the thread, each shining across it; they mask one another.
    AnalyticMaterial sheen;
    Facet fibres;
    fibres.tilt = isWarp ? 0.06 : 0.05;
    fibres.groove = 0.7F;
    fibres.lobes[0].strength = 1;
    fibres.lobes[0].fresnel.normal = isWarp ? 0.09F : 0.03F;
    fibres.lobes[0].fresnel.grazing = isWarp ? 0.8F : 0.3F;
    fibres.lobes[0].roughnessX = isWarp ? 0.05F : 0.12F;
    fibres.lobes[0].roughnessY = isWarp ? 0.14F : 0.3F;
    sheen.facets.assign(2, fibres);
    sheen.facets[1].azimuth = kPi;

    const Rgb color = isWarp ? Rgb{0.85F, 0.92F, 1.0F} : Rgb{1.0F, 0.97F, 0.9F};
    return {PreparedMaterial(body), PreparedMaterial(sheen), color};
}

DemoCloth::DemoCloth(int size, std::uint64_t seed, float relief)
    : size_(size),
      relief_(relief),
      yarns_{makeYarn(YarnFamily::kWarp), makeYarn(YarnFamily::kWeft)} {
    if (size < 1 || size > kMaxDemoSize) {
        throw std::invalid_argument(
            fmt::format("the demo cloth has 1 to {} texels each way, not {}; choose a size among "
                        "these",
                        kMaxDemoSize, size));
    }
    const auto width = static_cast<std::size_t>(size);
    texels_.resize(width * width);
    forEachTexel(texels_.size(), [&](std::size_t texel) {
        texels_[texel] =
            makeTexel(static_cast<int>(texel % width), static_cast<int>(texel / width), seed);
    });
}

DemoCloth::Texel DemoCloth::makeTexel(int x, int y, std::uint64_t seed) const {
    const float pitch = static_cast<float>(size_) / kWeaveYarns;  // texels a yarn
    const float u = (static_cast<float>(x) + 0.5F) / pitch;
    const float v = (static_cast<float>(size_ - 1 - y) + 0.5F) / pitch;
    const WeavePoint point = pointAt(u, v);
    const bool isWarp = point.family == YarnFamily::kWarp;

    Texel texel;
    texel.family = point.family;
    texel.body = bodyColor(point, x, y, seed);

    // The frame: along the yarn on its surface, then turned by the twist of its fibres.
    texel.normal = V3f(-point.slopeX, -point.slopeY, 1).normalized();
    const V3f along = isWarp ? V3f(0, 1, point.slopeY) : V3f(1, 0, point.slopeX);
    const V3f thread = along.normalized();
    const float twist = kTwist + 0.12F * variation({seed, 4, static_cast<std::uint64_t>(x),
                                                    static_cast<std::uint64_t>(y)});
    texel.thread = (thread + twist * texel.normal.cross(thread)).normalized();
    texel.across = texel.normal.cross(texel.thread);

    float walls = 0;
    for (std::size_t side = 0; side < kSides.size(); ++side) {
        texel.crests[side] = crestBeside(u, v, kSides[side]);
        walls += texel.crests[side].tangent;
    }
    texel.body *= 1 / (1 + kOcclusion * walls);
    return texel;
}

WeavePoint DemoCloth::pointAt(float u, float v) const {
    WeavePoint point = weaveAt(u, v);
    point.height *= relief_;
    point.slopeX *= relief_;
    point.slopeY *= relief_;
    return point;
}

// The steepest point within one and a half pitches.
DemoCloth::Crest DemoCloth::crestBeside(float u, float v, const Imath::V2f& side) const {
    const float pitch = static_cast<float>(size_) / kWeaveYarns;
    const float height = pointAt(u, v).height;
    const auto cell = [this](float texels) {
        const int index = static_cast<int>(std::floor(texels)) % size_;
        return index < 0 ? index + size_ : index;
    };
    const auto texelAt = [&](float x, float y) {
        return static_cast<std::uint32_t>((size_ - 1 - cell(y * pitch)) * size_ + cell(x * pitch));
    };
    Crest crest{0, texelAt(u, v)};
    for (int step = 1; step <= 24; ++step) {
        const float distance = static_cast<float>(step) / 16;
        const float x = u + distance * side.x;
        const float y = v + distance * side.y;
        const float tangent = (pointAt(x, y).height - height) / distance;
        if (tangent > crest.tangent) crest = {tangent, texelAt(x, y)};
    }
    return crest;
}

// 1 where nothing stands between the texel and the direction, 0 behind a crest: a horizon map of
// four azimuths [Max 1988].
float DemoCloth::clearance(const Texel& texel, const V3f& direction) {
    const float tangentX = texel.crests[direction.x >= 0 ? 0 : 2].tangent;
    const float tangentY = texel.crests[direction.y >= 0 ? 1 : 3].tangent;
    const float x2 = direction.x * direction.x;
    const float y2 = direction.y * direction.y;
    const float horizontal = std::sqrt(x2 + y2);
    if (horizontal <= 0) return 1;
    const float tangent = (x2 * tangentX + y2 * tangentY) / (x2 + y2);
    return std::clamp((direction.z - tangent * horizontal) / kPenumbra + 0.5F, 0.0F, 1.0F);
}

// A texel by itself: lit past its crests, seen whatever stands before it.
Rgb DemoCloth::shade(const Texel& texel, const V3f& light, const V3f& view) const {
    const Yarn& yarn = yarns_[static_cast<std::size_t>(texel.family)];
    const auto toLocal = [&](const V3f& w) {
        return V3f(texel.thread.dot(w), texel.across.dot(w), texel.normal.dot(w));
    };
    const V3f localLight = toLocal(light);
    V3f localView = toLocal(view);
    localView.z = std::max(localView.z, kLowestView);

    const float lit = clearance(texel, light);
    const float body = lit * yarn.body.evaluate(localLight, localView) + kBounce * light.z;
    const float sheen = lit * yarn.sheen.evaluate(localLight, localView);
    return body * texel.body + sheen * yarn.sheenColor;
}

Rgb DemoCloth::radiance(const Texel& texel, const V3f& light, const V3f& view) const {
    if (light.z <= 0 || view.z <= 0) return {};
    const float seen = clearance(texel, view);
    if (seen >= 1) return shade(texel, light, view);
    // Behind a crest: the crest is what the camera sees there.
    const bool sideways = std::fabs(view.x) >= std::fabs(view.y);
    const std::size_t side = sideways ? (view.x >= 0 ? 0U : 2U) : (view.y >= 0 ? 1U : 3U);
    const Texel& crest = texels_[texel.crests[side].texel];
    const Rgb hidden = (1 - seen) * shade(crest, light, view);
    return seen > 0 ? seen * shade(texel, light, view) + hidden : hidden;
}

Rgb DemoCloth::radiance(int x, int y, const V3f& light, const V3f& view) const {
    assert(x >= 0 && x < size_ && y >= 0 && y < size_);
    const auto width = static_cast<std::size_t>(size_);
    const std::size_t texel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
    return radiance(texels_[texel], light, view);
}

void DemoCloth::render(const V3f& light, const V3f& view, std::span<Rgb> image) const {
    assert(image.size() == texels_.size());
    for (std::size_t texel = 0; texel < texels_.size(); ++texel) {
        image[texel] = radiance(texels_[texel], light, view);
    }
}

}  // namespace abrdf
