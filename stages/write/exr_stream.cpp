// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/exr_stream.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr std::size_t kMaxHead = std::size_t{1} << 20;

}  // namespace

ExrStream::ExrStream(const std::filesystem::path& path) : Imf::OStream(path.c_str()), file_(path) {}

void ExrStream::write(const char bytes[], int count) {
    const std::uint64_t position = file_.position();
    const std::span<const char> data(bytes, static_cast<std::size_t>(count));
    if (position == head_.size() && position < kMaxHead) head_.append(data.data(), data.size());
    file_.write(data);
    end_ = std::max(end_, position + data.size());
}

void ExrStream::patchInt(std::string_view attribute, int value) {
    // An attribute is: name \0 type \0 size(4) value.
    const std::string key =
        std::string(attribute) + '\0' + "int" + '\0' + '\4' + '\0' + '\0' + '\0';
    const std::size_t found = head_.find(key);
    if (found == std::string::npos) {
        throw std::logic_error("the EXR header lacks the attribute " + std::string(attribute));
    }
    const auto bits = static_cast<std::uint32_t>(value);
    const std::array<char, 4> bytes = {static_cast<char>(bits), static_cast<char>(bits >> 8),
                                       static_cast<char>(bits >> 16),
                                       static_cast<char>(bits >> 24)};
    file_.seek(found + key.size());
    file_.write(bytes);
}

std::uint64_t ExrStream::commit() {
    file_.commit();
    return end_;
}

}  // namespace abrdf
