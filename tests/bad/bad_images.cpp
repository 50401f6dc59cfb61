// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bad/bad_images.h"

#include "tests/support/small_files.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <turbojpeg.h>
#include <zlib.h>

#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

std::string bigEndian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
    }
    return bytes;
}

std::string pngChunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return bigEndian(static_cast<std::uint32_t>(data.size())) + body +
           bigEndian(static_cast<std::uint32_t>(crc));
}

std::string pngHeader(std::uint32_t width, std::uint32_t height) {
    return pngChunk("IHDR", bigEndian(width) + bigEndian(height) + std::string("\x8\x0\0\0\0", 5));
}

void check(bool works, const std::string& what) {
    if (!works) throw std::runtime_error("cannot write " + what);
}

void writePart(OIIO::ImageOutput& output, const OIIO::ImageSpec& spec, float value) {
    const auto pixels =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    if (spec.deep) {
        OIIO::DeepData data(spec);
        for (std::int64_t p = 0; p < static_cast<std::int64_t>(pixels); ++p) {
            data.set_samples(p, 1);
            for (int c = 0; c < spec.nchannels; ++c) data.set_deep_value(p, c, 0, value);
        }
        check(output.write_deep_image(data), output.geterror());
        return;
    }
    const std::vector<float> values(pixels * static_cast<std::size_t>(spec.nchannels), value);
    check(output.write_image(OIIO::TypeDesc::FLOAT, values.data()), output.geterror());
}

}  // namespace

std::string bytesOf(const OddImage& image) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / ("a." + image.extension)).string();
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                         image.bits == 8    ? OIIO::TypeDesc::UINT8
                         : image.bits == 16 ? OIIO::TypeDesc::UINT16
                                            : OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.deep = image.deep;
    const std::vector<OIIO::ImageSpec> specs(static_cast<std::size_t>(image.parts), spec);
    const auto output = OIIO::ImageOutput::create(path);
    check(output != nullptr, path);
    const bool isOpen =
        image.parts > 1 ? output->open(path, image.parts, specs.data()) : output->open(path, spec);
    check(isOpen, output->geterror());
    for (int part = 0; part < image.parts; ++part) {
        const auto mode = OIIO::ImageOutput::AppendSubimage;
        if (part > 0) check(output->open(path, spec, mode), output->geterror());
        writePart(*output, spec, image.value);
    }
    check(output->close(), output->geterror());
    return bytesOf(std::filesystem::path(path));
}

std::string subsampledExr() {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "a.exr").string();
    {
        Imf::Header header(4, 4);
        std::array<float, 16> values{};
        Imf::FrameBuffer buffer;
        for (const char* name : {"R", "G", "B"}) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT, 2, 2));
            buffer.insert(
                name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8, 2, 2));
        }
        Imf::OutputFile file(path.c_str(), header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(4);
    }
    return bytesOf(std::filesystem::path(path));
}

std::string cmykJpeg() {
    const std::vector<unsigned char> inks(std::size_t{8} * 8 * 4, 100);
    tjhandle handle = tjInitCompress();
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    const int status =
        tjCompress2(handle, inks.data(), 8, 0, 8, TJPF_CMYK, &jpeg, &size, TJSAMP_444, 90, 0);
    const std::string bytes(reinterpret_cast<const char*>(jpeg), size);
    tjFree(jpeg);
    tjDestroy(handle);
    check(status == 0, "a JPEG of four inks");
    return bytes;
}

std::string jpegOfScans(int count) {
    const std::vector<unsigned char> grey(std::size_t{64} * 64, 100);
    tjhandle handle = tjInitCompress();
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    const int status = tjCompress2(handle, grey.data(), 64, 0, 64, TJPF_GRAY, &jpeg, &size,
                                   TJSAMP_GRAY, 90, TJFLAG_PROGRESSIVE);
    const std::string bytes(reinterpret_cast<const char*>(jpeg), size);
    tjFree(jpeg);
    tjDestroy(handle);
    check(status == 0, "a progressive JPEG");
    // The last scan refines one bit of coefficients and may be said again.
    const std::size_t last = bytes.rfind("\xff\xda");
    const std::string scan = bytes.substr(last, bytes.size() - 2 - last);
    std::string many = bytes.substr(0, bytes.size() - 2);
    for (int i = 0; i < count; ++i) many += scan;
    return many + "\xff\xd9";
}

std::string blackPng(std::uint32_t side) {
    // A row at a time: a filter byte and its pixels.
    z_stream stream{};
    check(deflateInit(&stream, 9) == Z_OK, "a PNG");
    std::string row(std::size_t{side} + 1, '\0');
    std::string packed;
    std::array<char, 65536> buffer{};
    for (std::uint32_t y = 0; y < side; ++y) {
        stream.next_in = reinterpret_cast<Bytef*>(row.data());
        stream.avail_in = static_cast<uInt>(row.size());
        do {
            stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
            stream.avail_out = static_cast<uInt>(buffer.size());
            deflate(&stream, y + 1 == side ? Z_FINISH : Z_NO_FLUSH);
            packed.append(buffer.data(), buffer.size() - stream.avail_out);
        } while (stream.avail_out == 0);
    }
    deflateEnd(&stream);
    return "\x89PNG\r\n\x1a\n" + pngHeader(side, side) + pngChunk("IDAT", packed) +
           pngChunk("IEND", "");
}

std::string withPngSize(std::string png, std::uint32_t width, std::uint32_t height) {
    const std::string was = png.substr(24, 5);  // Bits, kind of colour, and the rest.
    return png.replace(8, 25, pngChunk("IHDR", bigEndian(width) + bigEndian(height) + was));
}

}  // namespace abrdf
