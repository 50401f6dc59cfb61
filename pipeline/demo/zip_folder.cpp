// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/demo/zip_folder.h"

#include "abrdf/cancel.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

// 2020-01-01 00:00:00 as MS-DOS wrote dates: 7 bits of years from 1980, 4 of months, 5 of days.
constexpr zip_uint16_t kDosDate = (40 << 9) | (1 << 5) | 1;
constexpr zip_uint16_t kDosTime = 0;
constexpr zip_int64_t kToTheEnd = -1;
constexpr zip_uint32_t kPlainFile = 0100644U << 16;  // Unix mode, whatever the umask

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

[[noreturn]] void fail(const fs::path& zip, const std::string& reason) {
    throw std::runtime_error(
        fmt::format("{}: cannot be written: {}; see to it and run again", zip.string(), reason));
}

Archive newArchive(const fs::path& zip) {
    int code = 0;
    Archive archive(zip_open(zip.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
    if (archive) return archive;
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    fail(zip, reason);
}

std::vector<std::string> sortedFiles(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            names.push_back(entry.path().lexically_relative(folder).generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// False where libzip refuses.
bool add(zip_t* archive, const fs::path& file, const std::string& name) {
    zip_source_t* source = zip_source_file(archive, file.c_str(), 0, kToTheEnd);
    if (source == nullptr) return false;
    const zip_int64_t added = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (added < 0) {
        zip_source_free(source);
        return false;
    }
    const auto index = static_cast<zip_uint64_t>(added);
    return zip_set_file_compression(archive, index, ZIP_CM_STORE, 0) == 0 &&
           zip_file_set_dostime(archive, index, kDosTime, kDosDate, 0) == 0 &&
           zip_file_set_external_attributes(archive, index, 0, ZIP_OPSYS_UNIX, kPlainFile) == 0;
}

int isCancelled(zip_t*, void*) {
    try {
        throwIfCancelled();
        return 0;
    } catch (const Cancelled&) {
        return 1;
    }
}

}  // namespace

void zipFolder(const fs::path& folder, const fs::path& zip) {
    Archive archive = newArchive(zip);
    for (const std::string& name : sortedFiles(folder)) {
        if (!add(archive.get(), folder / name, name)) fail(zip, zip_strerror(archive.get()));
    }
    zip_register_cancel_callback_with_state(archive.get(), isCancelled, nullptr, nullptr);
    // All reading and writing is here; libzip puts the file in place when it is whole.
    if (zip_close(archive.get()) != 0) {
        throwIfCancelled();
        fail(zip, zip_strerror(archive.get()));
    }
    static_cast<void>(archive.release());  // zip_close() freed it
}

}  // namespace abrdf
