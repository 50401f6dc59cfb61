// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/method_figures.h"

#include "abrdf/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// The columns after method, samples and rank.
struct Column {
    const char* name;
    double MethodFigure::*value;
};
constexpr std::array kColumns = {
    Column{"delta_e", &MethodFigure::deltaE},
    Column{"delta_e_worst", &MethodFigure::worstDeltaE},
    Column{"psnr", &MethodFigure::psnr},
    Column{"psnr_worst", &MethodFigure::worstPsnr},
    Column{"stops", &MethodFigure::stops},
    Column{"microseconds_per_abrdf", &MethodFigure::microseconds},
    Column{"microseconds_all_cores", &MethodFigure::microsecondsAllCores},
    Column{"multiply_adds", &MethodFigure::multiplyAdds},
    Column{"model_bytes", &MethodFigure::modelBytes},
    Column{"images", &MethodFigure::images},
    Column{"set_up_milliseconds", &MethodFigure::setUpMilliseconds},
};

std::string header() {
    std::string line = "method,samples,rank";
    for (const Column& column : kColumns) line += fmt::format(",{}", column.name);
    return line;
}

MethodFigure figureFromRow(const std::string& line, const std::string& where) {
    std::istringstream row(line);
    MethodFigure figure;
    char comma = 0;
    std::getline(row, figure.size.method, ',');
    row >> figure.size.samples >> comma >> figure.size.rank;
    for (const Column& column : kColumns) row >> comma >> figure.*column.value;
    std::string rest;
    if (row.fail() || row >> rest) {
        throw std::runtime_error(
            fmt::format("{}: is no row of figures; make them again with abrdf chart", where));
    }
    return figure;
}

MethodFigure figureOf(const std::vector<const Trial*>& trials) {
    MethodFigure figure;
    figure.size = trials.front()->size;
    figure.worstPsnr = trials.front()->accuracy.natural.psnr;
    const auto share = 1 / static_cast<double>(trials.size());
    for (const Trial* t : trials) {
        const Measures& natural = t->accuracy.natural;
        figure.deltaE += share * natural.deltaE;
        figure.worstDeltaE = std::max(figure.worstDeltaE, natural.deltaE);
        figure.psnr += share * natural.psnr;
        figure.worstPsnr = std::min(figure.worstPsnr, natural.psnr);
        figure.stops += share * t->accuracy.stops;
        figure.multiplyAdds += share * t->multiplyAdds;
        figure.modelBytes += share * t->modelBytes;
        figure.images += share * static_cast<double>(t->images);
        figure.setUpMilliseconds += share * t->setUpMilliseconds;
        // Means: isotropic materials cost `prior` a sixth of others, which a median would hide.
        figure.microseconds += share * t->time.oneCore;
        figure.microsecondsAllCores += share * t->time.allCores;
    }
    return figure;
}

fs::path cachedFigures(const fs::path& folder) {
    return folder / "figures.csv";
}

}  // namespace

std::vector<MethodFigure> figuresOf(const std::vector<Trial>& trials) {
    std::vector<MethodFigure> figures;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const MethodSize& size = trials[i].size;
        if (std::ranges::any_of(figures, [&](const auto& f) { return f.size == size; })) continue;
        std::vector<const Trial*> own;
        for (const Trial& trial : trials) {
            if (trial.size == size) own.push_back(&trial);
        }
        figures.push_back(figureOf(own));
    }
    return figures;
}

std::string csvOf(const std::vector<MethodFigure>& figures) {
    std::string text = header() + "\n";
    for (const MethodFigure& f : figures) {
        text += fmt::format("{},{},{}", f.size.method, f.size.samples, f.size.rank);
        for (const Column& column : kColumns) text += fmt::format(",{:.6g}", f.*column.value);
        text += "\n";
    }
    return text;
}

std::vector<MethodFigure> figuresFromCsv(const std::string& text, const std::string& where) {
    std::istringstream stream(text);
    std::string line;
    if (!std::getline(stream, line) || line != header()) {
        throw std::runtime_error(
            fmt::format("{}: is no table of figures of this version; make it again with abrdf "
                        "chart --calibrate",
                        where));
    }
    std::vector<MethodFigure> figures;
    for (int number = 2; std::getline(stream, line); ++number) {
        figures.push_back(figureFromRow(line, fmt::format("{}:{}", where, number)));
    }
    return figures;
}

KnownFigures knownFigures(const MessageSink& warn) {
    const auto folder = cacheFolder();
    if (folder && fs::exists(cachedFigures(*folder))) {
        try {
            std::ifstream stream(cachedFigures(*folder));
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            return {figuresFromCsv(text, cachedFigures(*folder).string()),
                    "measured on this machine"};
        } catch (const std::runtime_error& error) {
            if (warn) warn(fmt::format("{} (the shipped figures are used)", error.what()));
        }
    }
    return {shippedFigures(), "shipped"};
}

fs::path keepFigures(const std::vector<MethodFigure>& figures) {
    const auto folder = cacheFolder();
    if (!folder) {
        throw std::runtime_error(
            "neither XDG_CACHE_HOME nor HOME says where the cache is, so that figures cannot be "
            "kept");
    }
    fs::create_directories(*folder);
    writeWholeFile(cachedFigures(*folder), csvOf(figures));
    return cachedFigures(*folder);
}

}  // namespace abrdf
