// SPDX-License-Identifier: BSD-3-Clause
//
// RGL tensor file .bsdf [Dupuy and Jakob 2018, "An adaptive parameterization for efficient material
// acquisition and rendering"]: f cos(theta_o) = S(warped u_m) D(m) / (4 sigma(w_i)), in which w_i
// is the viewer's side, as path tracers ask it.
#include "abrdf/for_each_texel.h"
#include "abrdf/rgl_table.h"
#include "stages/export/isotropy.h"
#include "stages/export/normal_distribution.h"
#include "stages/export/smooth_spectra.h"
#include "stages/export/tensor_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr TableBlend kOnly = {{0, 0, 0, 0}, {1, 0, 0, 0}};

/// How finely a file is tabulated.
struct Shape {
    bool isotropic = true;
    std::size_t phis = 1;       ///< Azimuths of w_i that differ.
    std::size_t warp = 0;       ///< Side of a table of visible normals.
    std::size_t side = 0;       ///< Side of a table of samples.
    Radians step = 0;           ///< Of the elevations of w_i, at most.
    std::vector<float> thetas;  ///< 0 .. pi/2.
};

const Shape kIsotropic{true, 1, 128, 128, radiansFromDegrees(1.5), {}};
const Shape kIsotropicSampled{true, 1, 128, 64, radiansFromDegrees(5), {}};
const Shape kAnisotropic{false, 25, 64, 32, radiansFromDegrees(7.5), {}};
constexpr std::size_t kDistributionPhis = 65;

/// The source's own elevations, from the normal to the horizon, and others between them.
std::vector<float> elevations(const BrdfTable& brdf, Radians step) {
    std::vector<Radians> nodes = {0};
    std::vector<Radians> wanted = brdf.viewElevations();
    wanted.push_back(kPi / 2);
    constexpr Radians kSame = radiansFromDegrees(0.01);
    for (const Radians next : wanted) {
        const Radians gap = std::min(next, kPi / 2) - nodes.back();
        if (gap < kSame) continue;
        const double parts = std::ceil(gap / step - 1e-6);
        const Radians from = nodes.back();
        for (double i = 1; i <= parts; ++i) nodes.push_back(from + gap * i / parts);
    }
    return {nodes.begin(), nodes.end()};
}

Direction incident(const Shape& shape, std::size_t phi, std::size_t theta) {
    const double turn =
        shape.phis == 1 ? 0.5 : static_cast<double>(phi) / static_cast<double>(shape.phis - 1);
    return {static_cast<double>(shape.thetas[theta]), phiFromRgl(turn)};
}

TableStack stack(const DirectionNodes& nodes, const std::vector<double>& values) {
    return {nodes.thetas, nodes.phis, std::vector<float>(values.begin(), values.end())};
}

/// Of the samples, what goes to the visible normals of a Lambertian's D = 1/pi: where D alone is
/// small there would be none.
constexpr double kBroad = 0.2;

/// D(m) <w_i, m> / sigma(w_i), the density of visible normals.
double visible(double density, double area, double cosine) {
    return density * std::max(0.0, cosine) / area;
}

/// The density that samples are warped by, over u_m: d omega_m = 2 pi^2 u sin(theta_m) d u_m.
std::vector<float> sampleDensity(const Shape& shape, const TableStack& ndf,
                                 const TableStack& sigma) {
    const std::size_t size = shape.warp * shape.warp;
    std::vector<float> values(shape.phis * shape.thetas.size() * size);
    const auto last = static_cast<double>(shape.warp - 1);
    forEachTexel(shape.phis * shape.thetas.size(), [&](std::size_t table) {
        const Direction in =
            incident(shape, table / shape.thetas.size(), table % shape.thetas.size());
        const Imath::V3d toViewer = vectorFromDirection(in);
        const double area = sigma.at({rglFromTheta(in.theta), rglFromPhi(in.phi)}, kOnly);
        for (std::size_t i = 0; i < size; ++i) {
            const SquarePlace place = {static_cast<double>(i % shape.warp) / last,
                                       static_cast<double>(i / shape.warp) / last};
            const Direction m = {thetaFromRgl(place.x), phiFromRgl(place.y)};
            const double cosine = toViewer.dot(vectorFromDirection(m));
            const double angle = 2 * kPi * kPi * place.x * std::sin(m.theta);
            const double density = (1 - kBroad) * visible(ndf.at(place, kOnly), area, cosine) +
                                   kBroad * visible(1 / kPi, (1 + toViewer.z) / 2, cosine);
            values[table * size + i] = static_cast<float>(density * angle);
        }
    });
    return values;
}

/// S, a table of side x side for each w_i.
struct Samples {
    std::vector<Rgb> values;
    std::vector<float>
        shares;  ///< What a sample counts in the energy: visible over sample density.
    std::vector<std::uint8_t> places;  ///< 0 below the horizon, 1 above, 2 past what was measured.
};

