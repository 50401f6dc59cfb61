// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/zip_archive.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace {

/// libzip's view of the file: a place in it, what was read ahead, and the last error. libzip reads
/// the directory of an archive in pieces of 46 bytes.
struct Cursor {
    const SharedFile* file;
    std::uint64_t place = 0;
    std::uint64_t aheadBegin = 0;
    std::vector<char> ahead;
    zip_error_t error{};
};

constexpr std::uint64_t kReadAhead = std::uint64_t{1} << 16;

zip_int64_t fail(Cursor& cursor, int zipError, int systemError) {
    zip_error_set(&cursor.error, zipError, systemError);
    return -1;
}

zip_int64_t readAtCursor(Cursor& cursor, char* bytes, zip_uint64_t count) {
    if (cursor.place < cursor.aheadBegin ||
        cursor.place >= cursor.aheadBegin + cursor.ahead.size()) {
        cursor.ahead.resize(kReadAhead);
        const std::int64_t got = cursor.file->read(cursor.place, cursor.ahead.data(), kReadAhead);
        cursor.ahead.resize(static_cast<std::size_t>(std::max<std::int64_t>(got, 0)));
        cursor.aheadBegin = cursor.place;
        if (got < 0) return fail(cursor, ZIP_ER_READ, errno);
    }
    const std::uint64_t skip = cursor.place - cursor.aheadBegin;
    const std::uint64_t taken = std::min(count, cursor.ahead.size() - skip);
    std::copy_n(cursor.ahead.data() + skip, taken, bytes);
    cursor.place += taken;
    return static_cast<zip_int64_t>(taken);
}

zip_int64_t seekCursor(Cursor& cursor, void* bytes, zip_uint64_t count) {
    const zip_int64_t place = zip_source_seek_compute_offset(cursor.place, cursor.file->size(),
                                                             bytes, count, &cursor.error);
    if (place < 0) return -1;
    cursor.place = static_cast<std::uint64_t>(place);
    return 0;
}

zip_int64_t stateOf(const Cursor& cursor, void* bytes) {
    auto* stat = static_cast<zip_stat_t*>(bytes);
    zip_stat_init(stat);
    stat->size = cursor.file->size();
    stat->valid = ZIP_STAT_SIZE;
    return sizeof *stat;
}

extern "C" zip_int64_t onZipCommand(void* user, void* bytes, zip_uint64_t count,
                                    zip_source_cmd_t command) {
    auto* cursor = static_cast<Cursor*>(user);
    switch (command) {
        case ZIP_SOURCE_OPEN:
            cursor->place = 0;
            return 0;
        case ZIP_SOURCE_READ:
            return readAtCursor(*cursor, static_cast<char*>(bytes), count);
        case ZIP_SOURCE_SEEK:
            return seekCursor(*cursor, bytes, count);
        case ZIP_SOURCE_TELL:
            return static_cast<zip_int64_t>(cursor->place);
        case ZIP_SOURCE_STAT:
            return stateOf(*cursor, bytes);
        case ZIP_SOURCE_ERROR:
            return zip_error_to_data(&cursor->error, bytes, count);
        case ZIP_SOURCE_CLOSE:
            return 0;
        case ZIP_SOURCE_FREE:
            delete cursor;
            return 0;
        case ZIP_SOURCE_SUPPORTS:
            return zip_source_make_command_bitmap(
                ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE, ZIP_SOURCE_STAT,
                ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, ZIP_SOURCE_SEEK, ZIP_SOURCE_TELL,
                ZIP_SOURCE_SUPPORTS, -1);
        default:
            return fail(*cursor, ZIP_ER_OPNOTSUPP, 0);
    }
}

}  // namespace

SharedFile::SharedFile(const std::filesystem::path& path)
    : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat state {};
    if (!file_.isOpen() || fstat(file_.number(), &state) != 0) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    }
    size_ = static_cast<std::uint64_t>(state.st_size);
}

std::int64_t SharedFile::read(std::uint64_t offset, void* bytes, std::uint64_t count) const {
    while (true) {
        const ssize_t got = pread(file_.number(), bytes, count, static_cast<off_t>(offset));
        if (got >= 0 || errno != EINTR) return got;
    }
}

ZipHandle openZip(const SharedFile& file, const std::filesystem::path& name) {
    zip_error_t error;
    zip_error_init(&error);
    const auto fault = [&] {
        const std::string reason = zip_error_strerror(&error);
        zip_error_fini(&error);
        return std::runtime_error(fmt::format(
            "{}: is not a readable zip archive: {}; fetch it again", name.string(), reason));
    };
    auto cursor = std::make_unique<Cursor>(Cursor{&file, 0, 0, {}, {}});
    zip_source_t* source = zip_source_function_create(onZipCommand, cursor.get(), &error);
    if (source == nullptr) throw fault();
    static_cast<void>(cursor.release());  // The source's, from here on.
    ZipHandle archive(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!archive) {
        zip_source_free(source);
        throw fault();
    }
    zip_error_fini(&error);
    return archive;
}

}  // namespace abrdf
