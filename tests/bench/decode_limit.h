// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/for_each_texel.h"
#include "pipeline/convert/convert.h"
#include "pipeline/convert/dry_run.h"

#include <turbojpeg.h>
#include <zip.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using Bytes = std::vector<unsigned char>;

struct FreeTurbo {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using Turbo = std::unique_ptr<void, FreeTurbo>;

/// The bytes of the images that `convert` reads, in its order.
inline std::vector<Bytes> plannedImages(const abrdf::ConvertOptions& options) {
    zip_t* archive = zip_open(options.input.input.c_str(), ZIP_RDONLY, nullptr);
    if (archive == nullptr) throw std::runtime_error("the database is not a zip");
    std::vector<Bytes> images;
    const nlohmann::ordered_json plan = abrdf::planConvert(options);
    for (const std::string file : plan["images"]) {
        const std::string name = file.substr(file.find(": ") + 2);
        zip_stat_t stat;
        zip_file_t* entry = zip_fopen(archive, name.c_str(), 0);
        if (entry == nullptr || zip_stat(archive, name.c_str(), 0, &stat) != 0) {
            throw std::runtime_error(name + " is not in the database");
        }
        Bytes bytes(stat.size);
        zip_fread(entry, bytes.data(), bytes.size());
        zip_fclose(entry);
        images.push_back(std::move(bytes));
    }
    zip_discard(archive);
    return images;
}

/// The limit: nothing but decoding, from memory, on all cores.
inline void decodeAll(const std::vector<Bytes>& images) {
    abrdf::forEachImage(images.size(), [&](std::size_t i) {
        thread_local const Turbo turbo(tjInitDecompress());
        thread_local Bytes pixels;
        int width = 0;
        int height = 0;
        int sampling = 0;
        int space = 0;
        const auto size = static_cast<unsigned long>(images[i].size());
        const bool known = tjDecompressHeader3(turbo.get(), images[i].data(), size, &width, &height,
                                               &sampling, &space) == 0;
        pixels.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        if (!known || tjDecompress2(turbo.get(), images[i].data(), size, pixels.data(), width, 0,
                                    height, TJPF_RGB, TJFLAG_ACCURATEDCT) != 0) {
            throw std::runtime_error(tjGetErrorStr2(turbo.get()));
        }
    });
}