Samples samplesOf(const Shape& shape, const RglData& data, const ExportSource& source,
                  const TurnedBrdf& brdf) {
    const TabulatedWarp warp(data.vndf);
    const std::size_t size = shape.side * shape.side;
    const std::size_t count = shape.phis * shape.thetas.size() * size;
    Samples samples{std::vector<Rgb>(count), std::vector<float>(count),
                    std::vector<std::uint8_t>(count)};
    const auto last = static_cast<double>(shape.side - 1);
    forEachTexelBlock(count, shape.side, [&](std::size_t begin, std::size_t end) {
        const std::size_t table = begin / size;
        const Direction in =
            incident(shape, table / shape.thetas.size(), table % shape.thetas.size());
        const Imath::V3d toViewer = vectorFromDirection(in);
        const double area = data.sigma.at({rglFromTheta(in.theta), rglFromPhi(in.phi)}, kOnly);
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t node = i % size;
            const SquarePlace place = warp.warp({static_cast<double>(node % shape.side) / last,
                                                 static_cast<double>(node / shape.side) / last},
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
            samples.values[i] = static_cast<float>(4 * area / density) * brdf.evaluate(pair);
            samples.shares[i] = static_cast<float>(
                seen /
                ((1 - kBroad) * seen + kBroad * visible(1 / kPi, (1 + toViewer.z) / 2, cosine)));
            samples.places[i] = source.brdf.isExtrapolated(pair) ? 2 : 1;
        }
    });
    return samples;
}

/// The hemispherical reflectance that a table holds, of each channel: the integral of S over its
/// samples.
std::array<double, 3> albedoOf(const Samples& samples, std::size_t begin, std::size_t side) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < side * side; ++i) {
        const auto edge = [&](std::size_t at) { return at == 0 || at == side - 1 ? 0.5 : 1.0; };
        const double weight = edge(i % side) * edge(i / side) *
                              static_cast<double>(samples.shares[begin + i]) /
                              static_cast<double>((side - 1) * (side - 1));
        const Rgb s = samples.values[begin + i];
        sum[0] += weight * static_cast<double>(s.r);
        sum[1] += weight * static_cast<double>(s.g);
        sum[2] += weight * static_cast<double>(s.b);
    }
    return sum;
}

void checkRange(const Samples& samples, const std::filesystem::path& path) {
    if (std::ranges::all_of(samples.values, isFinite)) return;
    throw std::runtime_error(fmt::format(
        "{}: the material has values past what the format's floats hold; look for the texels at "
        "fault with abrdf inspect, or scale them",
        path.string()));
}

/// A reflectance that rounding and interpolation alone bring above 1 is brought back; one that is
/// above it in the source stays. Returns the largest, as written.
double keepEnergy(const Shape& shape, Samples& samples) {
    constexpr double kRounding = 0.01;
    constexpr double kBound = 0.999;
    const std::size_t size = shape.side * shape.side;
    double largest = 0;
    for (std::size_t begin = 0; begin < samples.values.size(); begin += size) {
        const auto albedo = albedoOf(samples, begin, shape.side);
        const double most = std::ranges::max(albedo);
        const bool isExcess = most > kBound && most < 1 + kRounding;
        if (isExcess) {
            for (std::size_t i = 0; i < size; ++i) {
                samples.values[begin + i] *= static_cast<float>(kBound / most);
            }
        }
        largest = std::max(largest, isExcess ? kBound : most);
    }
    return largest;
}

/// What a renderer draws samples by: the luminance of S, as it counts in the energy. A table that
/// is black all over is drawn from evenly.
std::vector<float> luminances(const Samples& samples, std::size_t size) {
    std::vector<float> values(samples.values.size());
    for (std::size_t begin = 0; begin < values.size(); begin += size) {
        float most = 0;
        for (std::size_t i = begin; i < begin + size; ++i) {
            values[i] = std::max(
                0.0F, static_cast<float>(luminanceOf(samples.values[i])) * samples.shares[i]);
            most = std::max(most, values[i]);
        }
        if (most <= 0) std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(begin), size, 1.0F);
    }
    return values;
}

/// value(color, plane) of each table, plane after plane.
template <typename Value>
std::vector<float> planesOf(const std::vector<Rgb>& colors, std::size_t size, std::size_t planes,
                            const Value& value) {
    std::vector<float> result;
    result.reserve(planes * colors.size());
    for (std::size_t begin = 0; begin < colors.size(); begin += size) {
        for (std::size_t plane = 0; plane < planes; ++plane) {
            for (std::size_t i = 0; i < size; ++i) {
                result.push_back(value(colors[begin + i], plane));
            }
        }
    }
    return result;
}

/// Tables of the azimuths of w_i; of an isotropic material's one azimuth twice.
std::vector<float> everyAzimuth(const Shape& shape, std::vector<float> values) {
    const auto count = static_cast<std::ptrdiff_t>(values.size());
    if (!shape.isotropic) return values;
    values.resize(2 * values.size());
    std::copy_n(values.begin(), count, values.begin() + count);
    return values;
}

/// The parts of a file that are there whatever its colours.
struct Frame {
    Shape shape;
    NormalDistribution normals;
    RglData data;  ///< Without colours.
};

