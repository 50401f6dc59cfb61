// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/table_reader.h"

namespace abrdf {

namespace {

class TableReader : public BtfReader {
  public:
    TableReader(const DatabasePath& path, BtfDescription description,
                std::unique_ptr<const BrdfTable> table)
        : file_(path.path.string()),
          bytes_(path.size),
          description_(std::move(description)),
          table_(std::move(table)) {
        description_.width = 1;
        description_.height = 1;
        description_.present.assign(description_.grid.pairCount(), 1);
    }

    const BtfDescription& description() const override { return description_; }

    EncodedImage read(std::size_t pair) const override {
        const Rgb value = table_->evaluate(description_.grid.pair(pair));
        return {1, 1, std::vector<float>{value.r, value.g, value.b}};
    }

    std::string fileOf(std::size_t) const override { return file_; }
    std::uint64_t bytesOf(std::size_t) const override { return bytes_; }
    const BrdfTable* table() const override { return table_.get(); }

  private:
    std::string file_;
    std::uint64_t bytes_;
    BtfDescription description_;
    std::unique_ptr<const BrdfTable> table_;
};

}  // namespace

BtfDescription tableDescription(const DatabasePath& path, const char* format) {
    BtfDescription description;
    description.format = format;
    description.source = path.name();
    description.grid = AngularGrid(ubo81Directions());
    description.colorSpace = "Linear Rec.709 (sRGB)";
    description.cosine = Cosine::kKept;
    description.cosineFrom = "convention of the format: a BRDF without it, multiplied in reading";
    description.maxMeasuredTheta = kPi / 2;
    return description;
}

std::unique_ptr<BtfReader> makeTableReader(const DatabasePath& path, BtfDescription description,
                                           std::unique_ptr<const BrdfTable> table) {
    return std::make_unique<TableReader>(path, std::move(description), std::move(table));
}

}  // namespace abrdf
