// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/measured_materials.h"

#include "tests/support/synthetic_btf.h"

#include <algorithm>
#include <filesystem>
#include <string>

namespace abrdf {

namespace fs = std::filesystem;

std::vector<std::vector<Rgb>> measuredMaterials() {
    std::vector<std::string> names;
    const fs::path folder = fs::path(ABRDF_SHARED_DATA) / "measured81";
    if (!fs::exists(folder)) return {};
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back("measured81/" + entry.path().filename().string());
    }
    std::ranges::sort(names);
    names.emplace_back("virtual/twill_mean_f32.bin");
    std::vector<std::vector<Rgb>> tables;
    for (const std::string& name : names) {
        std::vector<Rgb> table = sharedTable(name);
        if (table.size() == 6561) tables.push_back(std::move(table));
    }
    return tables;
}

}  // namespace abrdf
