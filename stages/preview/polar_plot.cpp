// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/polar_plot.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr int kRadius = 165;
constexpr int kColumn = 2 * kRadius + 50;
constexpr int kMargin = 46;
constexpr int kTop = 130;
constexpr int kLobe = kRadius + 70;  // Height of a lobe plot with its labels.
constexpr int kDisc = 2 * kRadius + 46;
constexpr int kDecades = 3;

double luminance(Rgb c) {
    return 0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) +
           0.0722 * static_cast<double>(c.b);
}

/// The view at `angle` in the plane of incidence: positive on the light's side, as in the
/// hemisphere of a light at phi 0.
Direction viewInPlane(Radians angle, Radians lightPhi) {
    return {std::abs(angle), wrappedAzimuth(angle >= 0 ? lightPhi : lightPhi + kPi)};
}

/// The values along the plane of incidence, two a degree from -90 to 90.
std::vector<double> lobe(const Atlas& atlas, const ColorTransform& toRec709, Direction light) {
    std::vector<double> values;
    for (int half = -180; half <= 180; ++half) {
        Rgb value =
            lookUp(atlas, light, viewInPlane(radiansFromDegrees(half / 2.0), light.phi), 0, 0);
        toRec709.apply({&value, 1});
        values.push_back(luminance(value));
    }
    return values;
}

/// The exponent of the outermost ring: the power of ten at or above all values.
int outermostRing(const std::vector<std::vector<double>>& lobes) {
    double most = 1e-6;
    for (const auto& values : lobes) {
        for (const double v : values) most = std::max(most, std::isfinite(v) ? v : 0);
    }
    return static_cast<int>(std::ceil(std::log10(most) - 1e-9));
}

class Plotter {
  public:
    Plotter(const PolarPlot& plot, const FigureColors& colors, const ColorTransform& toRec709)
        : plot_(plot),
          colors_(colors),
          toRec709_(toRec709),
          rows_(plot.reference != nullptr ? 3 : 1),
          drawing_(2 * kMargin + static_cast<int>(plot.lightThetas.size()) * kColumn - 50,
                   kTop + kLobe + rows_ * kDisc + (rows_ == 3 ? 50 : 6), figure::kBackground) {}

    CodedPicture draw() {
        drawing_.text(kMargin, 50, plot_.title, figure::kTitle);
        drawing_.text(kMargin, 74,
                      "Above: luminance in the plane of incidence, radius on a logarithmic scale. "
                      "Below: all views from above.",
                      figure::kNote);
        drawing_.text(kMargin, 92, colors_.note, figure::kNote);
        drawLegend();
        for (std::size_t i = 0; i < plot_.lightThetas.size(); ++i) drawColumn(i);
        if (rows_ == 3) {
            drawDeltaEBar(drawing_, kMargin, drawing_.height() - 50, 2 * kRadius);
            drawing_.text(kMargin + 2 * kRadius + 16, drawing_.height() - 38, "ΔE (CIE 1976)",
                          figure::kNote);
        }
        return drawing_.picture();
    }

  private:
    void drawLegend() {
        const double x = drawing_.width() - kMargin;
        const std::vector<PlacePoint> first{{x - 34, 44}, {x, 44}};
        drawing_.polyline(first, figure::kFirst, 2.5);
        drawing_.text(x - 42, 49, plot_.reference != nullptr ? "reconstruction" : "values",
                      figure::kText, TextAlign::kRight);
        if (plot_.reference == nullptr) return;
        const std::vector<PlacePoint> second{{x - 34, 66}, {x, 66}};
        drawing_.polyline(second, figure::kSecond, 2, 5);
        drawing_.text(x - 42, 71, "full measurement", figure::kText, TextAlign::kRight);
    }

    void drawColumn(std::size_t index) {
        const Direction light{plot_.lightThetas[index], plot_.lightPhi};
        const double x = kMargin + static_cast<double>(index) * kColumn;
        drawing_.text(x + kRadius, kTop,
                      fmt::format("light at θ {:g}°, φ {:g}°", degreesFromRadians(light.theta),
                                  degreesFromRadians(light.phi)),
                      figure::kHeading, TextAlign::kCenter);
        drawLobes(x + kRadius, kTop + 26 + kRadius, light);
        double y = kTop + kLobe;
        drawHemisphere(x, y, light, *plot_.atlas, "reconstruction");
        if (plot_.reference == nullptr) return;
        drawHemisphere(x, y += kDisc, light, *plot_.reference, "full measurement");
        drawDifference(x, y + kDisc, light);
    }

    void drawLobes(double x, double y, Direction light) {
        std::vector<std::vector<double>> lobes{lobe(*plot_.atlas, toRec709_, light)};
        if (plot_.reference != nullptr) lobes.push_back(lobe(*plot_.reference, toRec709_, light));
        const int top = outermostRing(lobes);
        drawGrid(x, y, top);
        // Towards the light, and where a mirror would send it.
        for (const double side : {-1.0, 1.0}) {
            const double s = side * std::sin(light.theta);
            const std::vector<PlacePoint> ray{
                {x, y}, {x + s * kRadius, y - std::cos(light.theta) * kRadius}};
            drawing_.polyline(ray, {170, 170, 170}, 1.2, side > 0 ? 0 : 3);
        }
        for (std::size_t i = lobes.size(); i-- > 0;) {
            std::vector<PlacePoint> points;
            for (int half = -180; half <= 180; ++half) {
                const double value = lobes[i][static_cast<std::size_t>(half + 180)];
                const double decades = value > 0 ? std::log10(value) - (top - kDecades) : 0;
                const double r = kRadius * std::clamp(decades / kDecades, 0.0, 1.0);
                const Radians angle = radiansFromDegrees(half / 2.0);
                points.push_back({x + r * std::sin(angle), y - r * std::cos(angle)});
            }
            drawing_.polyline(points, i == 0 ? figure::kFirst : figure::kSecond, i == 0 ? 2.5 : 2,
                              i == 0 ? 0 : 5);
        }
    }

