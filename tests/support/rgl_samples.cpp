// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/rgl_samples.h"

#include "tests/support/synthetic_btf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace abrdf {

namespace {

template <typename T>
T take(const std::string& bytes, std::size_t& position) {
    T number;
    std::memcpy(&number, bytes.data() + position, sizeof number);
    position += sizeof number;
    return number;
}

/// A table of width x height nodes over the unit square.
struct Table {
    const float* nodes;
    std::size_t width;
    std::size_t height;

    double node(std::size_t x, std::size_t y) const {
        return static_cast<double>(nodes[y * width + x]);
    }
    double at(double x, double y) const {
        const double px = x * static_cast<double>(width - 1);
        const double py = y * static_cast<double>(height - 1);
        const auto ix = std::min(static_cast<std::size_t>(px), width - 2);
        const auto iy = std::min(static_cast<std::size_t>(py), height - 2);
        const double fx = px - static_cast<double>(ix);
        const double fy = py - static_cast<double>(iy);
        return (1 - fy) * ((1 - fx) * node(ix, iy) + fx * node(ix + 1, iy)) +
               fy * ((1 - fx) * node(ix, iy + 1) + fx * node(ix + 1, iy + 1));
    }
    /// The integral over [0, x] of the row at y, by the trapezoid rule, which is exact.
    double row(double x, double y) const {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < width; ++i) {
            const double from = static_cast<double>(i) / static_cast<double>(width - 1);
            const double to =
                std::min(x, static_cast<double>(i + 1) / static_cast<double>(width - 1));
            if (to <= from) break;
            sum += (to - from) * (at(from, y) + at(to, y)) / 2;
        }
        return sum;
    }
};

}  // namespace

RglSamples::RglSamples(const std::filesystem::path& file) {
    const std::string bytes = bytesOf(file);
    std::size_t position = 14;
    if (bytes.compare(0, position, std::string("tensor_file\0\1\0", 14)) != 0) {
        throw std::runtime_error("no tensor file of version 1.0");
    }
    for (auto count = take<std::uint32_t>(bytes, position); count > 0; --count) {
        const auto length = take<std::uint16_t>(bytes, position);
        const std::string name = bytes.substr(position, length);
        position += length;
        Field field;
        const auto dimensions = take<std::uint16_t>(bytes, position);
        const auto type = take<std::uint8_t>(bytes, position);
        const auto offset = take<std::uint64_t>(bytes, position);
        std::size_t size = 1;
        for (int d = 0; d < dimensions; ++d) {
            field.sizes.push_back(take<std::uint64_t>(bytes, position));
            size *= field.sizes.back();
        }
        if (type == 1) field.bytes = bytes.substr(offset, size);
        if (type == 10) {
            field.values.resize(size);
            std::memcpy(field.values.data(), bytes.data() + offset, 4 * size);
        }
        fields_[name] = field;
    }
}

RglSamples::Integral RglSamples::integral(std::size_t phi, std::size_t theta,
                                          std::size_t side) const {
    const bool isotropic = fields_.at("phi_i").values.size() <= 2;
    const double phiIn = isotropic ? 0 : static_cast<double>(fields_.at("phi_i").values[phi]);
    const auto thetaIn = static_cast<double>(fields_.at("theta_i").values[theta]);
    const std::size_t slab = phi * fields_.at("theta_i").values.size() + theta;
    const auto table = [&](const char* name, std::size_t index) {
        const Field& field = fields_.at(name);
        const std::size_t height = field.sizes[field.sizes.size() - 2];
        const std::size_t width = field.sizes.back();
        return Table{field.values.data() + index * width * height, width, height};
    };
    const Table vndf = table("vndf", slab);
    const Table luminance = table("luminance", slab);
    const Table green = table("rgb", 3 * slab + 1);
    const Table ndf = table("ndf", 0);
    const Table sigma = table("sigma", 0);
    // Integrals of whole tables, which loaders scale to 1.
    const auto whole = [](const Table& t) {
        double sum = 0;
        for (std::size_t y = 0; y < t.height; ++y) {
            const double weight = y == 0 || y == t.height - 1 ? 0.5 : 1;
            sum += weight * t.row(1, static_cast<double>(y) / static_cast<double>(t.height - 1));
        }
        return sum / static_cast<double>(t.height - 1);
    };
    const double normals = whole(vndf);
    const double colors = whole(luminance);
    const double area = sigma.at(std::sqrt(2 * thetaIn / kPi), (phiIn + kPi) / (2 * kPi));
    const Imath::V3d in(std::sin(thetaIn) * std::cos(phiIn), std::sin(thetaIn) * std::sin(phiIn),
                        std::cos(thetaIn));
    Integral result;
    const double cell = 1 / static_cast<double>(side);
    double square = 0;
    double below = 0;  ///< The integral of the density up to the row, in y.
    for (std::size_t j = 0; j < side; ++j) {
        const double y = (static_cast<double>(j) + 0.5) * cell;
        const double row = vndf.row(1, y);
        const double sampleY = (below + row * cell / 2) / normals;
        below += row * cell;
        double along = 0;
        for (std::size_t i = 0; i < side; ++i) {
            const double x = (static_cast<double>(i) + 0.5) * cell;
            const double density = vndf.at(x, y);
            const double sampleX = row > 0 ? std::min(1.0, (along + density * cell / 2) / row) : 0;
            along += density * cell;
            const double thetaM = x * x * kPi / 2;
            const double phiM = (2 * y - 1) * kPi + (isotropic ? phiIn : 0);
            const Imath::V3d m(std::sin(thetaM) * std::cos(phiM), std::sin(thetaM) * std::sin(phiM),
                               std::cos(thetaM));
            const double cosine = in.dot(m);
            const double drawn =
                density / normals * luminance.at(sampleX, std::min(1.0, sampleY)) / colors;
            result.density += drawn * cell * cell;
            const double outZ = 2 * cosine * m.z - in.z;
            if (cosine <= 0 || outZ <= 0) continue;
            // f cos(theta_o) d omega_o over d u_m.
            const double energy = green.at(sampleX, std::min(1.0, sampleY)) * ndf.at(x, y) /
                                  (4 * area) * 4 * cosine * 2 * kPi * kPi * x * std::sin(thetaM);
            result.energy += energy * cell * cell;
            if (drawn > 0) square += energy * energy / drawn * cell * cell;
        }
    }
    result.weight = square / (result.energy * result.energy);
    return result;
}

}  // namespace abrdf
