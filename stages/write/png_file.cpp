// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/coded_file.h"
#include "stages/write/icc_profile.h"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>

namespace abrdf {

namespace {

[[noreturn]] void fail(png_structp /*png*/, png_const_charp message) {
    throw std::runtime_error(fmt::format("the PNG cannot be encoded: {}", message));
}

void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

void append(png_structp png, png_bytep data, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
}

void flush(png_structp /*png*/) {}

/// libpng's two handles.
struct Writer {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

    Writer() = default;
    ~Writer() { png_destroy_write_struct(&png, &info); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
};

void setEncoding(const Writer& writer, const DisplayEncoding& encoding) {
    if (encoding.name == "sRGB") {
        png_set_sRGB_gAMA_and_cHRM(writer.png, writer.info, PNG_sRGB_INTENT_RELATIVE);
        return;
    }
    const std::string profile = iccProfile(encoding);
    if (profile.empty()) return;
    png_set_iCCP(writer.png, writer.info, encoding.name.c_str(), PNG_COMPRESSION_TYPE_BASE,
                 reinterpret_cast<png_const_bytep>(profile.data()),
                 static_cast<png_uint_32>(profile.size()));
}

/// libpng 1.6 does not know cICP (PNG, third edition), which must stand before PLTE and IDAT.
void writeCicp(const Writer& writer, const DisplayEncoding& encoding) {
    if (encoding.name == "sRGB" || !encoding.cicp) return;
    constexpr png_byte kName[5] = {'c', 'I', 'C', 'P', '\0'};
    png_write_chunk(writer.png, kName, encoding.cicp->data(), encoding.cicp->size());
}

/// A row as the file has it: one byte a code, or two with the high one first.
std::vector<png_byte> rowBytes(const CodedPicture& picture, int y) {
    const auto length =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
    const std::uint16_t* codes = &picture.codes[static_cast<std::size_t>(y) * length];
    std::vector<png_byte> bytes;
    bytes.reserve(2 * length);
    for (std::size_t i = 0; i < length; ++i) {
        if (picture.bits == 16) bytes.push_back(static_cast<png_byte>(codes[i] >> 8U));
        bytes.push_back(static_cast<png_byte>(codes[i] & 0xFFU));
    }
    return bytes;
}

}  // namespace

std::string pngBytes(const CodedPicture& picture) {
    std::string file;
    const Writer writer;
    if (writer.info == nullptr) throw std::runtime_error("libpng cannot be started");
    png_set_write_fn(writer.png, &file, append, flush);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height), picture.bits,
                 picture.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (picture.encoding) setEncoding(writer, *picture.encoding);
    std::vector<png_text> texts;
    for (const auto& [keyword, text] : picture.notes) {
        png_text entry{};
        entry.compression = PNG_TEXT_COMPRESSION_NONE;
        entry.key = const_cast<char*>(keyword.c_str());
        entry.text = const_cast<char*>(text.c_str());
        texts.push_back(entry);
    }
    png_set_text(writer.png, writer.info, texts.data(), static_cast<int>(texts.size()));
    png_set_compression_level(writer.png, 6);
    if (picture.encoding) {
        // After IHDR and before all that libpng itself writes.
        png_write_info_before_PLTE(writer.png, writer.info);
        writeCicp(writer, *picture.encoding);
    }
    png_write_info(writer.png, writer.info);
    for (int y = 0; y < picture.height; ++y) png_write_row(writer.png, rowBytes(picture, y).data());
    png_write_end(writer.png, writer.info);
    return file;
}

}  // namespace abrdf
