// SPDX-License-Identifier: BSD-3-Clause
//
// RGL tensor file .bsdf [Dupuy and Jakob 2018, "An adaptive parameterization for efficient material
// acquisition and rendering"]: f cos(theta_o) = S(warped u_m) D(m) / (4 sigma(w_i)), in which w_i
// is the viewer's side, as path tracers ask it.
#include "abrdf/rgl_table.h"
#include "stages/export/isotropy.h"
#include "stages/export/normal_distribution.h"
#include "stages/export/rgl_nodes.h"
#include "stages/export/smooth_spectra.h"
#include "stages/export/tensor_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

const RglShape kIsotropic{true, 1, 128, 128, radiansFromDegrees(1.5), {}};
const RglShape kIsotropicSampled{true, 1, 128, 64, radiansFromDegrees(5), {}};
const RglShape kAnisotropic{false, 25, 64, 32, radiansFromDegrees(7.5), {}};
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

TableStack stack(const DirectionNodes& nodes, const std::vector<double>& values) {
    return {nodes.thetas, nodes.phis, std::vector<float>(values.begin(), values.end())};
}

/// What a renderer draws samples by: the luminance of S, as it counts in the energy. A table that
/// is black all over is drawn from evenly.
std::vector<float> luminances(const RglNodes& nodes, std::size_t size) {
    std::vector<float> values(nodes.values.size());
    for (std::size_t begin = 0; begin < values.size(); begin += size) {
        float most = 0;
        for (std::size_t i = begin; i < begin + size; ++i) {
            values[i] =
                std::max(0.0F, static_cast<float>(luminanceOf(nodes.values[i])) * nodes.shares[i]);
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
std::vector<float> everyAzimuth(const RglShape& shape, std::vector<float> values) {
    const auto count = static_cast<std::ptrdiff_t>(values.size());
    if (!shape.isotropic) return values;
    values.resize(2 * values.size());
    std::copy_n(values.begin(), count, values.begin() + count);
    return values;
}

/// The parts of a file that are there whatever its colours.
struct Frame {
    RglShape shape;
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
    RglShape& shape = frame.shape;
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

TensorFile fileOf(const Frame& frame, const RglNodes& nodes, const std::string& description,
                  bool hasSpectra) {
    const RglShape& shape = frame.shape;
    const DirectionNodes& normals = frame.normals.nodes;
    const std::size_t size = shape.side * shape.side;
    std::vector<float> phiIn;
    for (std::size_t p = 0; p < (shape.isotropic ? 2 : shape.phis); ++p) {
        phiIn.push_back(static_cast<float>(shape.isotropic ? phiFromRgl(static_cast<double>(p))
                                                           : shape.incident(p, 0).phi));
    }
    const std::uint64_t phis = phiIn.size();
    const std::uint64_t thetas = shape.thetas.size();
    TensorFile file;
    file.add("description", description);
    file.add("phi_i", {phis}, phiIn);
    file.add("theta_i", {thetas}, shape.thetas);
    file.add("ndf", {normals.phis, normals.thetas}, floats(frame.normals.density));
    file.add("sigma", {normals.phis, normals.thetas}, floats(frame.normals.area));
    file.add("vndf", {phis, thetas, shape.warp, shape.warp},
             everyAzimuth(shape, frame.data.vndf.values()));
    file.add("luminance", {phis, thetas, shape.side, shape.side},
             everyAzimuth(shape, luminances(nodes, size)));
    const auto channel = [](Rgb c, std::size_t k) { return k == 0 ? c.r : k == 1 ? c.g : c.b; };
    file.add("rgb", {phis, thetas, 3, shape.side, shape.side},
             everyAzimuth(shape, planesOf(nodes.values, size, 3, channel)));
    if (hasSpectra) {
        std::vector<float> wavelengths;
        for (std::size_t k = 0; k < spectra::kCount; ++k) {
            wavelengths.push_back(
                static_cast<float>(spectra::kFirst + spectra::kStep * static_cast<double>(k)));
        }
        file.add("wavelengths", {spectra::kCount}, wavelengths);
        file.add("spectra", {phis, thetas, spectra::kCount, shape.side, shape.side},
                 everyAzimuth(shape, planesOf(nodes.values, size, spectra::kCount, spectra::at)));
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
    RglNodes nodes = nodesOf(frame.shape, frame.data, source, brdf);
    const double reflectance = keepEnergy(frame.shape, nodes);
    fileOf(frame, nodes, source.name, options.spectra).write(path);
    ExportReport report;
    report.values = nodes.places.size() -
                    static_cast<std::size_t>(std::ranges::count(nodes.places, std::uint8_t{0}));
    report.extrapolated =
        static_cast<std::uint64_t>(std::ranges::count(nodes.places, std::uint8_t{2}));
    report.details = {
        {"layout",
         fmt::format("tensor file 1.0: phi_i theta_i ndf sigma vndf luminance rgb {}jacobian",
                     options.spectra ? "wavelengths spectra " : "")},
        {"value", "S of f cos(theta_o) = S ndf(m) / (4 sigma(w_i)), w_i the viewer's side"},
        {"isotropic", isotropic},
        {"directions", {isotropic ? 2 : frame.shape.phis, frame.shape.thetas.size()}},
        {"samples_a_side", frame.shape.side},
        {"ndf", "from retro-reflection by power iterations"},
        {"spectra", options.spectra ? "three smooth primaries, linear" : "none"},
        {"largest_reflectance", reflectance}};
    report.details["symmetry"] = reportOf(symmetries);
    report.details["notes"] = notesOn(symmetries, options.tolerance);
    if (reflectance > 1 && source.isSampled) {
        report.details["notes"].push_back(fmt::format(
            "reflects up to {:.2f} times what it receives: a highlight narrower than the atlas's "
            "directions reads too bright between them; export the database itself, or convert it "
            "with a finer --grid",
            reflectance));
    }
    return report;
}

}  // namespace abrdf
