// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/model_reader.h"

#include "abrdf/model_parts.h"
#include "stages/read/exr_header_check.h"
#include "stages/read/mapped_file.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace abrdf {

namespace {

/// A part's image: rows from the top.
struct Plane {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values;
};

class ModelFile {
  public:
    explicit ModelFile(const std::filesystem::path& path)
        : name_(path.string()), file_(path.c_str(), 0) {
        for (int i = 0; i < file_.parts(); ++i) {
            if (file_.header(i).hasName()) parts_[file_.header(i).name()] = i;
        }
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error(
            fmt::format("{}: is a damaged model atlas: {}; convert it anew", name_, what));
    }

    const Imf::Header& front() const { return file_.header(0); }
    bool has(const char* part) const { return parts_.contains(part); }

    float number(const char* attribute) const {
        const auto* found = front().findTypedAttribute<Imf::FloatAttribute>(attribute);
        if (found == nullptr) fail(fmt::format("it lacks the attribute {}", attribute));
        return found->value();
    }

    Plane plane(const char* part, const std::string& channel) {
        Plane plane;
        plane.values = std::move(planes(part, {channel}, plane).front());
        return plane;
    }

    /// Some channels of a part, all read at once; `size` gets its width and height.
    std::vector<std::vector<float>> planes(const char* part,
                                           const std::vector<std::string>& channels, Plane& size) {
        const auto found = parts_.find(part);
        if (found == parts_.end()) fail(fmt::format("it lacks the part {}", part));
        Imf::InputPart input(file_, found->second);
        const Imath::Box2i& box = input.header().dataWindow();
        if (box.min != Imath::V2i(0, 0)) fail(fmt::format("part {} is cut", part));
        size.width = static_cast<std::size_t>(box.max.x) + 1;
        size.height = static_cast<std::size_t>(box.max.y) + 1;
        std::vector<std::vector<float>> planes(channels.size());
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (input.header().channels().findChannel(channels[c]) == nullptr) {
                fail(fmt::format("part {} lacks the channel {}", part, channels[c]));
            }
            planes[c].resize(size.width * size.height);
            buffer.insert(channels[c],
                          Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[c].data()),
                                     sizeof(float), sizeof(float) * size.width));
        }
        input.setFrameBuffer(buffer);
        input.readPixels(0, box.max.y);
        return planes;
    }

    /// Maps of the atlas's texels.
    std::vector<std::vector<float>> maps(const char* part, const std::vector<std::string>& channels,
                                         std::size_t texels) {
        Plane size;
        auto found = planes(part, channels, size);
        if (size.width * size.height != texels) fail(fmt::format("part {} has another size", part));
        return found;
    }

  private:
    std::string name_;
    Imf::MultiPartInputFile file_;
    std::map<std::string, int> parts_;
};

PackedMatrix matrixFrom(const Plane& plane) {
    using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return PackedMatrix(Eigen::Map<const RowMajor>(plane.values.data(),
                                                   static_cast<Eigen::Index>(plane.height),
                                                   static_cast<Eigen::Index>(plane.width)));
}

TexelBasis basisFrom(ModelFile& file, const char* luminance, const char* chroma, TexelRule rule) {
    TexelBasis basis;
    basis.luminance = matrixFrom(file.plane(luminance, kBasisChannel));
    basis.chroma = matrixFrom(file.plane(chroma, kBasisChannel));
    const Plane centers = file.plane(kCentersPart, kBasisChannel);
    const std::size_t rows = basis.rows();
    if (basis.chroma.rows() != rows || basis.chroma.columns() != basis.luminance.columns() ||
        centers.height != rows || centers.width != rule.vectors() ||
        basis.luminance.columns() > std::numeric_limits<std::uint16_t>::max()) {
        file.fail("the parts of its basis do not fit one another");
    }
    for (std::size_t v = 0; v < rule.vectors(); ++v) {
        std::vector<float>& to = v < rule.logVectors() ? basis.logCenters[v]
                                                       : basis.chromaCenters[v - rule.logVectors()];
        for (std::size_t row = 0; row < rows; ++row) {
            to.push_back(centers.values[row * centers.width + v]);
        }
    }
    return basis;
}

