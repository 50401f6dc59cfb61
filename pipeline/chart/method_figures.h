// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/chart/sweep.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// What one method at one size costs and reaches, over several materials.
struct MethodFigure {
    MethodSize size;
    double deltaE = 0;  ///< Mean CIE 1976 over the materials.
    double worstDeltaE = 0;
    double psnr = 0;       ///< Mean, dB.
    double worstPsnr = 0;  ///< dB.
    double stops = 0;
    double microseconds = 0;          ///< An ABRDF, one core.
    double microsecondsAllCores = 0;  ///< The same, all cores.
    double multiplyAdds = 0;
    double modelBytes = 0;
    double images = 0;
    double setUpMilliseconds = 0;
};

/// Trials of the same sizes over several subjects, as means and worst.
std::vector<MethodFigure> figuresOf(const std::vector<Trial>& trials);

/// A table with a header line, and back. Throws std::runtime_error that names `where` and the line.
std::string csvOf(const std::vector<MethodFigure>& figures);
std::vector<MethodFigure> figuresFromCsv(const std::string& text, const std::string& where);

/// What methods cost and reach here.
struct KnownFigures {
    std::vector<MethodFigure> figures;
    std::string origin;  ///< "measured on this machine" or "shipped".
};

/// Those that `abrdf chart --calibrate` left in the cache, else the shipped ones. A cache that
/// cannot be read is told to `warn`.
KnownFigures knownFigures(const MessageSink& warn);

/// Those that travel with the program, over nine measured materials and two virtual ones.
std::vector<MethodFigure> shippedFigures();

/// Keeps figures in the cache; returns their file. Throws std::runtime_error where there is none.
std::filesystem::path keepFigures(const std::vector<MethodFigure>& figures);

}  // namespace abrdf
