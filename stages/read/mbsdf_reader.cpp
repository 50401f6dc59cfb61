// SPDX-License-Identifier: BSD-3-Clause
//
// NVIDIA MBSDF: a text header that ends in the line MBSDF_DATA_REFLECTION=, then u32 type (1: RGB),
// n_theta, n_phi, then float32 [theta_i][theta_v][phi][RGB]: cell middles over theta 0 .. pi/2 and
// the azimuths' difference 0 .. pi; isotropic, without cosine.
#include "stages/read/byte_cursor.h"
#include "stages/read/mapped_file.h"
#include "stages/read/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr std::string_view kMagic = "NVIDIA ARC MBSDF";
constexpr std::string_view kData = "MBSDF_DATA_REFLECTION=\n";

/// Two neighbouring cells and the share of the second; outside the outermost middles held.
struct Between {
    std::size_t before = 0;
    std::size_t after = 0;
    double share = 0;
};

Between between(double place, std::size_t cells) {
    const double fromMiddle = std::clamp(place - 0.5, 0.0, static_cast<double>(cells - 1));
    const auto before = static_cast<std::size_t>(fromMiddle);
    return {before, std::min(before + 1, cells - 1), fromMiddle - static_cast<double>(before)};
}

class MbsdfTable : public BrdfTable {
  public:
    MbsdfTable(std::size_t thetas, std::size_t phis, std::vector<float> values)
        : thetas_(thetas), phis_(phis), values_(std::move(values)) {}

    Rgb evaluate(const LightAndView& pair) const override {
        const auto thetaCell = [&](Radians theta) {
            return between(theta / (kPi / 2) * static_cast<double>(thetas_), thetas_);
        };
        const Radians turn = wrappedAzimuth(pair.view.phi - pair.light.phi);
        const Radians difference = std::min(turn, 2 * kPi - turn);  // Mirror images are alike.
        const std::array<Between, 3> cells = {
            thetaCell(pair.light.theta), thetaCell(pair.view.theta),
            between(difference / kPi * static_cast<double>(phis_), phis_)};
        Rgb sum;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            double weight = kPi * std::cos(pair.light.theta);
            std::array<std::size_t, 3> at{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const bool second = (corner >> axis & 1) != 0;
                weight *= second ? cells[axis].share : 1 - cells[axis].share;
                at[axis] = second ? cells[axis].after : cells[axis].before;
            }
            const float* rgb = values_.data() + 3 * ((at[0] * thetas_ + at[1]) * phis_ + at[2]);
            sum += static_cast<float>(weight) * Rgb{rgb[0], rgb[1], rgb[2]};
        }
        // The measurement's noise lies on both sides of 0.
        return {std::max(0.0F, sum.r), std::max(0.0F, sum.g), std::max(0.0F, sum.b)};
    }

  private:
    std::size_t thetas_;
    std::size_t phis_;
    std::vector<float> values_;
};

}  // namespace

bool recognizesMbsdf(const DatabasePath& path) {
    return !path.files && path.head.starts_with(kMagic);
}

std::unique_ptr<BtfReader> makeMbsdfReader(const DatabasePath& path) {
    const MappedFile map(path.path);
    ByteCursor file(map.bytes(), path.path.string());
    const std::size_t begin = path.head.find(kData);
    if (begin == std::string::npos) {
        file.fail("its header has no line MBSDF_DATA_REFLECTION=");
    }
    file.seek(begin + kData.size());
    const std::uint32_t type = file.u32("type");
    const std::uint32_t thetas = file.u32("theta count");
    const std::uint32_t phis = file.u32("phi count");
    if (type > 1 || thetas == 0 || phis == 0) {
        file.fail(
            fmt::format("it declares type {} with {} x {} x {} cells", type, thetas, thetas, phis));
    }
    constexpr std::uint64_t kHuge = std::uint64_t{1} << 48;
    const std::uint64_t cells = boundedProduct(boundedProduct(thetas, thetas, kHuge), phis, kHuge);
    const std::uint64_t channels = type == 1 ? 3 : 1;
    std::vector<float> values = file.numbers<float>(channels * cells, "cells");
    map.checkWhole();
    if (channels == 1) {
        std::vector<float> grey;
        for (const float v : values) grey.insert(grey.end(), 3, v);
        values = std::move(grey);
    }
    BtfDescription description = tableDescription(path, "NVIDIA MBSDF");
    return makeTableReader(path, std::move(description),
                           std::make_unique<MbsdfTable>(thetas, phis, std::move(values)));
}

}  // namespace abrdf