TexelModel modelFrom(ModelFile& file, const AngularGrid& grid) {
    TexelRule rule{file.number(kModelCap), file.number(kModelFloor), file.number(kModelBlend)};
    if (!std::isfinite(rule.cap) || !std::isfinite(rule.floor) || !(rule.blend >= 0) ||
        rule.blend > 1) {
        file.fail("its header holds impossible numbers");
    }
    const bool hasSmall = file.has(kLuminancePart);
    const bool hasWhole = file.has(kWholeLuminancePart);
    TexelBasis basis = hasWhole ? basisFrom(file, kWholeLuminancePart, kWholeChromaPart, rule)
                                : basisFrom(file, kLuminancePart, kChromaPart, rule);
    const Plane rows = file.plane(kRowsPart, kBasisChannel);
    if (rows.values.size() != grid.pairCount()) file.fail("its rows are not of its grid");
    std::vector<std::size_t> rowOf;
    for (const float row : rows.values) {
        if (!(row >= 0) || row >= static_cast<float>(basis.rows())) file.fail("a row is not there");
        rowOf.push_back(static_cast<std::size_t>(row));
    }
    const std::vector<LightAndView> pairs = pairsOf(grid);
    TexelModel model(std::move(basis), rule, std::move(rowOf), pairs);
    if (hasSmall && hasWhole) {
        TexelBasis small = basisFrom(file, kLuminancePart, kChromaPart, rule);
        if (small.rows() != model.basis().rows()) file.fail("its bases do not fit one another");
        model.addSmall(std::move(small));
    }
    if (file.number(kModelIsotropic) != 0) model.addIsotropic(pairs);
    return model;
}

PackedCodes texelsFrom(ModelFile& file, const TexelModel& model, std::size_t count) {
    const auto maps =
        file.maps(kTexelsPart,
                  {"rank", "scale.Y", "scale.R", "scale.G", "scale.B", "mean.R", "mean.G"}, count);
    const std::vector<float>& ranks = maps[0];
    const std::size_t small = model.small() != nullptr ? model.small()->luminance.columns() : 0;
    std::size_t largest = 0;
    for (const float rank : ranks) {
        const auto whole = static_cast<float>(model.columns());
        const bool fits = rank >= 0 && rank <= whole && rank == std::floor(rank) &&
                          (small == 0 || rank == whole || rank <= static_cast<float>(small));
        if (!fits) file.fail("a texel has a rank that its basis lacks");
        largest = std::max(largest, static_cast<std::size_t>(rank));
    }
    const std::vector<std::string> names = vectorNames(model.rule());
    std::vector<std::vector<float>> numbers(count);
    for (std::size_t t = 0; t < count; ++t) {
        numbers[t].resize(names.size() * static_cast<std::size_t>(ranks[t]));
    }
    std::vector<std::string> channels;
    for (const std::string& name : names) {
        for (std::size_t k = 0; k < largest; ++k) channels.push_back(coefficientName(name, k));
    }
    std::vector<std::vector<float>> planes;
    if (largest > 0) planes = file.maps(kCoefficientsPart, channels, count);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const std::size_t k = i % largest;
        for (std::size_t t = 0; t < count; ++t) {
            const auto rank = static_cast<std::size_t>(ranks[t]);
            if (k < rank) numbers[t][i / largest * rank + k] = planes[i][t];
        }
    }
    PackedCodes texels(model.rule(), count);
    for (std::size_t t = 0; t < count; ++t) {
        texels.store(t,
                     {maps[1][t], {maps[2][t], maps[3][t], maps[4][t]}, {maps[5][t], maps[6][t]}},
                     static_cast<std::uint16_t>(ranks[t]), std::move(numbers[t]));
    }
    return texels;
}

}  // namespace

ModelAtlas readModelAtlas(const std::filesystem::path& path) {
    checkExrHeader(MappedFile(path).bytes(), path.string());
    try {
        ModelFile file(path);
        ModelAtlas atlas;
        atlas.header = atlasHeaderFrom(file.front(), path.string());
        if (atlas.header.layout.kind != AtlasKind::kModel) {
            throw std::runtime_error(fmt::format("{}: is an atlas of layout {}, not a model",
                                                 path.string(), nameOf(atlas.header.layout.kind)));
        }
        const std::size_t count = atlas.header.layout.texelCount();
        atlas.model = modelFrom(file, atlas.header.grid);
        atlas.texels = texelsFrom(file, atlas.model, count);
        atlas.most = std::move(file.maps(kTexelsPart, {"most"}, count).front());
        if (file.has("estimate")) {
            atlas.estimates = std::move(file.maps("estimate", {"deltaE"}, count).front());
        }
        return atlas;
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be read as OpenEXR: {}", path.string(), error.what()));
    }
}

}  // namespace abrdf
