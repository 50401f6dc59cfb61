// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/number_rows.h"

#include "abrdf/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace abrdf {

namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

/// Between commas where there are any, else between blanks.
std::vector<std::string_view> fieldsOf(std::string_view line) {
    std::vector<std::string_view> fields;
    if (line.find(',') != std::string_view::npos) {
        while (true) {
            const std::size_t comma = line.find(',');
            fields.push_back(trimmed(line.substr(0, comma)));
            if (comma == std::string_view::npos) return fields;
            line.remove_prefix(comma + 1);
        }
    }
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
        fields.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
    return fields;
}

std::optional<double> numberOf(std::string_view field) {
    if (field.starts_with('+')) field.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
    // What is too small for a double is 0 for all that we do with it.
    if (error == std::errc::result_out_of_range && std::abs(number) < 1) number = 0;
    if (end != field.data() + field.size() || field.empty() || !std::isfinite(number)) return {};
    return number;
}

/// Names begin with a letter, all of them, and are no numbers ("nan").
bool areNames(const std::vector<std::string_view>& fields) {
    return std::ranges::all_of(fields, [](std::string_view field) {
        double number = 0;
        return !field.empty() && std::isalpha(static_cast<unsigned char>(field[0])) != 0 &&
               std::from_chars(field.data(), field.data() + field.size(), number).ptr ==
                   field.data();
    });
}

std::string lowerCase(std::string_view text) {
    std::string result;
    for (const char c : text) {
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return result;
}

}  // namespace

NumberRows numberRowsFromFile(const std::filesystem::path& file, std::size_t least,
                              std::size_t most, const std::string& shape) {
    std::string text = textOfFile(file);
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // As spreadsheets begin UTF-8.
    std::istringstream stream(std::move(text));
    NumberRows result;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        const std::string_view content = trimmed(line);
        if (content.empty() || content[0] == '#') continue;
        const std::vector<std::string_view> fields = fieldsOf(content);
        NumberRows::Row row{fmt::format("{}:{}", file.string(), number), {}};
        for (const std::string_view field : fields) {
            if (const auto value = numberOf(field)) row.numbers.push_back(*value);
        }
        const bool isRow =
            row.numbers.size() == fields.size() && fields.size() >= least && fields.size() <= most;
        if (isRow) {
            result.rows.push_back(std::move(row));
        } else if (result.rows.empty() && result.names.empty() && areNames(fields)) {
            for (const std::string_view field : fields) result.names.push_back(lowerCase(field));
        } else {
            throw std::runtime_error(
                fmt::format("{}: '{}' is not a row {}", row.where, shownLine(line), shape));
        }
    }
    return result;
}

}  // namespace abrdf
