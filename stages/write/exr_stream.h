// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/output_file.h"

#include <ImfIO.h>

#include <string>
#include <string_view>

namespace abrdf {

/// OpenEXR's output through OutputFile, so that a full disk is an error and no half file stays.
class ExrStream : public Imf::OStream {
  public:
    explicit ExrStream(const std::filesystem::path& path);

    void write(const char bytes[], int count) override;
    std::uint64_t tellp() override { return file_.position(); }
    void seekp(std::uint64_t position) override { file_.seek(position); }

    /// Overwrites the 4 bytes of an int attribute in the header: EXR headers come first, but
    /// counts are known last. The attribute must be there.
    void patchInt(std::string_view attribute, int value);

    /// Puts the file in place; returns its size.
    std::uint64_t commit();

  private:
    OutputFile file_;
    std::string head_;  ///< The file's first bytes: the header and a little more.
    std::uint64_t end_ = 0;
};

}  // namespace abrdf
