// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/transposed_table.h"

#include <algorithm>
#include <cassert>

namespace abrdf {

TransposedTable::TransposedTable(std::size_t rows, std::size_t itemBytes,
                                 std::vector<std::size_t> bandBegins,
                                 const std::optional<std::filesystem::path>& scratch)
    : rows_(rows), itemBytes_(itemBytes), bandBegins_(std::move(bandBegins)) {
    if (scratch) {
        file_.emplace(*scratch, bytes());
    } else {
        memory_ = ZeroedVector<char>(bytes());
    }
}

std::uint64_t TransposedTable::position(std::size_t band, std::size_t row) const {
    const std::size_t width = bandBegins_[band + 1] - bandBegins_[band];
    return (std::uint64_t{rows_} * bandBegins_[band] + std::uint64_t{row} * width) * itemBytes_;
}

void TransposedTable::store(std::size_t firstRow, std::span<const char> items) {
    const std::size_t rowBytes = columns() * itemBytes_;
    const std::size_t count = items.size() / rowBytes;
    assert(items.size() % rowBytes == 0 && firstRow + count <= rows_);
    thread_local std::vector<char> gathered;
    for (std::size_t b = 0; b < bands(); ++b) {
        const std::size_t begin = bandBegins_[b] * itemBytes_;
        const std::size_t width = bandBegins_[b + 1] * itemBytes_ - begin;
        std::uint64_t place = position(b, firstRow);
        if (!file_) {
            for (std::size_t row = 0; row < count; ++row, place += width) {
                std::ranges::copy(items.subspan(row * rowBytes + begin, width),
                                  memory_.begin() + static_cast<std::ptrdiff_t>(place));
            }
        } else if (count == 1) {
            file_->write(place, items.subspan(begin, width));
        } else {
            gathered.clear();
            for (std::size_t row = 0; row < count; ++row) {
                const auto piece = items.subspan(row * rowBytes + begin, width);
                gathered.insert(gathered.end(), piece.begin(), piece.end());
            }
            file_->write(place, gathered);
        }
    }
}

std::span<const char> TransposedTable::band(std::size_t band, std::vector<char>& buffer) const {
    const std::uint64_t begin = position(band, 0);
    const std::uint64_t size = position(band, rows_) - begin;
    if (!file_) return std::span(memory_).subspan(begin, size);
    buffer.resize(size);
    file_->read(begin, buffer);
    return buffer;
}

}  // namespace abrdf
