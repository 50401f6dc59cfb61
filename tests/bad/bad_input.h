// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abrdf {

/// An input that nobody should give, and what the program says of it.
struct BadInput {
    std::string what;
    /// Writes it into an empty folder, in which the program is then run.
    std::function<void(const std::filesystem::path& folder)> make;
    std::string arguments;  ///< As a shell splits them.
    int status = 1;
    std::string says;  ///< A regular expression that is found in what it prints.
};

/// Runs each in a process of its own whose memory is bounded: the exit status and the sentence are
/// the expected ones, the sentence is one line, and nothing new is in the folder unless it is
/// named out.exr and the run succeeded. Doctest checks.
void checkBadInputs(const std::vector<BadInput>& inputs);

/// Writes a file, and the folders above it.
void put(const std::filesystem::path& file, const std::string& bytes);

/// A stack of one image, in UBO2003's names: "stack/tv000_pv000/00001 tl000 pl000 tv000 pv000.EXT".
std::string stackImage(const std::string& extension);

}  // namespace abrdf
