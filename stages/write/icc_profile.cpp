// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/icc_profile.h"

#include <lcms2.h>

#include <array>
#include <memory>
#include <stdexcept>

namespace abrdf {

namespace {

struct Free {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
    void operator()(cmsToneCurve* curve) const { cmsFreeToneCurve(curve); }
    void operator()(cmsMLU* text) const { cmsMLUfree(text); }
};

cmsCIExyY xyY(const std::array<float, 2>& xy) {
    return {static_cast<double>(xy[0]), static_cast<double>(xy[1]), 1};
}

/// The parametric curve of ICC.1, type 4, that decodes: sRGB's, or a power.
std::unique_ptr<cmsToneCurve, Free> curveOf(const DisplayEncoding& encoding) {
    if (encoding.curve == DisplayCurve::kPower) {
        return std::unique_ptr<cmsToneCurve, Free>(cmsBuildGamma(nullptr, encoding.gamma));
    }
    const std::array<double, 5> srgb = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    return std::unique_ptr<cmsToneCurve, Free>(
        cmsBuildParametricToneCurve(nullptr, 4, srgb.data()));
}

void setText(void* profile, cmsTagSignature tag, const char* text) {
    const std::unique_ptr<cmsMLU, Free> mlu(cmsMLUalloc(nullptr, 1));
    cmsMLUsetASCII(mlu.get(), "en", "US", text);
    cmsWriteTag(profile, tag, mlu.get());
}

}  // namespace

std::string iccProfile(const DisplayEncoding& encoding) {
    if (encoding.curve == DisplayCurve::kPq) return {};
    const cmsCIExyY white = xyY(encoding.primaries.white);
    const cmsCIExyYTRIPLE triple = {xyY(encoding.primaries.red), xyY(encoding.primaries.green),
                                    xyY(encoding.primaries.blue)};
    const auto curve = curveOf(encoding);
    std::array<cmsToneCurve*, 3> curves = {curve.get(), curve.get(), curve.get()};
    const std::unique_ptr<void, Free> profile(cmsCreateRGBProfile(&white, &triple, curves.data()));
    cmsUInt32Number size = 0;
    if (profile != nullptr) {
        setText(profile.get(), cmsSigProfileDescriptionTag, encoding.name.c_str());
        setText(profile.get(), cmsSigCopyrightTag, "No copyright, use freely");
        cmsSaveProfileToMem(profile.get(), nullptr, &size);
    }
    std::string bytes(size, '\0');
    if (size == 0 || cmsSaveProfileToMem(profile.get(), bytes.data(), &size) == 0) {
        throw std::runtime_error("the ICC profile of " + encoding.name + " cannot be made");
    }
    // Bytes 24 to 35 hold the moment of creation: 2000-01-01, so that files do not depend on it.
    constexpr std::array<char, 12> kDate = {0x07, static_cast<char>(0xD0), 0, 1, 0, 1};
    bytes.replace(24, kDate.size(), kDate.data(), kDate.size());
    return bytes;
}

}  // namespace abrdf
