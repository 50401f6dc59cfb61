// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/model_file.h"

#include "abrdf/content_hash.h"
#include "abrdf/output_file.h"
#include "abrdf/pair_features.h"
#include "abrdf/zeroed_vector.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace abrdf {

static_assert(std::endian::native == std::endian::little,
              "models are written as memory holds them");

namespace {

// The last number changes with the form of the file, or with what training makes of its options.
constexpr char kMagic[16] = "abrdf prior 007";

/// Appends plain values and Eigen's arrays.
class Bytes {
  public:
    template <typename T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void add(const std::vector<LightAndView>& pairs) {
        add(std::uint64_t{pairs.size()});
        for (const LightAndView& p : pairs) {
            for (const double angle : {p.light.theta, p.light.phi, p.view.theta, p.view.phi}) {
                add(angle);
            }
        }
    }
    template <typename Derived>
    void addArray(const Eigen::PlainObjectBase<Derived>& array) {
        add(std::int64_t{array.rows()});
        add(std::int64_t{array.cols()});
        text_.append(reinterpret_cast<const char*>(array.data()),
                     static_cast<std::size_t>(array.size()) * sizeof(typename Derived::Scalar));
    }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

/// Takes them out again; never past the end, whatever the numbers say.
class Reader {
  public:
    Reader(std::span<const char> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

    [[noreturn]] void fail() const {
        throw std::runtime_error(
            fmt::format("{}: is not a whole model of the prior; delete it, or train it again with "
                        "abrdf train",
                        name_));
    }
    template <typename T>
    T take() {
        T value;
        copyTo(&value, sizeof value);
        return value;
    }
    std::vector<LightAndView> takePairs() {
        const auto count = take<std::uint64_t>();
        if (count > bytes_.size() / (4 * sizeof(double))) fail();
        std::vector<LightAndView> pairs(count);
        for (LightAndView& p : pairs) {
            for (double* angle : {&p.light.theta, &p.light.phi, &p.view.theta, &p.view.phi}) {
                *angle = take<double>();
                if (!(std::abs(*angle) < 100)) fail();  // Radians.
            }
        }
        return pairs;
    }
    template <typename Array>
    void takeArray(Array& array, Eigen::Index rows, Eigen::Index columns) {
        using Scalar = typename Array::Scalar;
        if (take<std::int64_t>() != rows || take<std::int64_t>() != columns) fail();
        if (static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) >
            bytes_.size() / sizeof(Scalar)) {
            fail();
        }
        array.resize(rows, columns);
        copyTo(array.data(), static_cast<std::size_t>(array.size()) * sizeof(Scalar));
    }
    bool atEnd() const { return bytes_.empty(); }

  private:
    void copyTo(void* target, std::size_t count) {
        if (count > bytes_.size()) fail();
        std::memcpy(target, bytes_.data(), count);
        bytes_ = bytes_.subspan(count);
    }

    std::span<const char> bytes_;
    std::string name_;
};

void addClass(const PriorClass& c, Bytes& bytes) {
    bytes.add(static_cast<std::uint32_t>(c.materialClass));
    bytes.add(static_cast<std::uint32_t>(c.spectra.size()));
    bytes.add(std::int64_t{c.outputMean.size()});
    bytes.addArray(c.sampleMean);
    bytes.addArray(c.outputMean);
    bytes.addArray(c.cross);
    for (const PriorSpectrum& spectrum : c.spectra) {
        bytes.add(spectrum.sigma);
        bytes.add(spectrum.length);
        bytes.addArray(spectrum.eigenvalues);
        bytes.addArray(spectrum.eigenvectors);
    }
}

/// rows: of class iso, and of the others.
PriorClass takeClass(Reader& reader, Eigen::Index samples, Eigen::Index isoRows,
                     Eigen::Index otherRows) {
    PriorClass c;
    const auto materialClass = reader.take<std::uint32_t>();
    const auto spectra = reader.take<std::uint32_t>();
    const auto rows = reader.take<std::int64_t>();
    if (materialClass >= kMaterialClasses.size() || spectra < 1 || spectra > 1000) reader.fail();
    c.materialClass = kMaterialClasses[materialClass];
    if (rows != (c.materialClass == MaterialClass::kIso ? isoRows : otherRows)) reader.fail();
    reader.takeArray(c.sampleMean, samples, 1);
    reader.takeArray(c.outputMean, rows, 1);
    reader.takeArray(c.cross, rows, samples);
    for (std::uint32_t i = 0; i < spectra; ++i) {
        PriorSpectrum spectrum;
        spectrum.sigma = reader.take<double>();
        spectrum.length = reader.take<double>();
        reader.takeArray(spectrum.eigenvalues, samples, 1);
        reader.takeArray(spectrum.eigenvectors, samples, samples);
        c.spectra.push_back(std::move(spectrum));
    }
    return c;
}

}  // namespace

std::uint64_t modelKey(const std::vector<LightAndView>& samples,
                       const std::vector<LightAndView>& outputs, const TrainOptions& options) {
    Bytes bytes;
    bytes.add(kMagic);
    bytes.add(samples);
    bytes.add(outputs);
    bytes.add(std::uint64_t{settled(options, outputs.size()).materials});
    bytes.add(options.seed);
    return contentHash(bytes.text());
}

void writeModel(const std::filesystem::path& path, const PriorModel& model) {
    Bytes body;
    body.add(model.samples);
    body.add(model.outputs);
    body.add(model.scaleFactor);
    body.add(model.errorScale.isotropic);
    body.add(model.errorScale.other);
    body.add(static_cast<std::uint32_t>(model.classes.size()));
    for (const PriorClass& c : model.classes) addClass(c, body);
    Bytes head;
    head.add(kMagic);
    head.add(contentHash(body.text()));
    OutputFile file(path);
    file.write(head.text());
    file.write(body.text());
    file.commit();
}

PriorModel readModel(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    if (!stream) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    }
    ZeroedVector<char> bytes(static_cast<std::size_t>(stream.tellg()));
    stream.seekg(0);
    Reader reader(bytes, path.string());
    constexpr std::size_t kHead = sizeof kMagic + sizeof(std::uint64_t);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) ||
        bytes.size() < kHead) {
        reader.fail();
    }
    const auto magic = reader.take<std::array<char, sizeof kMagic>>();
    const auto hash = reader.take<std::uint64_t>();
    if (std::memcmp(magic.data(), kMagic, sizeof kMagic) != 0 ||
        hash != contentHash(std::span(bytes).subspan(kHead))) {
        reader.fail();
    }
    PriorModel model;
    model.samples = reader.takePairs();
    model.outputs = reader.takePairs();
    model.scaleFactor = reader.take<double>();
    model.errorScale.isotropic = reader.take<double>();
    model.errorScale.other = reader.take<double>();
    const auto classes = reader.take<std::uint32_t>();
    if (model.samples.empty() || model.outputs.empty() || classes < 1 || classes > 64)
        reader.fail();
    const auto isoRows = static_cast<Eigen::Index>(isotropicPairs(model.outputs).distinct.size());
    for (std::uint32_t i = 0; i < classes; ++i) {
        model.classes.push_back(takeClass(reader, static_cast<Eigen::Index>(model.samples.size()),
                                          isoRows,
                                          static_cast<Eigen::Index>(model.outputs.size())));
    }
    if (!reader.atEnd()) reader.fail();
    return model;
}

}  // namespace abrdf
