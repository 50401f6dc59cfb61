// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/utia_encoding.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr double kScale140 = 140;

// IEC 61966-2-1 for values of 0 and above, going on past 1.
double srgbCode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}
double linearFromCode(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

}  // namespace

std::string nameOf(UtiaEncoding encoding) {
    switch (encoding) {
        case UtiaEncoding::kSrgb:
            return "srgb";
        case UtiaEncoding::kSrgb140:
            return "srgb140";
        default:
            return "linear";
    }
}

UtiaEncoding utiaEncodingFromName(const std::string& name) {
    for (const auto encoding :
         {UtiaEncoding::kLinear, UtiaEncoding::kSrgb, UtiaEncoding::kSrgb140}) {
        if (nameOf(encoding) == name) return encoding;
    }
    throw std::invalid_argument(
        fmt::format("there is no UTIA encoding '{}': use linear, srgb or srgb140", name));
}

double linearFromUtia(double stored, UtiaEncoding encoding) {
    if (encoding == UtiaEncoding::kLinear) return stored;
    const double code = encoding == UtiaEncoding::kSrgb140 ? stored / kScale140 : stored;
    return std::copysign(linearFromCode(std::abs(code)), code);
}

double utiaFromLinear(double linear, UtiaEncoding encoding) {
    if (encoding == UtiaEncoding::kLinear) return linear;
    const double code = std::copysign(srgbCode(std::abs(linear)), linear);
    return encoding == UtiaEncoding::kSrgb140 ? kScale140 * code : code;
}

}  // namespace abrdf