Frame frameOf(const ExportSource& source, const ExportOptions& options, bool isotropic,
              const TurnedBrdf& brdf) {
    Frame frame{!isotropic         ? kAnisotropic
                : source.isSampled ? kIsotropicSampled
                                   : kIsotropic,
                distributionFromRetro(isotropic ? 2 : kDistributionPhis,
                                      [&](Direction m) {
                                          return luminanceOf(brdf.evaluate({m, m}));
                                      }),
                {{}, {}, {2, 2, {}}, {2, 2, {}}, {2, 2, {}}, {2, 2, {}}, true}};
    Shape& shape = frame.shape;
    shape.thetas = elevations(source.brdf, shape.step);
    if (options.resolution > 0) shape.side = static_cast<std::size_t>(options.resolution);
    frame.data.ndf = stack(frame.normals.nodes, frame.normals.density);
    frame.data.sigma = stack(frame.normals.nodes, frame.normals.area);
    frame.data.vndf = {shape.warp, shape.warp,
                       sampleDensity(shape, frame.data.ndf, frame.data.sigma)};
    return frame;
}

std::vector<float> floats(const std::vector<double>& values) {
    return {values.begin(), values.end()};
}

TensorFile fileOf(const Frame& frame, const Samples& samples, const std::string& description,
                  bool hasSpectra) {
    const Shape& shape = frame.shape;
    const DirectionNodes& nodes = frame.normals.nodes;
    const std::size_t size = shape.side * shape.side;
    std::vector<float> phiIn;
    for (std::size_t p = 0; p < (shape.isotropic ? 2 : shape.phis); ++p) {
        phiIn.push_back(static_cast<float>(shape.isotropic ? phiFromRgl(static_cast<double>(p))
                                                           : incident(shape, p, 0).phi));
    }
    const std::uint64_t phis = phiIn.size();
    const std::uint64_t thetas = shape.thetas.size();
    TensorFile file;
    file.add("description", description);
    file.add("phi_i", {phis}, phiIn);
    file.add("theta_i", {thetas}, shape.thetas);
    file.add("ndf", {nodes.phis, nodes.thetas}, floats(frame.normals.density));
    file.add("sigma", {nodes.phis, nodes.thetas}, floats(frame.normals.area));
    file.add("vndf", {phis, thetas, shape.warp, shape.warp},
             everyAzimuth(shape, frame.data.vndf.values()));
    file.add("luminance", {phis, thetas, shape.side, shape.side},
             everyAzimuth(shape, luminances(samples, size)));
    const auto channel = [](Rgb c, std::size_t k) { return k == 0 ? c.r : k == 1 ? c.g : c.b; };
    file.add("rgb", {phis, thetas, 3, shape.side, shape.side},
             everyAzimuth(shape, planesOf(samples.values, size, 3, channel)));
    if (hasSpectra) {
        std::vector<float> wavelengths;
        for (std::size_t k = 0; k < spectra::kCount; ++k) {
            wavelengths.push_back(
                static_cast<float>(spectra::kFirst + spectra::kStep * static_cast<double>(k)));
        }
        file.add("wavelengths", {spectra::kCount}, wavelengths);
        file.add("spectra", {phis, thetas, spectra::kCount, shape.side, shape.side},
                 everyAzimuth(shape, planesOf(samples.values, size, spectra::kCount, spectra::at)));
    }
    file.add("jacobian", std::string(1, '\1'));
    return file;
}

}  // namespace

ExportReport writeRgl(const std::filesystem::path& path, const ExportSource& source,
                      const ExportOptions& options) {
    const Symmetries symmetries = symmetriesOf(source, options.azimuths);
    const bool isotropic = symmetries.turnDeltaE <= options.tolerance;
    // One turn is all where they are the same.
    const bool isOneTurn = !isotropic || symmetries.turnShare < 1e-9;
    const TurnedBrdf brdf(source, isOneTurn ? 1 : options.azimuths);
    const Frame frame = frameOf(source, options, isotropic, brdf);
    Samples samples = samplesOf(frame.shape, frame.data, source, brdf);
    checkRange(samples, path);
    const double reflectance = keepEnergy(frame.shape, samples);
    fileOf(frame, samples, source.name, options.spectra).write(path);
    ExportReport report;
    report.values = samples.places.size() -
                    static_cast<std::size_t>(std::ranges::count(samples.places, std::uint8_t{0}));
    report.extrapolated =
        static_cast<std::uint64_t>(std::ranges::count(samples.places, std::uint8_t{2}));
    report.details = {
        {"layout", "tensor file 1.0: phi_i theta_i ndf sigma vndf luminance rgb jacobian"},
        {"value", "S of f cos(theta_o) = S ndf(m) / (4 sigma(w_i)), w_i the viewer's side"},
        {"isotropic", isotropic},
        {"directions", {isotropic ? 2 : frame.shape.phis, frame.shape.thetas.size()}},
        {"samples_a_side", frame.shape.side},
        {"ndf", "from retro-reflection by power iterations"},
        {"spectra", options.spectra ? "three smooth primaries, linear" : "none"},
        {"largest_reflectance", reflectance}};
    report.details["symmetry"] = reportOf(symmetries);
    report.details["notes"] = notesOn(symmetries, options.tolerance);
    return report;
}

}  // namespace abrdf
