// SPDX-License-Identifier: BSD-3-Clause
//
// Radiance's variable-resolution BSDF: XML of WINDOW 6 with Shirley-Chiu tensor trees [Ward et al.
// 2012; bsdf_t.c of the Radiance sources says how they are looked up]. Values are 1/sr, without the
// cosine; rank 3 leaves the azimuth of the light out.
#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "stages/export/isotropy.h"
#include "stages/export/tensor_tree.h"
#include "stages/export/turned_pair.h"
#include "stages/export/value_range.h"

#include <ImathMatrix.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace {

/// The cells of a tree, and how finely each is averaged.
struct Cells {
    int rank = 3;
    int levels = 6;
    int parts = 4;  ///< Places along each side of a cell's square of outgoing directions.

    std::size_t count() const { return std::size_t{1} << (rank * levels); }
    /// Rank 3 looks up the lower half of its first dimension only.
    std::size_t live() const { return rank == 3 ? count() / 2 : count(); }
};

Direction directionAt(DiskPlace place) {
    const double sine = std::min(1.0, std::hypot(place.x, place.y));
    return {std::asin(sine), wrappedAzimuth(std::atan2(place.y, place.x))};
}

/// The pair at a place of the cube: the light's square is seen from behind, so that light and its
/// mirror direction stand at the same place.
LightAndView pairAt(const Cells& cells, const std::array<double, 4>& u) {
    if (cells.rank == 3) {
        return {{std::asin(std::clamp(1 - 2 * u[0], 0.0, 1.0)), kPi},
                directionAt(diskFromSquare(u[1], u[2]))};
    }
    const DiskPlace behind = diskFromSquare(u[0], u[1]);
    return {directionAt({-behind.x, -behind.y}), directionAt(diskFromSquare(u[2], u[3]))};
}

/// A cell's corner, in cells.
std::array<double, 4> cornerOf(const Cells& cells, std::size_t index) {
    std::array<double, 4> corner{};
    for (int d = cells.rank - 1; d >= 0; --d) {
        corner[static_cast<std::size_t>(d)] =
            static_cast<double>(index & ((std::size_t{1} << cells.levels) - 1));
        index >>= cells.levels;
    }
    return corner;
}

bool isPastMeasured(const Cells& cells, std::size_t index, const ExportSource& source) {
    std::array<double, 4> u = cornerOf(cells, index);
    for (double& x : u) x = (x + 0.5) / static_cast<double>(std::size_t{1} << cells.levels);
    return source.brdf.isExtrapolated(pairAt(cells, u));
}

/// The mean over a cell's views for the light in its middle, so that for this light the file
/// reflects what the material does; turns of an isotropic sample take turns with the places.
Rgb cellValue(const Cells& cells, std::size_t index, const TurnedBrdf& brdf, int turns) {
    std::array<double, 4> u = cornerOf(cells, index);
    const std::array<double, 4> corner = u;
    const auto side = static_cast<double>(std::size_t{1} << cells.levels);
    const auto rank = static_cast<std::size_t>(cells.rank);
    for (std::size_t d = 0; d + 2 < rank; ++d) u[d] = (corner[d] + 0.5) / side;
    const int count = cells.parts * cells.parts;
    Rgb sum;
    for (int k = 0; k < count; ++k) {
        u[rank - 2] = (corner[rank - 2] + (k / cells.parts + 0.5) / cells.parts) / side;
        u[rank - 1] = (corner[rank - 1] + (k % cells.parts + 0.5) / cells.parts) / side;
        const LightAndView pair = pairAt(cells, u);
        const double scale = 1 / (count * std::max(1e-6, std::cos(pair.light.theta)));
        sum += static_cast<float>(scale) *
               brdf.evaluate(turns == 1 ? pair : turnedPair(pair, 2 * kPi * (k % turns) / turns));
    }
    return sum;
}

/// From linear Rec.709 to CIE XYZ whose white is of equal energy, as Radiance's: a grey stays grey
/// (Bradford's adaptation). Row vectors, as Imath's.
Imath::M33d xyzFromRec709() {
    const Imath::M33d d65(0.4123908, 0.2126390, 0.0193308, 0.3575843, 0.7151687, 0.1191948,
                          0.1804808, 0.0721923, 0.9505322);
    const Imath::M33d cones(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367,
                            1.0296);
    const Imath::V3d from = Imath::V3d(1, 1, 1) * d65 * cones;
    const Imath::V3d to = Imath::V3d(1, 1, 1) * cones;
    const Imath::M33d adaptation(to.x / from.x, 0, 0, 0, to.y / from.y, 0, 0, 0, to.z / from.z);
    return d65 * cones * adaptation * cones.inverse();
}

/// Y, u' and v' of each cell.
struct Planes {
    std::vector<float> luminance, u, v;
};

Planes planesOf(const std::vector<Rgb>& colors) {
    const Imath::M33d matrix = xyzFromRec709();
    Planes planes;
    for (const Rgb c : colors) {
        const Imath::V3d rgb(std::max(0.0F, c.r), std::max(0.0F, c.g), std::max(0.0F, c.b));
        const Imath::V3d xyz = rgb * matrix;
        const double sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
        planes.luminance.push_back(static_cast<float>(std::max(0.0, xyz.y)));
        planes.u.push_back(static_cast<float>(sum > 0 ? 4 * xyz.x / sum : 4.0 / 19));
        planes.v.push_back(static_cast<float>(sum > 0 ? 9 * xyz.y / sum : 9.0 / 19));
    }
    return planes;
}

