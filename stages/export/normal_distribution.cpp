// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/normal_distribution.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/rgl_table.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

/// The solid angle of each node: the trapezoid rule along x, d omega = 2 pi x sin(theta) ... dx.
std::vector<double> solidAngles(const DirectionNodes& nodes) {
    std::vector<double> angles(nodes.thetas * nodes.phis);
    const double stepX = 1.0 / static_cast<double>(nodes.thetas - 1);
    for (std::size_t p = 0; p < nodes.phis; ++p) {
        const bool isEdge = p == 0 || p == nodes.phis - 1;
        const double stepPhi = 2 * kPi / static_cast<double>(nodes.phis - 1) * (isEdge ? 0.5 : 1);
        for (std::size_t t = 0; t < nodes.thetas; ++t) {
            const double x = static_cast<double>(t) * stepX;
            const double weight = t == nodes.thetas - 1 ? 0.5 : 1;
            angles[p * nodes.thetas + t] =
                weight * stepX * kPi * x * std::sin(thetaFromRgl(x)) * stepPhi;
        }
    }
    return angles;
}

/// Integral over the azimuth of max(0, <w, m>), over 2 pi.
double meanCosine(Radians thetaW, Radians thetaM) {
    const double a = std::cos(thetaW) * std::cos(thetaM);
    const double b = std::sin(thetaW) * std::sin(thetaM);
    if (a >= b) return a;
    const double edge = std::acos(-a / b);
    return (a * edge + std::sqrt(b * b - a * a)) / kPi;
}

/// sigma at each of `to` of a distribution at `from`.
std::vector<double> areas(const DirectionNodes& to, const DirectionNodes& from,
                          const std::vector<double>& density) {
    std::vector<double> weights = solidAngles(from);
    std::vector<Imath::V3d> normals;
    for (std::size_t j = 0; j < density.size(); ++j) {
        weights[j] *= density[j];
        normals.push_back(vectorFromDirection(from.at(j % from.thetas, j / from.thetas)));
    }
    std::vector<double> result(to.thetas * to.phis);
    forEachTexelBlock(result.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Direction w = to.at(i % to.thetas, i / to.thetas);
            const Imath::V3d vector = vectorFromDirection(w);
            for (std::size_t j = 0; j < density.size(); ++j) {
                const double cosine = from.phis == 2
                                          ? meanCosine(w.theta, from.at(j % from.thetas, 0).theta)
                                          : std::max(0.0, vector.dot(normals[j]));
                result[i] += weights[j] * cosine;
            }
        }
    });
    return result;
}

/// Scales to integral of D cos(theta) 1; a Lambertian's D = 1/pi where there is nothing to scale.
void normalize(const DirectionNodes& nodes, std::vector<double>& density) {
    const std::vector<double> angles = solidAngles(nodes);
    double sum = 0;
    double whole = 0;
    for (std::size_t i = 0; i < density.size(); ++i) {
        const double cosine = std::cos(nodes.at(i % nodes.thetas, 0).theta);
        sum += density[i] * angles[i] * cosine;
        whole += angles[i] * cosine;
    }
    for (double& d : density) d = sum > 0 ? d / sum : 1 / whole;
}

/// Linear between the rows' nodes.
double valueAt(const DirectionNodes& nodes, const std::vector<double>& values, Direction w) {
    const auto place = [](double x, std::size_t count) {
        const double scaled = std::clamp(x, 0.0, 1.0) * static_cast<double>(count - 1);
        const auto node = std::min(static_cast<std::size_t>(scaled), count - 2);
        return std::pair(node, scaled - static_cast<double>(node));
    };
    const auto [t, x] = place(rglFromTheta(w.theta), nodes.thetas);
    const auto [p, y] = place(rglFromPhi(std::remainder(w.phi, 2 * kPi)), nodes.phis);
    const double* row = values.data() + p * nodes.thetas + t;
    const double* next = row + nodes.thetas;
    return (1 - y) * ((1 - x) * row[0] + x * row[1]) + y * ((1 - x) * next[0] + x * next[1]);
}

}  // namespace

Direction DirectionNodes::at(std::size_t theta, std::size_t phi) const {
    return {thetaFromRgl(static_cast<double>(theta) / static_cast<double>(thetas - 1)),
            phiFromRgl(static_cast<double>(phi) / static_cast<double>(phis - 1))};
}

NormalDistribution distributionFromRetro(std::size_t phis,
                                         const std::function<double(Direction)>& retro) {
    NormalDistribution result;
    result.nodes.phis = phis;
    const DirectionNodes& fine = result.nodes;
    std::vector<double> seen(fine.thetas * fine.phis);
    forEachTexelBlock(seen.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            seen[i] = std::max(0.0, retro(fine.at(i % fine.thetas, i / fine.thetas)));
        }
    });
    // sigma is smooth: a coarse set of directions finds it.
    const DirectionNodes coarse{phis == 2 ? fine.thetas : 32,
                                phis == 2 ? 2 : std::min(phis, std::size_t{33})};
    std::vector<double> area(coarse.thetas * coarse.phis, 1);
    result.density.resize(seen.size());
    constexpr int kIterations = 8;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        std::vector<double> density(area.size());
        for (std::size_t i = 0; i < area.size(); ++i) {
            density[i] =
                area[i] * valueAt(fine, seen, coarse.at(i % coarse.thetas, i / coarse.thetas));
        }
        normalize(coarse, density);
        area = areas(coarse, coarse, density);
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        result.density[i] =
            seen[i] * valueAt(coarse, area, fine.at(i % fine.thetas, i / fine.thetas));
    }
    normalize(fine, result.density);
    constexpr double kLambertian = 1e-3;
    for (double& d : result.density) d = (1 - kLambertian) * d + kLambertian / kPi;
    normalize(fine, result.density);
    result.area = areas(fine, fine, result.density);
    return result;
}

}  // namespace abrdf
