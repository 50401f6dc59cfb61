// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/rgl_nodes.h"

#include "abrdf/for_each_texel.h"
#include "stages/export/value_range.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

constexpr TableBlend kOnly = {{0, 0, 0, 0}, {1, 0, 0, 0}};

/// Of the samples, what goes to the visible normals of a Lambertian's D = 1/pi: where D alone is
/// small there would be none.
constexpr double kBroad = 0.2;

/// D(m) <w_i, m> / sigma(w_i), the density of visible normals.
double visible(double density, double area, double cosine) {
    return density * std::max(0.0, cosine) / area;
}

/// The hemispherical reflectance that a table holds, of each channel: the integral of S over its
/// nodes.
std::array<double, 3> albedoOf(const RglNodes& nodes, std::size_t begin, std::size_t side) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < side * side; ++i) {
        const auto edge = [&](std::size_t at) { return at == 0 || at == side - 1 ? 0.5 : 1.0; };
        const double weight = edge(i % side) * edge(i / side) *
                              static_cast<double>(nodes.shares[begin + i]) /
                              static_cast<double>((side - 1) * (side - 1));
        const Rgb s = nodes.values[begin + i];
        sum[0] += weight * static_cast<double>(s.r);
        sum[1] += weight * static_cast<double>(s.g);
        sum[2] += weight * static_cast<double>(s.b);
    }
    return sum;
}

}  // namespace

Direction RglShape::incident(std::size_t phi, std::size_t theta) const {
    const double turn = phis == 1 ? 0.5 : static_cast<double>(phi) / static_cast<double>(phis - 1);
    return {static_cast<double>(thetas[theta]), phiFromRgl(turn)};
}

std::vector<float> sampleDensity(const RglShape& shape, const TableStack& ndf,
                                 const TableStack& sigma) {
    const std::size_t size = shape.warp * shape.warp;
    std::vector<float> values(shape.tables() * size);
    const auto last = static_cast<double>(shape.warp - 1);
    forEachTexel(shape.tables(), [&](std::size_t table) {
        const Direction in =
            shape.incident(table / shape.thetas.size(), table % shape.thetas.size());
        const Imath::V3d toViewer = vectorFromDirection(in);
        const double area = sigma.at({rglFromTheta(in.theta), rglFromPhi(in.phi)}, kOnly);
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t row = i / shape.warp;
            const SquarePlace place = {static_cast<double>(i % shape.warp) / last,
                                       static_cast<double>(row) / last};
            const Direction m = {thetaFromRgl(place.x), phiFromRgl(place.y)};
            const double cosine = toViewer.dot(vectorFromDirection(m));
            // d omega_m = 2 pi^2 u sin(theta_m) d u_m
            const double angle = 2 * kPi * kPi * place.x * std::sin(m.theta);
            const double density = (1 - kBroad) * visible(ndf.at(place, kOnly), area, cosine) +
                                   kBroad * visible(1 / kPi, (1 + toViewer.z) / 2, cosine);
            values[table * size + i] = static_cast<float>(density * angle);
        }
    });
    return values;
}

RglNodes nodesOf(const RglShape& shape, const RglData& data, const ExportSource& source,
                 const TurnedBrdf& brdf) {
    const TabulatedWarp warp(data.vndf);
    const std::size_t size = shape.side * shape.side;
    const std::size_t count = shape.tables() * size;
    RglNodes nodes{std::vector<Rgb>(count), std::vector<float>(count),
                   std::vector<std::uint8_t>(count)};
    const auto last = static_cast<double>(shape.side - 1);
    forEachTexelBlock(count, shape.side, [&](std::size_t begin, std::size_t end) {
        const std::size_t table = begin / size;
        const Direction in =
            shape.incident(table / shape.thetas.size(), table % shape.thetas.size());
        const Imath::V3d toViewer = vectorFromDirection(in);
        const double area = data.sigma.at({rglFromTheta(in.theta), rglFromPhi(in.phi)}, kOnly);
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t node = i % size;
            const std::size_t row = node / shape.side;
            const SquarePlace place = warp.warp(
                {static_cast<double>(node % shape.side) / last, static_cast<double>(row) / last},
                table);
            // At the pole itself a source could not tell the azimuths apart.
            const Imath::V3d m =
                vectorFromDirection({thetaFromRgl(std::max(place.x, 1e-3)), phiFromRgl(place.y)});
            const double cosine = toViewer.dot(m);
            const Imath::V3d out = 2 * cosine * m - toViewer;
            if (out.z <= 0 || cosine <= 0) continue;
            const LightAndView pair = {directionFromVector(out), in};
            const double density = data.ndf.at(place, kOnly);
            const double seen = visible(density, area, cosine);
            nodes.values[i] = static_cast<float>(4 * area / density) * brdf.evaluate(pair);
            nodes.shares[i] = static_cast<float>(
                seen /
                ((1 - kBroad) * seen + kBroad * visible(1 / kPi, (1 + toViewer.z) / 2, cosine)));
            nodes.places[i] = source.brdf.isExtrapolated(pair) ? 2 : 1;
        }
    });
    checkRange(nodes.values, source);
    return nodes;
}

double keepEnergy(const RglShape& shape, RglNodes& nodes) {
    constexpr double kRounding = 0.01;
    constexpr double kBound = 0.999;
    const std::size_t size = shape.side * shape.side;
    double largest = 0;
    for (std::size_t begin = 0; begin < nodes.values.size(); begin += size) {
        const auto albedo = albedoOf(nodes, begin, shape.side);
        const double most = std::ranges::max(albedo);
        const bool isExcess = most > kBound && most < 1 + kRounding;
        if (isExcess) {
            for (std::size_t i = 0; i < size; ++i) {
                nodes.values[begin + i] *= static_cast<float>(kBound / most);
            }
        }
        largest = std::max(largest, isExcess ? kBound : most);
    }
    return largest;
}

}  // namespace abrdf