    void drawGrid(double x, double y, int top) {
        for (int ring = 1; ring <= kDecades; ++ring) {
            std::vector<PlacePoint> arc;
            for (int degrees = -90; degrees <= 90; degrees += 2) {
                const double r = static_cast<double>(kRadius) * ring / kDecades;
                arc.push_back({x + r * std::sin(radiansFromDegrees(degrees)),
                               y - r * std::cos(radiansFromDegrees(degrees))});
            }
            drawing_.polyline(arc, ring == kDecades ? figure::kFrame : figure::kFaint, 1);
            drawing_.text(x + static_cast<double>(kRadius) * ring / kDecades, y + 16,
                          fmt::format("{:g}", std::pow(10.0, top - kDecades + ring)), figure::kNote,
                          TextAlign::kCenter);
        }
        for (int degrees = -90; degrees <= 90; degrees += 30) {
            const double s = std::sin(radiansFromDegrees(degrees));
            const double c = std::cos(radiansFromDegrees(degrees));
            const std::vector<PlacePoint> spoke{{x, y}, {x + s * kRadius, y - c * kRadius}};
            drawing_.polyline(spoke, figure::kFaint, 1);
            if (std::abs(degrees) == 90) continue;
            drawing_.text(x + s * (kRadius + 14), y - c * (kRadius + 14) + 5,
                          fmt::format("{}°", std::abs(degrees)), figure::kNote, TextAlign::kCenter);
        }
    }

    /// The values of all views, 2 * kRadius on a side.
    std::vector<Rgb> hemisphere(const Atlas& atlas, Direction light) const {
        constexpr std::size_t kSide = 2 * kRadius;
        std::vector<Rgb> values(kSide * kSide);
        forEachTexel(values.size(), [&](std::size_t i) {
            const std::size_t column = i % kSide;
            const std::size_t row = i / kSide;
            const double px = (static_cast<double>(column) + 0.5) / kRadius - 1;
            const double py = 1 - (static_cast<double>(row) + 0.5) / kRadius;
            if (const auto view = viewOnHemisphere({px, py})) {
                values[i] = lookUp(atlas, light, *view, 0, 0);
            }
        });
        return values;
    }

    void drawDisc(double x, double y, Direction light, const std::vector<Srgb8>& colors,
                  const std::string& label) {
        drawing_.disc(x, y, 2 * kRadius, 2 * kRadius, colors);
        drawing_.circle(x + kRadius, y + kRadius, kRadius, figure::kFrame, 1);
        const PlacePoint at = placeOnHemisphere(light);
        const double lx = x + kRadius * (1 + at.x);
        const double ly = y + kRadius * (1 - at.y);
        drawing_.circle(lx, ly, 5, {20, 20, 20}, 3.5);
        drawing_.circle(lx, ly, 5, {250, 250, 250}, 1.5);
        drawing_.text(x + kRadius, y + 2 * kRadius + 22, label, figure::kText, TextAlign::kCenter);
    }

    void drawHemisphere(double x, double y, Direction light, const Atlas& atlas,
                        const std::string& label) {
        drawDisc(x, y, light, shownColors(hemisphere(atlas, light), colors_),
                 plot_.reference != nullptr ? label : "views from above; ring: the light");
    }

    void drawDifference(double x, double y, Direction light) {
        std::vector<Rgb> a = hemisphere(*plot_.atlas, light);
        std::vector<Rgb> b = hemisphere(*plot_.reference, light);
        toRec709_.apply(a);
        toRec709_.apply(b);
        std::vector<float> difference(a.size());
        const auto exposure = static_cast<float>(colors_.exposure);
        for (std::size_t i = 0; i < a.size(); ++i) {
            difference[i] = static_cast<float>(deltaE76(labFromLinearRec709(exposure * a[i]),
                                                        labFromLinearRec709(exposure * b[i])));
        }
        drawDisc(x, y, light, deltaEColors(difference), "ΔE");
    }

    const PolarPlot& plot_;
    const FigureColors& colors_;
    const ColorTransform& toRec709_;
    int rows_;
    Drawing drawing_;
};

}  // namespace

PlacePoint placeOnHemisphere(Direction view) {
    const double r = view.theta / (kPi / 2);
    return {r * std::cos(view.phi), r * std::sin(view.phi)};
}

std::optional<Direction> viewOnHemisphere(const PlacePoint& place) {
    const double r = std::hypot(place.x, place.y);
    if (r > 1) return std::nullopt;
    return Direction{r * kPi / 2, r > 0 ? wrappedAzimuth(std::atan2(place.y, place.x)) : 0};
}

CodedPicture drawPolarPlot(const PolarPlot& plot, const FigureColors& colors,
                           const ColorTransform& toLinearRec709) {
    return Plotter(plot, colors, toLinearRec709).draw();
}

}  // namespace abrdf
