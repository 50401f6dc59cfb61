// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/reader_faults.h"

#include "stages/read/btf_reader.h"

#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>

namespace abrdf {

void writeFile(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string readFault(const std::filesystem::path& path) {
    try {
        const auto reader = openBtf(path);
        const std::size_t pairs = reader->description().present.size();
        for (std::size_t pair = 0; pair < pairs; pair += 1 + pairs / 50) {
            if (reader->description().present[pair] != 0) reader->read(pair);
        }
        return {};
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

void checkEveryCut(const std::filesystem::path& path, const std::string& bytes) {
    writeFile(path, bytes);
    CHECK(readFault(path) == "");
    for (std::size_t i = 0; i < 50; ++i) {
        const std::size_t size = i < 10 ? bytes.size() - 1 - i : bytes.size() * i / 51;
        CAPTURE(size);
        writeFile(path, bytes.substr(0, size));
        CHECK(readFault(path).find(path.filename().string()) != std::string::npos);
    }
}

}  // namespace abrdf
