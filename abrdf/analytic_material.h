// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/facet.h"
#include "abrdf/microfacet.h"

#include <ImathVec.h>

#include <array>
#include <span>
#include <vector>

namespace abrdf {

/// A clear layer over everything: it mirrors some light, and refracts the rest on the way in and
/// out, so that what lies below is seen and lit more steeply.
struct Coat {
    float strength = 0;         ///< Of its highlight; 0 is no coat.
    float roughness = 0.1F;     ///< Alpha of its GGX lobe, > 0.
    float reflectance = 0.04F;  ///< Along the normal, 0 .. 1; what is not reflected goes through.
    float refraction = 1;       ///< Index of the layer, >= 1.
};

/// One wave of the field that a material is multiplied with, to be unlike any textbook:
/// amplitude cos(light . l + view . v + between (l . v) + phase), summed up in the exponent.
struct CosineWave {
    Imath::V3f light{0, 0, 0};
    Imath::V3f view{0, 0, 0};
    float between = 0;
    float phase = 0;
    float amplitude = 0;
};

/// A grey material in closed form: facets with lobes, threads, masking, a coat. Its value at a
/// pair of directions is the reflectance factor times cos(theta_i): a white Lambertian lit from
/// its normal is 1.
struct AnalyticMaterial {
    std::vector<Facet> facets;
    Coat coat;
    std::vector<CosineWave> field;  ///< None: factor 1.
    Radians azimuth = 0;            ///< The whole material, turned about the normal.
    float scale = 1;
};

/// Unit vectors to the light and to the viewer, z along the surface's normal.
struct VectorPair {
    Imath::V3f light, view;
};

/// A material with everything that does not depend on the directions worked out: for many pairs.
class PreparedMaterial {
  public:
    explicit PreparedMaterial(const AnalyticMaterial& material);

    /// The material's value; 0 where light or view is not above the surface. Never NaN.
    float evaluate(const Imath::V3f& light, const Imath::V3f& view) const;

    /// values[k] = evaluate(pairs[k]).
    void evaluate(std::span<const VectorPair> pairs, std::span<float> values) const;

  private:
    struct TiltedFacet {
        explicit TiltedFacet(const Facet& facet);

        PreparedFacet scattering;
        Imath::V3f x, y, normal;  // its frame
        float weight, groove;
    };

    float uncoated(const Imath::V3f& light, const Imath::V3f& view) const;
    float coated(const Imath::V3f& light, const Imath::V3f& view) const;
    float fieldFactor(const Imath::V3f& light, const Imath::V3f& view) const;

    /// The waves number by number, so that a compiler takes several at once.
    struct Field {
        std::array<std::vector<float>, 3> light, view;
        std::vector<float> between, phase, amplitude;
    };

    std::vector<TiltedFacet> facets_;
    Coat coat_;
    PreparedLobe coatLobe_;
    Field field_;
    float scale_;
};

/// The same for one pair.
float evaluate(const AnalyticMaterial& material, const Imath::V3f& light, const Imath::V3f& view);

}  // namespace abrdf
