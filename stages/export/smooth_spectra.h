// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <array>
#include <cstddef>

namespace abrdf {

/// Reflectance spectra of linear Rec.709 colours, as shares of three primaries: smooth, within
/// [0, 1], their sum 1, and seen under D65 as red, green and blue to four digits. So a grey is
/// flat, a mixture is the mixture of its spectra, and values above 1 keep their colour [as Mallett
/// and Yuksel 2019, "Spectral primary decomposition for rendering with sRGB reflectance"; here the
/// sum of the squared differences of neighbours is least]. Linear between the nodes.
namespace spectra {

constexpr std::size_t kCount = 17;
constexpr double kFirst = 400;  ///< Nanometres.
constexpr double kStep = 20;

struct Node {
    float red;
    float green;
    float blue;
};
constexpr std::array<Node, kCount> kPrimaries{{{0.0614F, 0, 0.9386F},
                                               {0.0594F, 0, 0.9406F},
                                               {0.0331F, 0, 0.9669F},
                                               {0, 0, 1},
                                               {0, 0.2736F, 0.7264F},
                                               {0, 0.7216F, 0.2784F},
                                               {0, 1, 0},
                                               {0, 1, 0},
                                               {0, 1, 0},
                                               {0.1111F, 0.8170F, 0.0719F},
                                               {0.8265F, 0.1735F, 0},
                                               {1, 0, 0},
                                               {1, 0, 0},
                                               {1, 0, 0},
                                               {1, 0, 0},
                                               {1, 0, 0},
                                               {0.9989F, 0.0008F, 0.0003F}}};

/// The reflectance of a colour at node `k`; never below 0.
constexpr float at(Rgb color, std::size_t k) {
    const Node& p = kPrimaries[k];
    const float value = color.r * p.red + color.g * p.green + color.b * p.blue;
    return value > 0 ? value : 0;
}

}  // namespace spectra

}  // namespace abrdf
