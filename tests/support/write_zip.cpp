// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/write_zip.h"

#include <zip.h>

#include <set>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

void writeZip(const fs::path& zip, const fs::path& folder, bool deflate) {
    int code = 0;
    zip_t* archive = zip_open(zip.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (archive == nullptr) throw std::runtime_error("cannot create " + zip.string());
    std::set<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.insert(entry.path());
    }
    for (const fs::path& file : files) {
        zip_source_t* source = zip_source_file(archive, file.c_str(), 0, -1);
        const std::string name = file.lexically_relative(folder).generic_string();
        const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
        if (index < 0) throw std::runtime_error("cannot add " + name);
        zip_set_file_compression(archive, static_cast<zip_uint64_t>(index),
                                 deflate ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0);
    }
    if (zip_close(archive) != 0) throw std::runtime_error("cannot write " + zip.string());
}

}  // namespace abrdf
