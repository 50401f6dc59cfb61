// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/btf_reader.h"
#include "stages/read/database_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

// A new format is one file in this folder and one line in each of these two lists.
using Recognizes = bool(const DatabasePath& path);
using MakeReader = std::unique_ptr<BtfReader>(const DatabasePath& path);
Recognizes recognizesPattern, recognizesManifest, recognizesUtiaBtf, recognizesAtrium,
    recognizesUbo2003, recognizesUbo2014, recognizesRgl, recognizesMbsdf, recognizesAtlas,
    recognizesUtiaExr, recognizesMerl, recognizesUtiaBin;
MakeReader makePatternReader, makeManifestReader, makeUtiaBtfReader, makeAtriumReader,
    makeUbo2003Reader, makeUbo2014Reader, makeRglReader, makeMbsdfReader, makeAtlasInputReader,
    makeUtiaExrReader, makeMerlReader, makeUtiaBinReader;

namespace {

struct Format {
    const char* name;
    Recognizes* recognizes;
    MakeReader* make;
};

// The first that recognizes a path takes it: what the user says comes first, then formats with a
// mark of their own, last those that are known by sizes and plausible numbers.
constexpr std::array kFormats{
    Format{"images by pattern", recognizesPattern, makePatternReader},
    Format{"images by manifest", recognizesManifest, makeManifestReader},
    Format{"UTIA BTF", recognizesUtiaBtf, makeUtiaBtfReader},
    Format{"ATRIUM", recognizesAtrium, makeAtriumReader},
    Format{"UBO2003", recognizesUbo2003, makeUbo2003Reader},
    Format{"UBO2014", recognizesUbo2014, makeUbo2014Reader},
    Format{"RGL", recognizesRgl, makeRglReader},
    Format{"NVIDIA MBSDF", recognizesMbsdf, makeMbsdfReader},
    Format{"abrdf atlas", recognizesAtlas, makeAtlasInputReader},
    Format{"UTIA BRDF EXR", recognizesUtiaExr, makeUtiaExrReader},
    Format{"MERL", recognizesMerl, makeMerlReader},
    Format{"UTIA BRDF .bin", recognizesUtiaBin, makeUtiaBinReader},
};

}  // namespace

std::size_t BtfDescription::imageCount() const {
    return static_cast<std::size_t>(std::ranges::count(present, std::uint8_t{1}));
}

std::vector<std::size_t> BtfDescription::missingPairs() const {
    std::vector<std::size_t> missing;
    if (isList) return missing;
    for (std::size_t pair = 0; pair < present.size(); ++pair) {
        if (present[pair] == 0) missing.push_back(pair);
    }
    return missing;
}

std::unique_ptr<BtfReader> openBtf(const fs::path& path, const ReadOptions& options) {
    const DatabasePath database(path, options);
    for (const Format& format : kFormats) {
        if (format.recognizes(database)) return format.make(database);
    }
    std::string names;
    for (const Format& format : kFormats) {
        names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
    }
    throw std::runtime_error(
        fmt::format("{}: is not a database that abrdf reads: {}; images need names with their "
                    "angles, as 'tl030 pl090 tv015 pv060.jpg', a --pattern or a manifest",
                    path.string(), names));
}

}  // namespace abrdf
