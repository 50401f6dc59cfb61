// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report_path.h"

#include "abrdf/output_file.h"
#include "abrdf/printable.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

bool isSameFile(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    if (fs::equivalent(a, b, ignored)) return true;
    return fs::absolute(a, ignored).lexically_normal() ==
           fs::absolute(b, ignored).lexically_normal();
}

}  // namespace

void checkReportPath(const fs::path& report, const std::vector<std::string>& words) {
    checkOutputPath(report);
    constexpr const char* kOption = "--report";
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == kOption) {
            ++i;  // Its own value.
            continue;
        }
        if (words[i].empty() || words[i].starts_with(kOption)) continue;
        const auto equals = words[i][0] == '-' ? words[i].find('=') : std::string::npos;
        const std::string word =
            equals == std::string::npos ? words[i] : words[i].substr(equals + 1);
        if (word == report || (!word.empty() && word[0] != '-' && isSameFile(word, report))) {
            throw std::invalid_argument(
                fmt::format("--report {}: is a file of this command already; choose another",
                            printable(report.string())));
        }
    }
}

}  // namespace abrdf
