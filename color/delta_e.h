// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

namespace abrdf {

/// CIE 1976 L*a*b* under D65; L in 0..100.
struct Lab {
    double L = 0;
    double a = 0;
    double b = 0;
};

/// CIE XYZ, the Y of white 1.
struct Xyz {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// Of a linear Rec.709 colour clipped to [0, 1], as an sRGB display shows it.
Xyz xyzOfDisplayed(Rgb color);

/// White D65; channels below 0 go along the tangent there.
Lab labFromXyz(const Xyz& color);

/// IEC 61966-2-1 encoding of one linear channel, clipped to [0, 1] first.
double srgbEncoded(double linear);

/// The inverse of srgbEncoded() on [0, 1].
double linearFromSrgb(double encoded);

/// CIE L* of a grey of this luminance, clipped to [0, 1]; 0 .. 100.
double lightness(double luminance);

/// Lab of a linear Rec.709 colour clipped to [0, 1], as an sRGB display shows it; white D65.
Lab labFromLinearRec709(Rgb color);

/// CIE 1976 colour difference: the Euclidean distance in Lab.
double deltaE76(const Lab& a, const Lab& b);

/// CIEDE2000 with unit weights (Sharma, Wu, Dalal 2005).
double deltaE2000(const Lab& a, const Lab& b);

}  // namespace abrdf
