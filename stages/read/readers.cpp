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
bool recognizesUbo2003(const DatabasePath& path);
std::unique_ptr<BtfReader> makeUbo2003Reader(const DatabasePath& path);

namespace {

struct Format {
    const char* name;
    bool (*recognizes)(const DatabasePath&);
    std::unique_ptr<BtfReader> (*make)(const DatabasePath&);
};

constexpr std::array kFormats{
    Format{"UBO2003", recognizesUbo2003, makeUbo2003Reader},
};

}  // namespace

std::size_t BtfDescription::imageCount() const {
    return static_cast<std::size_t>(std::ranges::count(present, std::uint8_t{1}));
}

std::vector<std::size_t> BtfDescription::missingPairs() const {
    std::vector<std::size_t> missing;
    for (std::size_t pair = 0; pair < present.size(); ++pair) {
        if (present[pair] == 0) missing.push_back(pair);
    }
    return missing;
}

std::unique_ptr<BtfReader> openBtf(const fs::path& path) {
    const DatabasePath database(path);
    for (const Format& format : kFormats) {
        if (format.recognizes(database)) return format.make(database);
    }
    std::string names;
    for (const Format& format : kFormats) names += fmt::format(" {}", format.name);
    throw std::runtime_error(
        fmt::format("{}: is not a database that abrdf reads; it reads folders and .zip files of "
                    "images named by "
                    "their angles, as 'tl030 pl090 tv015 pv060.jpg', and knows these formats:{}",
                    path.string(), names));
}

}  // namespace abrdf
