// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/analytic_material.h"
#include "abrdf/weave.h"
#include "color/rgb.h"

#include <ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

constexpr int kMaxDemoSize = 1024;

/// A virtual cloth to try everything on: a 2/1 twill of dark blue warp and light weft. Each texel
/// has its own normal, thread direction and colour, and is shadowed and masked by the yarns around
/// it, so that it is neither reciprocal nor isotropic. The left edge joins the right one, the top
/// the bottom. Pure arithmetic: the same bits on every machine.
class DemoCloth {
  public:
    /// `size` texels each way, 1 .. kMaxDemoSize; the same weave at any size. `seed` varies the
    /// colours; `relief` stretches its heights, 0 is flat. Throws std::invalid_argument for another
    /// size.
    DemoCloth(int size, std::uint64_t seed, float relief = 1);

    int size() const { return size_; }

    /// Reflectance factor times cos(theta_i), linear Rec.709, of the texel in column x and row y
    /// (row 0 is the top); unit vectors, z along the cloth's normal, y up in the image.
    Rgb radiance(int x, int y, const Imath::V3f& light, const Imath::V3f& view) const;

    /// The whole image, row by row from the top; `image` holds size() squared colours.
    void render(const Imath::V3f& light, const Imath::V3f& view, std::span<Rgb> image) const;

  private:
    /// Where a neighbour rises highest over a texel, on one side.
    struct Crest {
        float tangent = 0;        // of its elevation, >= 0
        std::uint32_t texel = 0;  // the crest's own
    };
    struct Texel {
        YarnFamily family = YarnFamily::kWarp;
        Imath::V3f thread, across, normal;  // its frame
        Rgb body;
        std::array<Crest, 4> crests;  // to the right, up, left, down
    };
    struct Yarn {
        PreparedMaterial body, sheen;
        Rgb sheenColor;
    };

    Texel makeTexel(int x, int y, std::uint64_t seed) const;
    WeavePoint pointAt(float u, float v) const;
    Crest crestBeside(float u, float v, const Imath::V2f& side) const;
    Rgb shade(const Texel& texel, const Imath::V3f& light, const Imath::V3f& view) const;
    Rgb radiance(const Texel& texel, const Imath::V3f& light, const Imath::V3f& view) const;

    static Yarn makeYarn(YarnFamily family);
    static float clearance(const Texel& texel, const Imath::V3f& direction);

    int size_;
    float relief_;
    std::array<Yarn, 2> yarns_;
    std::vector<Texel> texels_;
};

}  // namespace abrdf
