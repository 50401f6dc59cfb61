// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/file_source.h"

#include "stages/read/zip_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// A declared size above the limit is a bomb or a lie.
void checkFileSize(std::uint64_t size, std::uint64_t most, const std::string& name) {
    if (size <= most) return;
    throw std::runtime_error(
        fmt::format("{}: is too large for an image: {} bytes, and {} are allowed; --max-file-size "
                    "allows more",
                    name, size, most));
}

std::vector<char> readFile(const fs::path& path, std::uint64_t most) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    }
    std::error_code error;
    const std::uint64_t size = fs::file_size(path, error);
    if (error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be read: {}", path.string(), error.message()));
    }
    checkFileSize(size, most, path.string());
    std::vector<char> bytes(size);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
        throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
    }
    return bytes;
}

}  // namespace

/// libzip's handles serve one thread at a time: each reader borrows one of its own.
struct FileSource::Zip {
    explicit Zip(const fs::path& archive) : path(archive), file(archive) {}

    fs::path path;
    SharedFile file;
    std::vector<zip_uint64_t> entries;  ///< Index in the archive of each name.
    std::mutex mutex;
    std::vector<ZipHandle> idle;

    ZipHandle borrow() {
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty()) {
                ZipHandle handle = std::move(idle.back());
                idle.pop_back();
                return handle;
            }
        }
        return openZip(file, path);
    }
    void giveBack(ZipHandle handle) {
        const std::lock_guard lock(mutex);
        idle.push_back(std::move(handle));
    }
};

FileSource::FileSource(const fs::path& path, const ReadLimits& limits)
    : path_(path), limits_(limits) {
    if (fs::is_directory(path)) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
            if (entry.is_regular_file()) {
                names_.push_back(entry.path().lexically_relative(path).generic_string());
            }
        }
        std::ranges::sort(names_);
        return;
    }
    zip_ = std::make_unique<Zip>(path);
    ZipHandle archive = zip_->borrow();
    std::vector<std::pair<std::string, zip_uint64_t>> entries;
    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
        const char* name = zip_get_name(archive.get(), i, 0);
        if (name != nullptr && !std::string_view(name).ends_with('/'))
            entries.emplace_back(name, i);
    }
    std::ranges::sort(entries);
    for (auto& [name, entry] : entries) {
        names_.push_back(std::move(name));
        zip_->entries.push_back(entry);
    }
    zip_->giveBack(std::move(archive));
}

FileSource::FileSource(fs::path folder, std::vector<std::string> names, const ReadLimits& limits)
    : path_(std::move(folder)), limits_(limits), names_(std::move(names)) {}

FileSource::~FileSource() = default;
FileSource::FileSource(FileSource&&) noexcept = default;

std::vector<char> FileSource::read(std::size_t index) const {
    if (!zip_) return readFile(path_ / names_[index], limits_.fileBytes);

    ZipHandle archive = zip_->borrow();
    const zip_uint64_t entry = zip_->entries[index];
    zip_stat_t stat;
    const auto fail = [&](const std::string& why) -> std::runtime_error {
        return std::runtime_error(fmt::format("{}: cannot be read: {}", fullName(index), why));
    };
    if (zip_stat_index(archive.get(), entry, 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0) {
        throw fail(zip_strerror(archive.get()));
    }
    checkFileSize(stat.size, limits_.fileBytes, fullName(index));
    zip_file_t* file = zip_fopen_index(archive.get(), entry, 0);
    if (file == nullptr) throw fail(zip_strerror(archive.get()));
    // Grown with what really comes: a header that lies about the size allocates nothing.
    constexpr std::uint64_t kStep = std::uint64_t{1} << 22;
    std::vector<char> bytes;
    while (bytes.size() < stat.size) {
        const std::size_t before = bytes.size();
        bytes.resize(std::min(stat.size, before + kStep));
        const zip_int64_t got = zip_fread(file, bytes.data() + before, bytes.size() - before);
        bytes.resize(before + static_cast<std::size_t>(std::max<zip_int64_t>(got, 0)));
        if (got <= 0) break;
    }
    // A last read past the end makes libzip compare the checksum.
    char extra = 0;
    const bool whole = bytes.size() == stat.size && zip_fread(file, &extra, 1) == 0;
    zip_fclose(file);
    if (!whole) throw fail("the archive is cut or damaged there; fetch it again");
    zip_->giveBack(std::move(archive));
    return bytes;
}

std::uint64_t FileSource::sizeOf(std::size_t index) const {
    if (!zip_) {
        std::error_code absent;
        const std::uint64_t size = fs::file_size(path_ / names_[index], absent);
        return absent ? 0 : size;
    }
    // Asked for one entry at a time: libzip looks at the archive's own file for each.
    ZipHandle archive = zip_->borrow();
    zip_stat_t stat;
    const bool known = zip_stat_index(archive.get(), zip_->entries[index], 0, &stat) == 0 &&
                       (stat.valid & ZIP_STAT_COMP_SIZE) != 0;
    zip_->giveBack(std::move(archive));
    return known ? stat.comp_size : 0;
}

std::string FileSource::fullName(std::size_t index) const {
    return zip_ ? fmt::format("{}: {}", path_.string(), names_[index])
                : (path_ / names_[index]).string();
}

bool isZip(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    char magic[4] = {};
    return stream.read(magic, 4) && std::memcmp(magic, "PK\3\4", 4) == 0;
}

}  // namespace abrdf
