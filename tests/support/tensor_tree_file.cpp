// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/tensor_tree_file.h"

#include "tests/support/synthetic_btf.h"

#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

/// What stands between <name ...> and </name> after `from`.
std::string element(const std::string& text, const std::string& name, std::size_t from = 0) {
    const std::size_t open = text.find("<" + name, from);
    const std::size_t begin = text.find('>', open) + 1;
    const std::size_t end = text.find("</" + name + ">", begin);
    if (open == std::string::npos || end == std::string::npos) {
        throw std::runtime_error("no element " + name);
    }
    return text.substr(begin, end - begin);
}

/// Shirley and Chiu's map, from the disk: by the four sectors around the axes.
std::array<double, 2> squareFromDisk(double x, double y) {
    const double radius = std::hypot(x, y);
    double angle = std::atan2(y, x);
    if (angle < -kPi / 4) angle += 2 * kPi;
    double a = 0;
    double b = 0;
    if (angle < kPi / 4) {
        a = radius;
        b = radius * angle * 4 / kPi;
    } else if (angle < 3 * kPi / 4) {
        b = radius;
        a = -radius * (angle - kPi / 2) * 4 / kPi;
    } else if (angle < 5 * kPi / 4) {
        a = -radius;
        b = -radius * (angle - kPi) * 4 / kPi;
    } else {
        b = -radius;
        a = radius * (angle - 3 * kPi / 2) * 4 / kPi;
    }
    return {(a + 1) / 2, (b + 1) / 2};
}

}  // namespace

TensorTreeFile::TensorTreeFile(const std::filesystem::path& file) {
    const std::string text = bytesOf(file);
    const std::string structure = element(text, "IncidentDataStructure");
    if (structure != "TensorTree3" && structure != "TensorTree4") {
        throw std::runtime_error("no tensor tree");
    }
    rank_ = structure.back() - '0';
    const std::array<std::string, 3> wavelengths = {"Visible", "CIE-u", "CIE-v"};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t block = text.find(">" + wavelengths[i] + "<");
        if (element(text, "WavelengthDataDirection", block) != "Reflection Back" ||
            element(text, "AngleBasis", block) != "LBNL/Shirley-Chiu") {
            throw std::runtime_error("no reflection from the front in Shirley-Chiu squares");
        }
        const std::string data = element(text, "ScatteringData", block);
        std::size_t at = data.find('{');
        const std::size_t before = numbers_;
        trees_[i] = parsed(data, at);
        if (i > 0) numbers_ = before;
        if (data.find_first_not_of(" \t\n", at) != std::string::npos) {
            throw std::runtime_error("extra characters after a tree");
        }
    }
}

TensorTreeFile::Node TensorTreeFile::parsed(const std::string& text, std::size_t& at) {
    Node node;
    const auto skip = [&] { at = text.find_first_not_of(" \t\n,", at); };
    if (text[at] != '{') throw std::runtime_error("no {");
    ++at;
    skip();
    while (text.at(at) != '}') {
        if (text[at] == '{') {
            node.branches.push_back(parsed(text, at));
        } else {
            std::size_t length = 0;
            node.grid.push_back(std::stod(text.substr(at, 32), &length));
            at += length;
            ++numbers_;
        }
        skip();
    }
    ++at;
    if (!node.branches.empty() && node.branches.size() != std::size_t{1} << rank_) {
        throw std::runtime_error("a node of too few branches");
    }
    return node;
}

double TensorTreeFile::look(const Node& node, std::vector<double> place) const {
    if (!node.branches.empty()) {
        std::size_t branch = 0;
        for (std::size_t d = 0; d < place.size(); ++d) {
            place[d] *= 2;
            if (place[d] >= 1) {
                branch |= std::size_t{1} << d;
                place[d] -= 1;
            }
        }
        return look(node.branches[branch], place);
    }
    const auto side = static_cast<std::size_t>(
        std::lround(std::pow(static_cast<double>(node.grid.size()), 1.0 / rank_)));
    std::size_t index = 0;
    for (const double p : place) {
        index = index * side +
                std::min(side - 1, static_cast<std::size_t>(p * static_cast<double>(side)));
    }
    return node.grid.at(index);
}

std::array<double, 3> TensorTreeFile::evaluate(const LightAndView& pair) const {
    const auto disk = [](Direction d, double turn, double sign) {
        return squareFromDisk(sign * std::sin(d.theta) * std::cos(d.phi + turn),
                              sign * std::sin(d.theta) * std::sin(d.phi + turn));
    };
    std::vector<double> place;
    if (rank_ == 3) {
        // The view turns with the light, whose mirror direction comes to azimuth 0.
        const auto out = disk(pair.view, -(pair.light.phi + kPi), 1);
        place = {0.5 - 1e-6 - 0.5 * std::sin(pair.light.theta), out[0], out[1]};
    } else {
        const auto in = disk(pair.light, 0, -1);
        const auto out = disk(pair.view, 0, 1);
        place = {in[0], in[1], out[0], out[1]};
    }
    const double y = look(trees_[0], place);
    const double u = look(trees_[1], place);
    const double v = look(trees_[2], place);
    return {y * 9 * u / (4 * v), y, y * (12 - 3 * u - 20 * v) / (4 * v)};
}

}  // namespace abrdf
