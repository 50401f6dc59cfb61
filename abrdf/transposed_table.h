// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/scratch_file.h"
#include "abrdf/zeroed_vector.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// The transposition of the pipeline: a table of items that comes in by rows (images) and is wanted
/// by columns (texels), in memory or, where that is too large, in one scratch file. Columns are
/// gathered in bands; of a band the items of all rows stand together, row after row, so that a row
/// is written in as many pieces as there are bands, and a band is read in one.
class TransposedTable {
  public:
    /// bandBegins: first column of each band, ascending from 0, then the number of columns.
    /// scratch: folder of the scratch file; nothing: in memory.
    TransposedTable(std::size_t rows, std::size_t itemBytes, std::vector<std::size_t> bandBegins,
                    const std::optional<std::filesystem::path>& scratch);

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return bandBegins_.back(); }
    std::size_t bands() const { return bandBegins_.size() - 1; }
    std::size_t bandBegin(std::size_t band) const { return bandBegins_[band]; }
    std::uint64_t bytes() const { return std::uint64_t{rows_} * columns() * itemBytes_; }

    /// Whole rows from firstRow on, row after row; from any thread, different rows at once.
    void store(std::size_t firstRow, std::span<const char> items);

    /// All rows of a band's columns, row after row; valid as long as the table and, where that is
    /// in a file, `buffer`.
    std::span<const char> band(std::size_t band, std::vector<char>& buffer) const;

  private:
    std::uint64_t position(std::size_t band, std::size_t row) const;

    std::size_t rows_;
    std::size_t itemBytes_;
    std::vector<std::size_t> bandBegins_;
    std::optional<ScratchFile> file_;
    ZeroedVector<char> memory_;
};

}  // namespace abrdf
