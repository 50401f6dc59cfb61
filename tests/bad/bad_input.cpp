// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bad/bad_input.h"

#include "tests/support/run_program.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

constexpr const char* kBounded = kSanitized ? "" : "prlimit --as=3221225472";

std::set<std::string> filesIn(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        names.insert(entry.path().lexically_relative(folder).string());
    }
    return names;
}

/// Lines, but for those that libpng prints by itself.
std::ptrdiff_t sentences(const std::string& text) {
    std::istringstream stream(text);
    std::ptrdiff_t count = 0;
    for (std::string line; std::getline(stream, line);) count += line.starts_with("libpng") ? 0 : 1;
    return count;
}

}  // namespace

void checkBadInputs(const std::vector<BadInput>& inputs) {
    for (const BadInput& input : inputs) {
        CAPTURE(input.what);
        const TemporaryFolder outside;
        const fs::path folder = outside.path() / "in";
        fs::create_directory(folder);
        input.make(folder);
        const std::set<std::string> before = filesIn(outside.path());
        const ProgramRun run = runProgram(folder, input.arguments, kBounded);
        CAPTURE(run.out);
        CAPTURE(run.err);
        CHECK(run.status == input.status);
        CHECK(std::regex_search(run.out + run.err, std::regex(input.says)));
        if (run.status != 0) CHECK(sentences(run.err) <= 1);
        std::set<std::string> after = filesIn(outside.path());
        if (run.status == 0) after.erase("in/out.exr");
        CHECK(after == before);
    }
}

void put(const fs::path& file, const std::string& bytes) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
}

std::string stackImage(const std::string& extension) {
    return "stack/tv000_pv000/00001 tl000 pl000 tv000 pv000." + extension;
}

}  // namespace abrdf
