// SPDX-License-Identifier: BSD-3-Clause
//
// A CSV manifest: a header line file,theta_i,phi_i,theta_v,phi_v, then a row an image, angles in
// degrees; paths are relative to the manifest's folder. Any list of pairs.
#include "abrdf/text_file.h"
#include "stages/read/database_path.h"
#include "stages/read/photograph_reader.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr std::string_view kHeader = "file,theta_i,phi_i,theta_v,phi_v";

std::string_view trimmed(std::string_view text) {
    const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

/// The header line without blanks, quotes and a byte order mark.
bool isHeader(std::string_view line) {
    if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    std::string plain;
    for (const char c : line) {
        if (c != ' ' && c != '\t' && c != '\r' && c != '"') plain += c;
    }
    return plain == kHeader;
}

struct Row {
    std::string file;
    std::array<double, 4> degrees{};
};

/// False where `line` is no row. A file's name with a comma stands in quotes; "" is a quote in it.
bool parseRow(std::string_view line, Row& row) {
    line = trimmed(line);
    if (line.starts_with('"')) {
        std::size_t i = 1;
        for (; i < line.size(); ++i) {
            if (line[i] == '"' && (++i == line.size() || line[i] != '"')) break;
            row.file += line[i];
        }
        line.remove_prefix(std::min(i, line.size()));
    } else {
        const std::size_t comma = std::min(line.find(','), line.size());
        row.file = trimmed(line.substr(0, comma));
        line.remove_prefix(comma);
    }
    for (double& degrees : row.degrees) {
        line = trimmed(line);
        if (!line.starts_with(',')) return false;
        line.remove_prefix(1);
        const std::string_view number = trimmed(line.substr(0, line.find(',')));
        const auto [end, error] =
            std::from_chars(number.data(), number.data() + number.size(), degrees);
        if (error != std::errc() || end != number.data() + number.size()) return false;
        line.remove_prefix(std::min(line.find(','), line.size()));
    }
    return trimmed(line).empty() && !row.file.empty();
}

}  // namespace

bool recognizesManifest(const DatabasePath& path) {
    return !path.files && isHeader(path.head.substr(0, path.head.find('\n')));
}

std::unique_ptr<BtfReader> makeManifestReader(const DatabasePath& path) {
    std::istringstream stream(textOfFile(path.path));
    std::string line;
    std::getline(stream, line);  // The header.
    std::vector<std::string> names;
    std::vector<Photograph> photographs;
    for (int number = 2; std::getline(stream, line); ++number) {
        if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
        Row row;
        if (!parseRow(line, row)) {
            throw std::runtime_error(fmt::format("{}:{}: '{}' is not a row {}", path.path.string(),
                                                 number, shownLine(line), kHeader));
        }
        const auto& d = row.degrees;
        photographs.push_back({names.size(), d[0], d[1], d[2], d[3]});
        names.push_back(std::move(row.file));
    }
    if (photographs.empty()) {
        throw std::runtime_error(
            fmt::format("{}: lists no image; add rows {}", path.path.string(), kHeader));
    }
    PhotographFormat format;
    format.name = "images by manifest";
    format.source = path.name();
    format.cosineFrom = "assumed: photographs of a flat sample";
    format.isList = true;
    auto files = std::make_shared<FileSource>(path.path.parent_path(), std::move(names),
                                              path.options.limits);
    return makePhotographReader(std::move(files), photographs, format);
}

}  // namespace abrdf