std::string wavelengthData(const char* wavelength, const std::string& tree) {
    return fmt::format(
        "\t<WavelengthData>\n\t\t<LayerNumber>System</LayerNumber>\n"
        "\t\t<Wavelength unit=\"Integral\">{}</Wavelength>\n"
        "\t\t<SourceSpectrum>CIE Illuminant E 1nm.ssp</SourceSpectrum>\n"
        "\t\t<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n"
        "\t\t<WavelengthDataBlock>\n"
        "\t\t\t<WavelengthDataDirection>Reflection Back</WavelengthDataDirection>\n"
        "\t\t\t<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n"
        "\t\t\t<ScatteringDataType>BRDF</ScatteringDataType>\n"
        "\t\t\t<ScatteringData>\n{}\n\t\t\t</ScatteringData>\n"
        "\t\t</WavelengthDataBlock>\n\t</WavelengthData>\n",
        wavelength, tree);
}

/// XML has no control characters.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool isControl = static_cast<unsigned char>(c) < ' ';
        result += c == '<'    ? "&lt;"
                  : c == '&'  ? "&amp;"
                  : c == '>'  ? "&gt;"
                  : isControl ? " "
                              : std::string(1, c);
    }
    return result;
}

Cells cellsOf(const ExportSource& source, const ExportOptions& options, bool isotropic) {
    Cells cells = isotropic ? Cells{3, source.isSampled ? 5 : 6, 4}
                            : Cells{4, source.isSampled ? 4 : 5, source.isSampled ? 4 : 3};
    if (options.resolution == 0) return cells;
    const auto side = static_cast<unsigned>(options.resolution);
    if (!std::has_single_bit(side) || side > (isotropic ? 128U : 32U)) {
        throw std::invalid_argument(
            fmt::format("a tensor tree of rank {} has 8, 16, 32{} cells a side, not {}", cells.rank,
                        isotropic ? ", 64 or 128" : "", side));
    }
    cells.levels = std::countr_zero(side);
    return cells;
}

}  // namespace

ExportReport writeRadiance(const std::filesystem::path& path, const ExportSource& source,
                           const ExportOptions& options) {
    const Symmetries symmetries = symmetriesOf(source, options.azimuths);
    const bool isotropic = symmetries.turnDeltaE <= options.tolerance;
    const Cells cells = cellsOf(source, options, isotropic);
    const TurnedBrdf brdf(source, 1);
    std::vector<Rgb> colors(cells.count());
    forEachTexelBlock(cells.live(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            colors[i] = cellValue(cells, i, brdf, isotropic ? options.azimuths : 1);
        }
    });
    checkRange(colors, source);
    const Planes planes = planesOf(colors);
    double mean = 0;
    for (const float y : planes.luminance) mean += static_cast<double>(y);
    mean /= static_cast<double>(cells.live());
    // Differences far below the mean are not seen.
    constexpr double kFloor = 0.01;
    TreeOptions tree{cells.rank, cells.levels, options.cull / 100, kFloor * mean, cells.live()};
    const TensorTree luminance = tensorTree(planes.luminance, {}, tree);
    tree.floor = 0;
    const TensorTree u = tensorTree(planes.u, planes.luminance, tree);
    const TensorTree v = tensorTree(planes.v, planes.luminance, tree);
    writeWholeFile(
        path,
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<WindowElement xmlns=\"http://windows.lbl.gov\">\n"
                    "<WindowElementType>System</WindowElementType>\n"
                    "<Optical>\n<Layer>\n"
                    "\t<Material>\n\t\t<Name>{}</Name>\n"
                    "\t\t<Manufacturer>abrdf</Manufacturer>\n"
                    "\t\t<Thickness unit=\"meter\">0</Thickness>\n"
                    "\t\t<DeviceType>Other</DeviceType>\n\t</Material>\n"
                    "\t<DataDefinition>\n\t\t<IncidentDataStructure>TensorTree{}"
                    "</IncidentDataStructure>\n\t</DataDefinition>\n"
                    "{}{}{}</Layer>\n</Optical>\n</WindowElement>\n",
                    escaped(source.name), cells.rank, wavelengthData("Visible", luminance.text),
                    wavelengthData("CIE-u", u.text), wavelengthData("CIE-v", v.text)));
    ExportReport report;
    report.values = cells.live();
    for (std::size_t i = 0; i < cells.live(); ++i) {
        report.extrapolated += isPastMeasured(cells, i, source) ? 1U : 0U;
    }
    report.details = {
        {"layout", "XML of WINDOW, LBNL/Shirley-Chiu tensor trees of CIE Y, u' and v'"},
        {"value", "BRDF, 1/sr, white of equal energy; light first, then view"},
        {"isotropic", isotropic},
        {"rank", cells.rank},
        {"cells_a_side", std::size_t{1} << cells.levels},
        {"cull_percent", options.cull},
        {"leaves", {luminance.leaves, u.leaves, v.leaves}},
        {"cull_bound", {luminance.bound, u.bound, v.bound}}};
    report.details["symmetry"] = reportOf(symmetries);
    report.details["notes"] = notesOn(symmetries, options.tolerance);
    report.details["notes"].push_back(
        fmt::format("{} of {} leaves kept; none is off by more than {:.3g} % of its mean",
                    luminance.leaves, cells.live(), 100 * luminance.bound));
    return report;
}

}  // namespace abrdf
