// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace abrdf {

/// What a run of the program left.
struct ProgramRun {
    int status = 0;  ///< Exit status, or minus the signal that ended it.
    std::string out;
    std::string err;
};

/// Runs `abrdf ARGUMENTS` (as a shell splits them) in `folder`, after what
/// env takes: "OCIO=x", or another command, as "timeout -s INT 1".
ProgramRun runProgram(const std::filesystem::path& folder, const std::string& arguments,
                      const std::string& before = "");

}  // namespace abrdf
