// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// A file of named arrays, as EPFL's Realistic Graphics Lab stores materials: "tensor_file\0",
/// version 1.0, a table of the fields, then their values, little-endian.
class TensorFile {
  public:
    void add(const std::string& name, const std::vector<std::uint64_t>& sizes,
             const std::vector<float>& values);
    void add(const std::string& name, const std::string& bytes);

    /// Throws std::runtime_error, naming the file, where it cannot be written.
    void write(const std::filesystem::path& path) const;

  private:
    struct Field {
        std::string name;
        std::uint8_t type;
        std::vector<std::uint64_t> sizes;
        std::string data;
    };
    std::vector<Field> fields_;
};

}  // namespace abrdf
