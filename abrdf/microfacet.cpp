// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/microfacet.h"

#include "abrdf/portable_math.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

using Imath::V3f;

LocalPair::LocalPair(const V3f& localLight, const V3f& localView)
    : light(localLight), view(localView) {
    // Light and view that are opposite, at grazing, have the normal between them.
    const V3f sum = light + view;
    const float length2 = sum.dot(sum);
    half = length2 > 1e-10F ? sum * (1 / std::sqrt(length2)) : V3f(0, 0, 1);
    cosLight = std::max(light.z, 1e-3F);
    cosView = std::max(view.z, 1e-3F);
    cosHalfToLight = std::clamp(light.dot(half), 0.0F, 1.0F);
    cosBetween = std::clamp(light.dot(view), -1.0F, 1.0F);
}

PreparedLobe::PreparedLobe(const Lobe& lobe)
    : lobe_(lobe),
      cos_(static_cast<float>(std::cos(lobe.azimuth))),
      sin_(static_cast<float>(std::sin(lobe.azimuth))),
      inverseRoughnessX2_(1 / (lobe.roughnessX * lobe.roughnessX)),
      inverseRoughnessY2_(1 / (lobe.roughnessY * lobe.roughnessY)),
      peak_(1 / (lobe.roughnessX * lobe.roughnessY)) {
    // The long tail's norm is the one of small roughness; rough ones reflect less than all.
    if (lobe.shape == LobeShape::kLongTail) peak_ *= std::max(lobe.tail - 1, 0.05F);
}

float PreparedLobe::distribution(const V3f& half) const {
    const float x = cos_ * half.x + sin_ * half.y;
    const float y = cos_ * half.y - sin_ * half.x;
    const float slope2 = x * x * inverseRoughnessX2_ + y * y * inverseRoughnessY2_;
    const float z2 = half.z * half.z;
    switch (lobe_.shape) {
        case LobeShape::kGgx: {
            const float t = slope2 + z2;
            return peak_ / (t * t);
        }
        case LobeShape::kBeckmann: {
            const float bounded = z2 + 1e-6F;
            return peak_ * portable::exp(-slope2 / bounded) / (bounded * bounded);
        }
        case LobeShape::kLongTail:
            return peak_ * portable::pow(slope2 + z2, -lobe_.tail);
    }
    return 0;
}

// [Heitz 2014, eq. 72, 80]; GGX's serves the other shapes too.
float PreparedLobe::smithLambda(const V3f& direction) const {
    const float x = (cos_ * direction.x + sin_ * direction.y) * lobe_.roughnessX;
    const float y = (cos_ * direction.y - sin_ * direction.x) * lobe_.roughnessY;
    const float tan2 = (x * x + y * y) / std::max(direction.z * direction.z, 1e-6F);
    return 0.5F * (std::sqrt(1 + tan2) - 1);
}

float PreparedLobe::fresnel(float cosine) const {
    const Fresnel& f = lobe_.fresnel;
    const float t = std::max(1 - cosine, 1e-6F);
    const float t2 = t * t;
    const float rise = f.power == 5 ? t2 * t2 * t : portable::pow(t, f.power);
    return std::max(f.normal + (f.grazing - f.normal) * rise, 0.0F);
}

float PreparedLobe::reflectanceFactor(const LocalPair& pair) const {
    // Masking and shadowing, correlated by height [Heitz 2014, eq. 99].
    const float masking = 1 / (1 + smithLambda(pair.light) + smithLambda(pair.view));
    return lobe_.strength * distribution(pair.half) * masking * fresnel(pair.cosHalfToLight) /
           (4 * pair.cosLight * pair.cosView);
}

}  // namespace abrdf
