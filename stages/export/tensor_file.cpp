// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/tensor_file.h"

#include "abrdf/output_file.h"

namespace abrdf {

namespace {

constexpr std::uint8_t kUnsigned8 = 1;
constexpr std::uint8_t kFloat32 = 10;
constexpr std::uint64_t kAlignment = 8;  // Programs map the file and look at the floats in place.

std::uint64_t aligned(std::uint64_t offset) {
    return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

template <typename T>
void put(std::string& bytes, T number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

void TensorFile::add(const std::string& name, const std::vector<std::uint64_t>& sizes,
                     const std::vector<float>& values) {
    fields_.push_back(
        {name, kFloat32, sizes,
         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float))});
}

void TensorFile::add(const std::string& name, const std::string& bytes) {
    fields_.push_back({name, kUnsigned8, {bytes.size()}, bytes});
}

void TensorFile::write(const std::filesystem::path& path) const {
    std::string head("tensor_file\0\1\0", 14);
    put(head, static_cast<std::uint32_t>(fields_.size()));
    std::uint64_t offset = head.size();
    for (const Field& field : fields_) offset += 13 + field.name.size() + 8 * field.sizes.size();
    for (const Field& field : fields_) {
        put(head, static_cast<std::uint16_t>(field.name.size()));
        head += field.name;
        put(head, static_cast<std::uint16_t>(field.sizes.size()));
        put(head, field.type);
        offset = aligned(offset);
        put(head, offset);
        for (const std::uint64_t size : field.sizes) put(head, size);
        offset += field.data.size();
    }
    OutputFile file(path);
    file.write(head);
    std::uint64_t position = head.size();
    for (const Field& field : fields_) {
        file.write(std::string(aligned(position) - position, '\0'));
        file.write(field.data);
        position = aligned(position) + field.data.size();
    }
    file.commit();
}

}  // namespace abrdf
