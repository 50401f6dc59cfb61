// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/scene_pairs.h"

#include "abrdf/number_rows.h"
#include "abrdf/pair_features.h"
#include "abrdf/pair_interpolation.h"
#include "abrdf/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

constexpr std::array kNames = {"theta_i", "phi_i", "theta_v", "phi_v", "weight"};
constexpr const char* kShape =
    "theta_i,phi_i,theta_v,phi_v,weight with angles in degrees; the weight may be left out";

/// A file that says its columns stand otherwise is not read as if they did not.
void checkNames(const std::vector<std::string>& names, const fs::path& file) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto known = std::ranges::find(kNames, names[i]);
        if (known == kNames.end() || static_cast<std::size_t>(known - kNames.begin()) == i) {
            continue;
        }
        throw std::runtime_error(fmt::format(
            "{}: its columns begin with {}; put them in the order theta_i,phi_i,theta_v,phi_v,"
            "weight",
            file.string(), fmt::join(names, ",")));
    }
}

/// theta_i, phi_i, theta_v, phi_v in degrees, and the weight.
using Row = std::array<double, 5>;

Row rowOf(const std::vector<double>& numbers) {
    Row row{};
    row[4] = 1;
    std::ranges::copy(numbers, row.begin());
    return row;
}

void checkRow(const Row& row, const std::string& where) {
    for (const double theta : {row[0], row[2]}) {
        if (theta >= 0 && theta < 90) continue;
        throw std::runtime_error(
            fmt::format("{}: theta {:g} degrees is not above the horizon; give angles from the "
                        "normal, 0 to below 90, or leave the row out",
                        where, theta));
    }
    for (const double phi : {row[1], row[3]}) {
        if (phi >= -360 && phi <= 720) continue;
        throw std::runtime_error(
            fmt::format("{}: phi {:g} is no azimuth in degrees; give -360 to 720", where, phi));
    }
    if (row[4] < 0) {
        throw std::runtime_error(
            fmt::format("{}: the weight {:g} must be a number of at least 0", where, row[4]));
    }
}

/// Equal pairs become one, with the sum of their weights.
ScenePairs merged(const std::vector<LightAndView>& pairs, const std::vector<double>& weights) {
    ScenePairs scene;
    PairGroups groups = distinctPairs(pairs);
    scene.pairs = std::move(groups.distinct);
    scene.weights.assign(scene.pairs.size(), 0);
    for (std::size_t i = 0; i < pairs.size(); ++i) scene.weights[groups.rowOf[i]] += weights[i];
    return scene;
}

std::vector<Direction> distinctDirections(const std::vector<Direction>& directions) {
    std::vector<LightAndView> pairs;
    for (const Direction& d : directions) pairs.push_back({d, {}});
    std::vector<Direction> distinct;
    for (const LightAndView& pair : distinctPairs(pairs).distinct) distinct.push_back(pair.light);
    return distinct;
}

/// One list of a scene's grid.
std::vector<Direction> sceneDirections(const std::vector<Direction>& wanted,
                                       const std::vector<Direction>& base) {
    std::vector<Direction> own = distinctDirections(wanted);
    if (own.size() <= base.size()) return own;
    const AngularInterpolation interpolation(base);
    if (!interpolation.hasRings()) return base;
    // Whole rings: on parts of them a cubic says nothing.
    std::vector<double> ringThetas;
    for (const Direction& d : own) {
        for (const auto& term : interpolation.smoothWeights(d).terms) {
            ringThetas.push_back(base[term.index].theta);
        }
    }
    std::ranges::sort(ringThetas);
    constexpr Radians kSame = radiansFromDegrees(0.05);
    std::vector<Direction> kept;
    for (const Direction& d : base) {
        const auto at = std::ranges::lower_bound(ringThetas, d.theta - kSame);
        if (at != ringThetas.end() && *at <= d.theta + kSame) kept.push_back(d);
    }
    return kept;
}

}  // namespace

ScenePairs scenePairsFromCsv(const fs::path& file) {
    const NumberRows table = numberRowsFromFile(file, 4, 5, kShape);
    checkNames(table.names, file);
    std::vector<LightAndView> pairs;
    std::vector<double> weights;
    for (const NumberRows::Row& line : table.rows) {
        const Row row = rowOf(line.numbers);
        checkRow(row, line.where);
        const auto direction = [&](std::size_t i) {
            return Direction{radiansFromDegrees(row[i]),
                             wrappedAzimuth(radiansFromDegrees(row[i + 1]))};
        };
        pairs.push_back({direction(0), direction(2)});
        weights.push_back(row[4]);
    }
    if (pairs.empty()) {
        throw std::runtime_error(
            fmt::format("{}: holds no pair of directions; write a row "
                        "theta_i,phi_i,theta_v,phi_v,weight a pair, angles in degrees",
                        file.string()));
    }
    const double largest = *std::ranges::max_element(weights);
    if (largest <= 0) {
        throw std::runtime_error(
            fmt::format("{}: the weights of its {} pairs sum to 0; give at least one pair a "
                        "weight above 0",
                        file.string(), pairs.size()));
    }
    for (double& weight : weights) weight /= largest;
    ScenePairs scene = merged(pairs, weights);
    scene.name = file.stem().string();
    double sum = 0;
    for (const double weight : scene.weights) sum += weight;
    for (double& weight : scene.weights) weight /= sum;
    return scene;
}

AngularGrid sceneGrid(const ScenePairs& scene, const AngularGrid& base) {
    std::vector<Direction> lights;
    std::vector<Direction> views;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        if (scene.weights[i] <= 0) continue;
        lights.push_back(scene.pairs[i].light);
        views.push_back(scene.pairs[i].view);
    }
    return {sceneDirections(lights, base.lights()), sceneDirections(views, base.views())};
}

std::vector<double> sceneWeights(const ScenePairs& scene, const AngularGrid& grid) {
    const PairInterpolation interpolation(grid);
    std::vector<double> weights(grid.pairCount());
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        if (scene.weights[i] <= 0) continue;
        for (const WeightedPair& source : interpolation.weights(scene.pairs[i])) {
            weights[source.pair] += scene.weights[i] * static_cast<double>(source.weight);
        }
    }
    return weights;
}

std::vector<std::size_t> spreadByWeight(std::span<const double> weights, std::size_t count) {
    double total = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        total += weights[i];
        if (weights[i] > 0) last = i;
    }
    Random random(0x5ca77e2, weights.size());
    std::vector<std::size_t> chosen;
    std::size_t i = 0;
    double passed = 0;  // Up to and with i - 1.
    const std::size_t pieces = std::min(count, weights.size());
    for (std::size_t k = 0; k < pieces; ++k) {
        // One somewhere in each piece: an even step would meet the same views again and again.
        const double place =
            (static_cast<double>(k) + random.uniform()) / static_cast<double>(pieces) * total;
        while (i < last && passed + weights[i] <= place) passed += weights[i++];
        chosen.push_back(i);
    }
    return chosen;
}

}  // namespace abrdf
