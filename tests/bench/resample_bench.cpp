// SPDX-License-Identifier: BSD-3-Clause
//
// Ways between angular grids, compared: measured materials and the virtual twill are sampled on
// UBO2003's 81 x 81 pairs and wanted at 2000 random pairs within 75 degrees.
// `resample_bench DATA`: the folder of real files (../shared/data). Mean CIE 1976 Delta E.
#include "abrdf/pair_interpolation.h"
#include "abrdf/random.h"
#include "abrdf/stopwatch.h"
#include "color/delta_e.h"
#include "stages/read/btf_reader.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace abrdf;

struct Material {
    std::string name;
    std::vector<Rgb> values;  ///< On ubo81.
    std::vector<LightAndView> wanted;
    std::vector<Rgb> truth;
};

/// Weights of the list's directions at another one.
using ListWeights = std::function<DirectionWeights(Direction)>;
using Estimate = std::function<Rgb(const LightAndView&, std::span<const Rgb>)>;

/// Light and view apart.
Estimate separate(const ListWeights& weights) {
    return [weights](const LightAndView& pair, std::span<const Rgb> values) {
        const DirectionWeights lights = weights(pair.light);
        const DirectionWeights views = weights(pair.view);
        Rgb sum;
        for (const auto& l : lights.terms) {
            for (const auto& v : views.terms) {
                sum += static_cast<float>(l.weight * v.weight) * values[81 * l.index + v.index];
            }
        }
        return sum;
    };
}

std::vector<Imath::V3d> vectorsOf(const std::vector<Direction>& directions) {
    std::vector<Imath::V3d> vectors;
    for (const Direction& d : directions) vectors.push_back(vectorFromDirection(d));
    return vectors;
}

/// The faces of the convex hull that look upwards: the spherical Delaunay triangles.
class Delaunay {
  public:
    explicit Delaunay(const std::vector<Direction>& directions) : nodes_(vectorsOf(directions)) {
        const std::size_t n = nodes_.size();
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = a + 1; b < n; ++b) {
                for (std::size_t c = b + 1; c < n; ++c) {
                    if (isFace(a, b, c)) faces_.push_back({a, b, c});
                }
            }
        }
    }

    DirectionWeights weights(Direction target) const {
        const Imath::V3d t = vectorFromDirection(target);
        DirectionWeights best;
        double most = -1e9;
        for (const auto& face : faces_) {
            Eigen::Matrix3d corners;
            for (int j = 0; j < 3; ++j) {
                const Imath::V3d& v = nodes_[face[static_cast<std::size_t>(j)]];
                corners.col(j) << v.x, v.y, v.z;
            }
            const Eigen::Vector3d w = corners.inverse() * Eigen::Vector3d(t.x, t.y, t.z);
            if (w.minCoeff() <= most) continue;
            most = w.minCoeff();
            best = {};
            for (int j = 0; j < 3; ++j) {
                best.add(face[static_cast<std::size_t>(j)], w(j) / w.sum());
            }
        }
        return best;
    }

  private:
    bool isFace(std::size_t a, std::size_t b, std::size_t c) const {
        Imath::V3d normal = (nodes_[b] - nodes_[a]).cross(nodes_[c] - nodes_[a]);
        if (normal.length() < 1e-9) return false;
        normal.normalize();
        if ((normal ^ nodes_[a]) < 0) normal = -normal;
        const double height = normal ^ nodes_[a];
        return height > 0.3 && std::ranges::all_of(nodes_, [&](const Imath::V3d& v) {
                   return (normal ^ v) <= height + 1e-9;
               });
    }

    std::vector<Imath::V3d> nodes_;
    std::vector<std::array<std::size_t, 3>> faces_;
};

/// Thin plates through the twelve nearest directions, with a linear polynomial.
DirectionWeights thinPlate(const std::vector<Imath::V3d>& nodes, Direction target) {
    constexpr Eigen::Index kNodes = 12;
    constexpr Eigen::Index kLinear = 4;
    const Imath::V3d t = vectorFromDirection(target);
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < nodes.size(); ++i) nearest.emplace_back((nodes[i] - t).length(), i);
    std::ranges::sort(nearest);
    const auto plate = [](double r) { return r > 0 ? r * r * std::log(r) : 0; };
    const auto linear = [](const Imath::V3d& v) { return Eigen::Vector4d(1, v.x, v.y, v.z); };
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(kNodes + kLinear, kNodes + kLinear);
    Eigen::VectorXd right(kNodes + kLinear);
    for (Eigen::Index i = 0; i < kNodes; ++i) {
        const Imath::V3d& a = nodes[nearest[static_cast<std::size_t>(i)].second];
        for (Eigen::Index j = 0; j < kNodes; ++j) {
            const Imath::V3d& b = nodes[nearest[static_cast<std::size_t>(j)].second];
            system(i, j) = plate((a - b).length());
        }
        system.block<1, kLinear>(i, kNodes) = linear(a).transpose();
        system.block<kLinear, 1>(kNodes, i) = linear(a);
        right(i) = plate(nearest[static_cast<std::size_t>(i)].first);
    }
    right.tail<kLinear>() = linear(t);
    const Eigen::VectorXd w = system.completeOrthogonalDecomposition().solve(right);
    DirectionWeights weights;
    for (Eigen::Index i = 0; i < kNodes; ++i) {
        weights.add(nearest[static_cast<std::size_t>(i)].second, w(i));
    }
    return weights;
}

