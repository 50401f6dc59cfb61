// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/tile_journal.h"

#include "abrdf/content_hash.h"
#include "abrdf/output_file.h"
#include "pipeline/json_text.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

fs::path journalBeside(const fs::path& output) {
    return output.parent_path() / fmt::format(".{}.abrdf-journal", output.filename().string());
}

constexpr std::size_t kDigits = 8;  // Of a float's bits, hexadecimal.

/// To the bit, NaN as well.
std::string textOf(std::span<const float> estimates) {
    std::string text;
    for (const float value : estimates) {
        text += fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value));
    }
    return text;
}

/// The inverse; nothing where it is cut.
std::optional<std::vector<float>> estimatesFrom(const std::string& text) {
    if (text.size() % kDigits != 0) return {};
    std::vector<float> estimates;
    for (std::size_t i = 0; i < text.size(); i += kDigits) {
        std::uint32_t bits = 0;
        const char* end = text.data() + i + kDigits;
        const auto [rest, error] = std::from_chars(text.data() + i, end, bits, 16);
        if (error != std::errc() || rest != end) return {};
        estimates.push_back(std::bit_cast<float>(bits));
    }
    return estimates;
}

/// One line: tiles, their end, hash, counts, and the estimates where there are some. Nothing where
/// it is cut.
std::optional<TilesAdded> entryOf(const std::string& line) {
    std::istringstream stream(line);
    TilesAdded added;
    std::string end;
    stream >> added.written.tiles >> added.written.end >> added.hash >> added.counts.clamped >>
        added.counts.nonfinite >> added.counts.dimmed >> end;
    if (stream && end != "whole") {
        auto estimates = estimatesFrom(end);
        if (!estimates) return {};
        added.estimates = std::move(*estimates);
        stream >> end;
    }
    if (!stream || end != "whole") return {};
    return added;
}

/// Confirms the estimates too, which the atlas's bytes do not have yet.
std::uint64_t withEstimates(std::uint64_t hash, std::span<const float> estimates) {
    if (estimates.empty()) return hash;
    return contentHash({reinterpret_cast<const char*>(estimates.data()), estimates.size_bytes()},
                       hash);
}

/// The hash of bytes [begin, end) of a file of `size` bytes; nothing where it is shorter.
std::optional<std::uint64_t> hashOf(std::ifstream& file, std::uint64_t size, std::uint64_t begin,
                                    std::uint64_t end, std::vector<char>& buffer) {
    if (end < begin || end > size) return {};
    buffer.resize(end - begin);
    file.seekg(static_cast<std::streamoff>(begin));
    if (!file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()))) return {};
    return contentHash(buffer);
}

}  // namespace

std::string differences(const ordered_json& was, const ordered_json& is) {
    std::string text;
    const auto add = [&](const std::string& key, const std::string& change) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, change);
    };
    for (const auto& [key, value] : is.items()) {
        if (!was.contains(key)) {
            add(key, fmt::format("is {} and was not there", value.dump()));
        } else if (was[key] != value) {
            add(key, fmt::format("was {} and is {}", was[key].dump(), value.dump()));
        }
    }
    for (const auto& [key, value] : was.items()) {
        if (!is.contains(key)) add(key, fmt::format("was {} and is gone", value.dump()));
    }
    return text;
}

TileJournal::TileJournal(const fs::path& output, const ordered_json& job, PixelType type,
                         bool resume)
    : output_(output),
      path_(journalBeside(output)),
      lock_(path_),
      job_(ordered_json::parse(jsonText(job))),
      type_(type) {
    if (!lock_.isHeld()) {
        throw std::runtime_error(fmt::format(
            "{}: another abrdf is writing it; wait for that one or choose another output",
            output.string()));
    }
    if (!resume || !readBack()) begin();
    stream_.open(path_, std::ios::binary | std::ios::app);
}

/// False where there is nothing to continue.
bool TileJournal::readBack() {
    std::ifstream journal(path_, std::ios::binary);
    std::string line;
    if (!std::getline(journal, line)) return false;
    const ordered_json head = ordered_json::parse(line, nullptr, false);
    if (!head.is_object() || !head.contains("job") || !head.contains("pixel")) {
        return false;
    }
    const std::string changed = differences(head["job"], job_);
    if (!changed.empty()) {
        throw std::runtime_error(fmt::format(
            "{}: cannot be resumed, as its unfinished part is of another job: {}; give that job "
            "again, or leave --resume out to begin anew",
            output_.string(), changed));
    }
    type_ = head["pixel"] == "float" ? PixelType::kFloat : PixelType::kHalf;
    std::ifstream atlas(partialBeside(output_), std::ios::binary);
    std::error_code absent;
    const std::uintmax_t found = fs::file_size(partialBeside(output_), absent);
    const std::uint64_t size = absent ? 0 : found;
    std::vector<char> buffer;
    auto good = journal.tellg();
    while (std::getline(journal, line) && !journal.eof()) {
        const auto entry = entryOf(line);
        if (!entry) break;
        // The first one says where tiles begin.
        if (entry->written.tiles > 0) {
            const auto hash = hashOf(atlas, size, written_.end, entry->written.end, buffer);
            if (!hash || withEstimates(*hash, entry->estimates) != entry->hash) break;
        }
        good = journal.tellg();
        written_ = entry->written;
        counts_ += entry->counts;
        estimates_.insert(estimates_.end(), entry->estimates.begin(), entry->estimates.end());
    }
    if (written_.tiles > 0) fs::resize_file(path_, static_cast<std::uintmax_t>(good));
    return written_.tiles > 0;
}

void TileJournal::begin() {
    written_ = {};
    counts_ = {};
    estimates_ = {};
    std::ofstream stream(path_, std::ios::binary | std::ios::trunc);
    stream << jsonText({{"job", job_}, {"pixel", nameOf(type_)}}) << "\n";
    if (!stream.flush()) {
        const int error = errno;
        remove();  // It tells of nothing yet.
        fail(error);
    }
}

void TileJournal::fail(int error) const {
    throw std::runtime_error(fmt::format("{}: its journal {}", output_.string(),
                                         systemFault("cannot be written", error)));
}

void TileJournal::restart(PixelType type) {
    type_ = type;
    begin();
}

void TileJournal::add(const TilesAdded& added) {
    stream_ << added.written.tiles << ' ' << added.written.end << ' '
            << withEstimates(added.hash, added.estimates) << ' ' << added.counts.clamped << ' '
            << added.counts.nonfinite << ' ' << added.counts.dimmed << ' '
            << textOf(added.estimates) << (added.estimates.empty() ? "" : " ") << "whole\n";
    if (!stream_.flush()) fail(errno);
}

void TileJournal::remove() {
    std::error_code ignored;
    fs::remove(partialBeside(output_), ignored);
    fs::remove(path_, ignored);
}

void TileJournal::removeFinished(const fs::path& output) {
    const fs::path path = journalBeside(output);
    if (!fs::exists(path)) return;
    const LockFile lock(path);
    std::error_code ignored;
    if (lock.isHeld()) fs::remove(path, ignored);
}

}  // namespace abrdf
