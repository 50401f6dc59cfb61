// SPDX-License-Identifier: BSD-3-Clause
//
// UTIA BRDF EXR: a 288 x 288 RGB image of floats.
#include "abrdf/output_file.h"
#include "stages/export/utia_table.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

namespace {

constexpr int kSide = 288;

Imf::Header exrHeader(const ExportSource& source, const ExportReport& report) {
    Imf::Header header(kSide, kSide);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* channel : {"R", "G", "B"}) {
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    }
    header.insert("Software", Imf::StringAttribute("abrdf"));
    header.insert("utia:source", Imf::StringAttribute(source.name));
    for (const auto& [key, value] : report.details.items()) {
        header.insert(("utia:" + key).c_str(), Imf::StringAttribute(value.get<std::string>()));
    }
    header.insert("utia:extrapolated",
                  Imf::StringAttribute(fmt::format("{} of {} values past the measured elevations",
                                                   report.extrapolated, report.values)));
    Imf::addChromaticities(header, Imf::Chromaticities());  // Rec.709 and D65.
    return header;
}

}  // namespace

ExportReport writeUtiaExr(const std::filesystem::path& path, const ExportSource& source,
                          const ExportOptions& options) {
    UtiaTable table = utiaTable(source, options);
    for (Rgb& c : table.values) {
        const auto encoded = [&](float v) {
            return static_cast<float>(utiaFromLinear(static_cast<double>(v), options.utiaEncoding));
        };
        c = {encoded(c.r), encoded(c.g), encoded(c.b)};
    }
    try {
        Imf::StdOSStream stream;
        {
            Imf::OutputFile file(stream, exrHeader(source, table.report), 0);
            Imf::FrameBuffer buffer;
            std::size_t offset = 0;
            for (const char* channel : {"R", "G", "B"}) {
                char* first = reinterpret_cast<char*>(table.values.data()) + offset;
                buffer.insert(channel,
                              Imf::Slice(Imf::FLOAT, first, sizeof(Rgb), kSide * sizeof(Rgb)));
                offset += sizeof(float);
            }
            file.setFrameBuffer(buffer);
            file.writePixels(kSide);
        }
        writeWholeFile(path, stream.str());
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
    table.report.details["layout"] = "288 x 288 float RGB";
    return table.report;
}

}  // namespace abrdf
