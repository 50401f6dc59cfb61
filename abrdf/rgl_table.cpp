// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/rgl_table.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace abrdf {

double rglFromTheta(Radians theta) {
    return std::sqrt(std::max(0.0, theta) * 2 / kPi);
}

double rglFromPhi(Radians phi) {
    return (phi + kPi) / (2 * kPi);
}

Radians thetaFromRgl(double x) {
    return x * x * kPi / 2;
}

Radians phiFromRgl(double y) {
    return (2 * y - 1) * kPi;
}

namespace {

Radians azimuthOf(const Imath::V3d& v) {
    return std::atan2(v.y, v.x);
}

struct Between {
    std::size_t before = 0;
    std::size_t after = 0;
    double share = 0;
};

/// Outside the nodes the outermost one's value is held.
Between between(std::span<const float> nodes, double value) {
    const auto above = std::ranges::upper_bound(nodes, static_cast<float>(value));
    if (above == nodes.begin()) return {};
    const auto before = static_cast<std::size_t>(above - nodes.begin()) - 1;
    if (above == nodes.end()) return {before, before, 0};
    const auto low = static_cast<double>(nodes[before]);
    const auto high = static_cast<double>(nodes[before + 1]);
    return {before, before + 1, std::clamp((value - low) / (high - low), 0.0, 1.0)};
}

}  // namespace

RglTable::RglTable(RglData data)
    : data_(std::move(data)), warp_(data_.vndf), isotropic_(data_.phiIn.size() <= 2) {
    if (isotropic_) return;
    const auto range = static_cast<double>(data_.phiIn.back() - data_.phiIn.front());
    reduction_ = static_cast<int>(std::lround(2 * kPi / range));
}

TableBlend RglTable::blendOf(double phiIn, double thetaIn) const {
    const Between phi = between(data_.phiIn, phiIn);
    const Between theta = between(data_.thetaIn, thetaIn);
    const std::size_t thetas = data_.thetaIn.size();
    return {{phi.before * thetas + theta.before, phi.before * thetas + theta.after,
             phi.after * thetas + theta.before, phi.after * thetas + theta.after},
            {(1 - phi.share) * (1 - theta.share), (1 - phi.share) * theta.share,
             phi.share * (1 - theta.share), phi.share * theta.share}};
}

Rgb RglTable::evaluate(const LightAndView& pair) const {
    // The published evaluation returns f cos(theta_o); by reciprocity the view goes in and the
    // light out, so that the cosine is the light's.
    Imath::V3d in = vectorFromDirection(pair.view);
    Imath::V3d out = vectorFromDirection(pair.light);
    if (reduction_ >= 2) {
        // A measured half or quarter stands for all: turned or mirrored until phi_in lies in it.
        const double y = in.y >= 0 ? -1 : 1;
        const double x = reduction_ >= 4 ? (in.x >= 0 ? -1 : 1) : y;
        for (Imath::V3d* v : {&in, &out}) *v = {x * v->x, y * v->y, v->z};
    }
    const Radians phiIn = azimuthOf(in);
    const Imath::V3d half = in + out;
    const double sinHalf = std::hypot(half.x, half.y);
    const Radians thetaHalf = std::atan2(sinHalf, half.z);
    // At the pole rounding would choose the azimuth.
    const Radians phiHalf = sinHalf > 1e-9 ? azimuthOf(half) : phiIn;
    const double turn = rglFromPhi(phiHalf - (isotropic_ ? phiIn : 0));
    // So would it at half a turn, where the square's two edges meet.
    const double wrapped = turn - std::floor(turn);
    const SquarePlace micronormal = {rglFromTheta(thetaHalf), wrapped < 1 - 1e-9 ? wrapped : 0};
    const TableBlend blend = blendOf(phiIn, pair.view.theta);
    const SquarePlace sample = warp_.invert(micronormal, blend);
    double factor = kPi;
    if (data_.jacobian) {
        constexpr TableBlend kOnly = {{0, 0, 0, 0}, {1, 0, 0, 0}};
        factor *= data_.ndf.at(micronormal, kOnly) /
                  (4 * data_.sigma.at({rglFromTheta(pair.view.theta), rglFromPhi(phiIn)}, kOnly));
    }
    const auto channel = [&](std::size_t c) {
        TableBlend tables = blend;
        for (std::size_t& table : tables.tables) table = 3 * table + c;
        return static_cast<float>(factor * std::max(0.0, data_.rgb.at(sample, tables)));
    };
    return {channel(0), channel(1), channel(2)};
}

}  // namespace abrdf
