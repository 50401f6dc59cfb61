// SPDX-License-Identifier: BSD-3-Clause
//
// RGL tensor file .bsdf (EPFL): 12 bytes "tensor_file\0", version 1.0, named arrays.
#include "abrdf/rgl_table.h"
#include "stages/read/byte_cursor.h"
#include "stages/read/mapped_file.h"
#include "stages/read/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace abrdf {

namespace {

constexpr std::string_view kMagic("tensor_file\0", 12);
constexpr std::uint8_t kUnsigned8 = 1;
constexpr std::uint8_t kFloat32 = 10;

struct Field {
    std::uint8_t type = 0;
    std::uint64_t offset = 0;
    std::vector<std::uint64_t> sizes;
};

class TensorFile {
  public:
    TensorFile(std::span<const char> bytes, const std::string& name) : file_(bytes, name) {
        file_.seek(kMagic.size());
        const auto major = file_.number<std::uint8_t>("version");
        const auto minor = file_.number<std::uint8_t>("version");
        if (major != 1 || minor != 0) {
            file_.fail(fmt::format("it is of version {}.{}, read is 1.0", major, minor));
        }
        const std::uint32_t count = file_.u32("field count");
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto text = file_.take(file_.number<std::uint16_t>("field name"), "field name");
            Field field;
            const auto dimensions = file_.number<std::uint16_t>("dimensions");
            field.type = file_.number<std::uint8_t>("field type");
            field.offset = file_.number<std::uint64_t>("field place");
            field.sizes = file_.numbers<std::uint64_t>(dimensions, "field sizes");
            fields_[std::string(text.begin(), text.end())] = std::move(field);
        }
    }

    bool has(const std::string& name) const { return fields_.contains(name); }

    /// Sizes of a float32 field of so many dimensions.
    const std::vector<std::uint64_t>& sizesOf(const std::string& name, std::size_t dimensions) {
        const Field& field = found(name, kFloat32);
        if (field.sizes.size() != dimensions) {
            file_.fail(fmt::format("its field {} has {} dimensions, not {}", name,
                                   field.sizes.size(), dimensions));
        }
        return field.sizes;
    }

    std::vector<float> floats(const std::string& name) {
        const Field& field = found(name, kFloat32);
        constexpr std::uint64_t kHuge = std::uint64_t{1} << 48;
        std::uint64_t count = 1;
        for (const std::uint64_t size : field.sizes) count = boundedProduct(count, size, kHuge);
        file_.seek(field.offset);
        std::vector<float> values = file_.numbers<float>(count, name.c_str());
        if (!std::ranges::all_of(values, [](float v) { return std::isfinite(v); })) {
            file_.fail(fmt::format("its field {} holds NaN or infinite numbers", name));
        }
        return values;
    }

    std::uint8_t byte(const std::string& name) {
        file_.seek(found(name, kUnsigned8).offset);
        return file_.number<std::uint8_t>(name.c_str());
    }

    [[noreturn]] void fail(const std::string& why) const { file_.fail(why); }

  private:
    const Field& found(const std::string& name, std::uint8_t type) const {
        const auto field = fields_.find(name);
        if (field == fields_.end()) {
            file_.fail(
                fmt::format("it has no field {}: an RGB file is read, no spectral one", name));
        }
        if (field->second.type != type) {
            file_.fail(
                fmt::format("its field {} is of type {}, not {}", name, field->second.type, type));
        }
        return field->second;
    }

    ByteCursor file_;
    std::map<std::string, Field> fields_;
};

/// The nodes of a parameter, ascending.
std::vector<float> nodes(TensorFile& file, const std::string& name) {
    file.sizesOf(name, 1);
    std::vector<float> values = file.floats(name);
    const bool ascending =
        std::ranges::adjacent_find(values, std::greater_equal<>()) == values.end();
    if (values.empty() || !ascending) {
        file.fail(fmt::format("its field {} is not an ascending list", name));
    }
    return values;
}

/// Tables whose last two sizes are height and width, `leading` the ones before.
TableStack tables(TensorFile& file, const std::string& name,
                  const std::vector<std::uint64_t>& leading) {
    const std::vector<std::uint64_t> sizes = file.sizesOf(name, leading.size() + 2);
    const std::uint64_t height = sizes[sizes.size() - 2];
    const std::uint64_t width = sizes.back();
    if (!std::equal(leading.begin(), leading.end(), sizes.begin()) || height < 2 || width < 2) {
        file.fail(fmt::format("the sizes of its field {} do not fit those of the others", name));
    }
    return {width, height, file.floats(name)};
}

RglData readRgl(TensorFile& file) {
    std::vector<float> phiIn = nodes(file, "phi_i");
    std::vector<float> thetaIn = nodes(file, "theta_i");
    const std::uint64_t phis = phiIn.size();
    const std::uint64_t thetas = thetaIn.size();
    // Files of the first days have no such field, and hold the ratio as those that say so.
    const bool jacobian = !file.has("jacobian") || file.byte("jacobian") != 0;
    return {std::move(phiIn),
            std::move(thetaIn),
            tables(file, "ndf", {}),
            tables(file, "sigma", {}),
            tables(file, "vndf", {phis, thetas}),
            tables(file, "rgb", {phis, thetas, 3}),
            jacobian};
}

}  // namespace

bool recognizesRgl(const DatabasePath& path) {
    return !path.files && path.head.starts_with(kMagic);
}

std::unique_ptr<BtfReader> makeRglReader(const DatabasePath& path) {
    const MappedFile map(path.path);
    TensorFile file(map.bytes(), path.path.string());
    RglData data = readRgl(file);
    map.checkWhole();
    BtfDescription description = tableDescription(path, "RGL");
    description.cosineFrom = "convention of the format: f cos(theta_i) by its published evaluation";
    description.maxMeasuredTheta = static_cast<double>(data.thetaIn.back());
    description.notes.push_back(data.phiIn.size() <= 2 ? "isotropic" : "anisotropic");
    return makeTableReader(path, std::move(description),
                           std::make_unique<RglTable>(std::move(data)));
}

}  // namespace abrdf
