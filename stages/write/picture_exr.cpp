// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/picture_exr.h"

#include "color/known_space.h"
#include "stages/write/exr_stream.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>

namespace abrdf {

namespace {

constexpr float kLargestHalf = 65504;

Imf::Header headerOf(const ExrPart& part) {
    Imf::Header header(part.width, part.height);
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const ExrPart::Channel& channel : part.channels) {
        header.channels().insert(channel.name,
                                 Imf::Channel(channel.asHalf ? Imf::HALF : Imf::FLOAT));
    }
    for (const auto& [name, text] : part.notes) header.insert(name, Imf::StringAttribute(text));
    for (const auto& [name, number] : part.numbers) {
        header.insert(name, Imf::FloatAttribute(number));
    }
    if (part.atlas != nullptr) {
        storeAtlasHeader(*part.atlas, header);
        return header;
    }
    header.insert("Software", Imf::StringAttribute("abrdf"));
    header.insert("colorInteropID", Imf::StringAttribute(part.interopId));
    if (!part.colorSpace.empty()) {
        header.insert("abrdf:colorSpace", Imf::StringAttribute(part.colorSpace));
    }
    if (const auto space = knownSpaceFromInteropId(part.interopId)) {
        const Primaries p = primaries(*space);
        const auto xy = [](const std::array<float, 2>& c) { return Imath::V2f(c[0], c[1]); };
        Imf::addChromaticities(header, {xy(p.red), xy(p.green), xy(p.blue), xy(p.white)});
    }
    return header;
}

void writePart(Imf::MultiPartOutputFile& file, int index, const ExrPart& part) {
    Imf::OutputPart output(file, index);
    Imf::FrameBuffer buffer;
    const auto width = static_cast<std::size_t>(part.width);
    std::vector<std::vector<half>> halves(part.channels.size());
    for (std::size_t i = 0; i < part.channels.size(); ++i) {
        const ExrPart::Channel& channel = part.channels[i];
        // OpenEXR's frame buffers are not const, though a writer only reads them.
        auto* base = const_cast<char*>(reinterpret_cast<const char*>(channel.values.data()));
        std::size_t size = sizeof(float);
        if (channel.asHalf) {
            for (const float value : channel.values) {
                halves[i].emplace_back(std::clamp(value, -kLargestHalf, kLargestHalf));
            }
            base = reinterpret_cast<char*>(halves[i].data());
            size = sizeof(half);
        }
        buffer.insert(channel.name, Imf::Slice(channel.asHalf ? Imf::HALF : Imf::FLOAT, base, size,
                                               size * width));
    }
    output.setFrameBuffer(buffer);
    output.writePixels(part.height);
}

template <typename Value, typename Get>
std::vector<float> channelOf(const std::vector<Value>& values, const Get& get) {
    std::vector<float> channel;
    channel.reserve(values.size());
    for (const Value& value : values) channel.push_back(get(value));
    return channel;
}

}  // namespace

std::vector<ExrPart> partsOf(const Picture& picture, const std::string& colorSpace,
                             const std::string& interopId) {
    ExrPart rgba{"rgba", picture.width, picture.height, {}, colorSpace, interopId, {}};
    rgba.channels = {{"R", channelOf(picture.color, [](const Rgb& c) { return c.r; }), true},
                     {"G", channelOf(picture.color, [](const Rgb& c) { return c.g; }), true},
                     {"B", channelOf(picture.color, [](const Rgb& c) { return c.b; }), true},
                     {"A", picture.alpha, true}};
    ExrPart depth{"depth", picture.width, picture.height, {{"Z", picture.depth, false}}, "", "data",
                  {}};
    ExrPart normals{"normals", picture.width, picture.height, {}, "", "data", {}};
    const auto& n = picture.normals;
    normals.channels = {{"N.X", channelOf(n, [](const Imath::V3f& v) { return v.x; }), true},
                        {"N.Y", channelOf(n, [](const Imath::V3f& v) { return v.y; }), true},
                        {"N.Z", channelOf(n, [](const Imath::V3f& v) { return v.z; }), true}};
    return {rgba, depth, normals};
}

std::uint64_t writeExrParts(const std::filesystem::path& path, const std::vector<ExrPart>& parts) {
    std::vector<Imf::Header> headers;
    for (const ExrPart& part : parts) headers.push_back(headerOf(part));
    ExrStream stream(path);
    {
        // Chromaticities are shared by all parts of a file: the format has them so.
        Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()),
                                      true, 0);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            writePart(file, static_cast<int>(i), parts[i]);
        }
    }
    return stream.commit();
}

}  // namespace abrdf
