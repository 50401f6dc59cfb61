// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/tile_encoder.h"

#include "stages/write/exr_chunk.h"

#include <fmt/format.h>
#include <openexr.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr int kZipLevel = 4;

exr_compression_t exrCompression(Compression compression) {
    switch (compression) {
        case Compression::kNone:
            return EXR_COMPRESSION_NONE;
        case Compression::kZips:
            return EXR_COMPRESSION_ZIPS;
        case Compression::kZip:
            return EXR_COMPRESSION_ZIP;
        case Compression::kPiz:
            return EXR_COMPRESSION_PIZ;
    }
    return EXR_COMPRESSION_ZIP;
}

void check(exr_result_t result, const char* what) {
    if (result == EXR_ERR_SUCCESS) return;
    throw std::runtime_error(
        fmt::format("OpenEXR cannot {}: {}", what, exr_get_default_error_message(result)));
}

void ignoreError(exr_const_context_t, exr_result_t, const char*) {}

/// The core insists on a header before it compresses; this one goes nowhere.
std::int64_t writeNowhere(exr_const_context_t, void*, const void*, std::uint64_t size,
                          std::uint64_t, exr_stream_error_func_ptr_t) {
    return static_cast<std::int64_t>(size);
}

/// Frees what an encoder took.
struct Pipeline {
    exr_encode_pipeline_t encode{};  // As EXR_ENCODE_PIPELINE_INITIALIZER, which clang warns of.
    exr_const_context_t context = nullptr;

    Pipeline() = default;
    ~Pipeline() {
        if (context != nullptr) exr_encoding_destroy(context, &encode);
    }
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
};

/// The tile is packed already.
exr_result_t takePacked(exr_encode_pipeline_t* encode) {
    std::memcpy(encode->packed_buffer, encode->encoding_user_data, encode->chunk.unpacked_size);
    encode->packed_bytes = encode->chunk.unpacked_size;
    return EXR_ERR_SUCCESS;
}

exr_result_t keepChunk(exr_encode_pipeline_t*) {
    return EXR_ERR_SUCCESS;
}

}  // namespace

struct TileEncoder::Core {
    exr_context_t context = nullptr;

    ~Core() {
        if (context != nullptr) exr_finish(&context);
    }
};

Compression compressionFromName(const std::string& name) {
    for (const Compression compression :
         {Compression::kNone, Compression::kZips, Compression::kZip, Compression::kPiz}) {
        if (nameOf(compression) == name) return compression;
    }
    throw std::invalid_argument(
        fmt::format("there is no compression '{}': use none, zips, zip or piz", name));
}

std::string nameOf(Compression compression) {
    switch (compression) {
        case Compression::kNone:
            return "none";
        case Compression::kZips:
            return "zips";
        case Compression::kZip:
            return "zip";
        case Compression::kPiz:
            return "piz";
    }
    return "zip";
}

TileEncoder::TileEncoder(int width, int height, int tileWidth, int tileHeight, PixelType type,
                         Compression compression, std::optional<int> part)
    : part_(part) {
    if (compression == Compression::kNone) return;
    core_ = std::make_unique<Core>();
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = ignoreError;
    start.write_fn = writeNowhere;
    exr_context_t& context = core_->context;
    check(exr_start_write(&context, "tiles", EXR_WRITE_FILE_DIRECTLY, &start), "begin a header");
    int first = 0;
    check(exr_add_part(context, "tiles", EXR_STORAGE_TILED, &first), "begin a header");
    check(exr_initialize_required_attr_simple(context, first, width, height,
                                              exrCompression(compression)),
          "make a header");
    check(exr_set_tile_descriptor(context, first, static_cast<std::uint32_t>(tileWidth),
                                  static_cast<std::uint32_t>(tileHeight), EXR_TILE_ONE_LEVEL,
                                  EXR_TILE_ROUND_DOWN),
          "make a header of such tiles");
    for (const char* channel : {"R", "G", "B"}) {
        check(exr_add_channel(context, first, channel,
                              type == PixelType::kHalf ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                              EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1),
              "make a header");
    }
    // The level of OpenEXR's own files. The core's is zlib's, a few percent smaller at twice the
    // time.
    check(exr_set_zip_compression_level(context, first, kZipLevel), "make a header");
    check(exr_write_header(context), "make a header");
}

TileEncoder::~TileEncoder() = default;

void TileEncoder::encode(int tileX, int tileY, std::span<const char> packed,
                         std::vector<char>& chunks) const {
    if (!core_) {
        appendChunk({part_, tileX, tileY, packed}, chunks);
        return;
    }
    exr_chunk_info_t chunk{};
    check(exr_write_tile_chunk_info(core_->context, 0, tileX, tileY, 0, 0, &chunk), "find a tile");
    Pipeline pipeline;
    exr_encode_pipeline_t& encode = pipeline.encode;
    check(exr_encoding_initialize(core_->context, 0, &chunk, &encode), "begin a tile");
    pipeline.context = core_->context;
    if (chunk.unpacked_size != packed.size()) {
        throw std::logic_error(fmt::format("tile ({}, {}) has {} bytes, not {}", tileX, tileY,
                                           packed.size(), chunk.unpacked_size));
    }
    for (int c = 0; c < encode.channel_count; ++c) {
        // Not read: the tile is packed already.
        encode.channels[c].encode_from_ptr = reinterpret_cast<const std::uint8_t*>(packed.data());
        const auto bytes = static_cast<std::uint8_t>(encode.channels[c].bytes_per_element);
        encode.channels[c].user_pixel_stride = bytes;
        encode.channels[c].user_line_stride = bytes;
        encode.channels[c].user_bytes_per_element = bytes;
        encode.channels[c].user_data_type = encode.channels[c].data_type;
    }
    check(exr_encoding_choose_default_routines(core_->context, 0, &encode), "compress a tile");
    encode.encoding_user_data = const_cast<char*>(packed.data());
    encode.convert_and_pack_fn = takePacked;
    encode.yield_until_ready_fn = nullptr;
    encode.write_fn = keepChunk;
    check(exr_encoding_run(core_->context, 0, &encode), "compress a tile");
    const bool smaller = encode.compressed_bytes < packed.size();
    const std::span compressed(static_cast<const char*>(encode.compressed_buffer),
                               encode.compressed_bytes);
    appendChunk({part_, tileX, tileY, smaller ? compressed : packed}, chunks);
}

}  // namespace abrdf
