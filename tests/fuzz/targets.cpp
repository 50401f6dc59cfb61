// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/targets.h"

#include "tests/support/temporary_folder.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace abrdf {

std::vector<FuzzTarget> fuzzTargets() {
    std::vector<FuzzTarget> all;
    for (const auto& some :
         {readerTargets(), atlasTargets(), jobTargets(), mergeTargets(), methodTargets()}) {
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

FuzzTarget fuzzTargetFromName(const std::string& name) {
    for (const FuzzTarget& target : fuzzTargets()) {
        if (target.name == name) return target;
    }
    throw std::out_of_range("there is no fuzz target " + name);
}

std::filesystem::path fuzzFile(const std::string& name, std::span<const char> bytes) {
    static const TemporaryFolder kFolder;
    const std::filesystem::path path = kFolder.path() / name;
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

void fuzzCheck(bool holds, const char* promise) {
    if (holds) return;
    std::cerr << "broken promise: " << promise << std::endl;
    std::abort();
}

}  // namespace abrdf
