// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/database_path.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

DatabasePath::DatabasePath(fs::path where, ReadOptions readOptions)
    : path(std::move(where)), options(std::move(readOptions)) {
    std::error_code error;
    if (!fs::exists(path, error)) {
        if (error) {
            throw std::runtime_error(
                fmt::format("{}: cannot be opened: {}", path.string(), error.message()));
        }
        throw std::runtime_error(fmt::format("{}: there is no such file or folder", path.string()));
    }
    // A pipe would be waited for, and a device has no end.
    if (!fs::is_directory(path) && !fs::is_regular_file(path)) {
        throw std::runtime_error(fmt::format("{}: is neither a file nor a folder", path.string()));
    }
    if (fs::is_directory(path) || isZip(path)) {
        files = std::make_shared<const FileSource>(path, options.limits);
        return;
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    }
    constexpr std::size_t kHead = 4096;
    head.resize(kHead);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    size = fs::file_size(path);
}

std::string DatabasePath::name() const {
    const std::string name = fs::weakly_canonical(path).filename().string();
    // Headers and reports are UTF-8, which a name on disk need not be.
    using nlohmann::json;
    return json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace abrdf