std::vector<float> floatsOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    std::vector<float> floats(bytes.size() / sizeof(float));
    std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
    return floats;
}

std::vector<Material> materialsIn(const fs::path& data) {
    const AngularGrid grid(ubo81Directions());
    std::vector<Material> materials;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(data / "rgl")) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        const auto reader = openBtf(file);
        Material m{file.stem().string(), {}, {}, {}};
        for (const LightAndView& p : pairsOf(grid))
            m.values.push_back(reader->table()->evaluate(p));
        Random random(5);
        for (int i = 0; i < 2000; ++i) {
            const auto direction = [&] {
                return Direction{std::acos(random.uniform(std::cos(radiansFromDegrees(75)), 1)),
                                 random.uniform(0, 2 * kPi)};
            };
            m.wanted.push_back({direction(), direction()});
            m.truth.push_back(reader->table()->evaluate(m.wanted.back()));
        }
        materials.push_back(std::move(m));
    }
    Material twill{"twill", {}, {}, {}};
    const std::vector<float> mean = floatsOf(data / "virtual/twill_mean_f32.bin");
    for (std::size_t i = 0; i + 2 < mean.size(); i += 3) {
        twill.values.push_back({mean[i], mean[i + 1], mean[i + 2]});
    }
    const std::vector<float> rows = floatsOf(data / "virtual/twill_offgrid_f32.bin");
    for (std::size_t i = 0; i + 6 < rows.size(); i += 7) {
        twill.wanted.push_back({{rows[i], rows[i + 1]}, {rows[i + 2], rows[i + 3]}});
        twill.truth.push_back({rows[i + 4], rows[i + 5], rows[i + 6]});
    }
    materials.push_back(std::move(twill));
    return materials;
}

void compare(const std::vector<Material>& materials, const char* name, const Estimate& estimate) {
    std::cout << fmt::format("{:<28}", name);
    double sum = 0;
    const abrdf::Stopwatch time;
    std::size_t count = 0;
    for (const Material& m : materials) {
        double error = 0;
        for (std::size_t i = 0; i < m.wanted.size(); ++i) {
            const Rgb c = estimate(m.wanted[i], m.values);
            const Rgb light = {std::max(0.0F, c.r), std::max(0.0F, c.g), std::max(0.0F, c.b)};
            error += deltaE76(labFromLinearRec709(light), labFromLinearRec709(m.truth[i]));
            ++count;
        }
        error /= static_cast<double>(m.wanted.size());
        std::cout << fmt::format(" {:6.2f}", error);
        sum += error;
    }
    const double seconds = time.seconds();
    std::cout << fmt::format("   mean {:5.2f}   {:6.2f} us\n",
                             sum / static_cast<double>(materials.size()),
                             1e6 * seconds / static_cast<double>(count))
              << std::flush;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "resample_bench DATA: the folder of rgl/ and virtual/\n";
        return 2;
    }
    const std::vector<Material> materials = materialsIn(argv[1]);
    const AngularGrid grid(ubo81Directions());
    for (const Material& m : materials) std::cout << m.name << " ";
    std::cout << "\n";
    const AngularInterpolation rings(grid.lights());
    compare(materials, "ring-bilinear", separate([&](Direction d) { return rings.weights(d); }));
    compare(materials, "ring-cubic", separate([&](Direction d) { return rings.smoothWeights(d); }));
    const Delaunay delaunay(grid.lights());
    compare(materials, "spherical Delaunay",
            separate([&](Direction d) { return delaunay.weights(d); }));
    const std::vector<Imath::V3d> nodes = vectorsOf(grid.lights());
    compare(materials, "local RBF, thin plate, 12",
            separate([&](Direction d) { return thinPlate(nodes, d); }));
    const PairInterpolation pairs(grid);
    compare(materials, "turned together, linear",
            [&](const LightAndView& target, std::span<const Rgb> values) {
                Rgb sum;
                for (const WeightedPair& term : pairs.weights(target)) {
                    sum += term.weight * values[term.pair];
                }
                return sum;
            });
    compare(materials, "PairInterpolation",
            [&](const LightAndView& target, std::span<const Rgb> values) {
                return pairs.value(target, values);
            });
    return 0;
}
