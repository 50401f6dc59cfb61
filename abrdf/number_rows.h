// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// Rows of numbers as tables hold them, with commas or blanks between.
struct NumberRows {
    std::vector<std::string>
        names;  ///< Of the line of names, lower case; empty where there is none.
    struct Row {
        std::string where;  ///< "file:line".
        std::vector<double> numbers;
    };
    std::vector<Row> rows;
};

/// Reads a file of them. Empty lines and those that begin with # are passed over, and so is one
/// line of names before the first row. Each row has `least` to `most` finite numbers, none left
/// empty. shape: what a row is, for messages, "theta_deg,phi_deg in degrees". Throws
/// std::runtime_error as textOfFile(), and with file and line for what is no row.
NumberRows numberRowsFromFile(const std::filesystem::path& file, std::size_t least,
                              std::size_t most, const std::string& shape);

}  // namespace abrdf
