// SPDX-License-Identifier: BSD-3-Clause
//
// APPNOTE.TXT, "General Format of a .ZIP file": local headers with data, a directory, its end.
#include "tests/bad/zip_bytes.h"

#include "tests/support/small_files.h"

#include <zlib.h>

#include <stdexcept>

namespace abrdf {

namespace {

/// Deflate without zlib's header.
std::string deflated(const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) !=
        Z_OK) {
        throw std::runtime_error("zlib does not begin");
    }
    std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

/// What a local header and the directory both say.
void putFacts(ByteWriter& out, const ZipMember& member, const std::string& packed) {
    const auto size16 = [](std::size_t n) { return static_cast<std::uint16_t>(n); };
    const auto size32 = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    const std::uint16_t method =
        member.method != 0 ? member.method : static_cast<std::uint16_t>(member.deflate ? 8 : 0);
    out.put(std::uint16_t{20}).put(member.flags).put(method);
    out.put(std::uint16_t{0}).put(std::uint16_t{0x21});  // Midnight of 1 January 1980.
    out.put(member.claimedCrc.value_or(
        static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(member.bytes.data()),
                                         static_cast<uInt>(member.bytes.size())))));
    out.put(size32(packed.size()));
    out.put(member.claimedSize.value_or(size32(member.bytes.size())));
    out.put(size16(member.name.size())).put(std::uint16_t{0});
}

}  // namespace

std::string zipBytes(const std::vector<ZipMember>& members) {
    ByteWriter out;
    ByteWriter directory;
    for (const ZipMember& member : members) {
        const auto offset = static_cast<std::uint32_t>(out.bytes().size());
        const std::string packed = member.deflate ? deflated(member.bytes) : member.bytes;
        out.text("PK\3\4");
        putFacts(out, member, packed);
        out.text(member.name).text(packed);
        directory.text("PK\1\2").put(std::uint16_t{20});
        putFacts(directory, member, packed);
        directory.put(std::uint16_t{0}).put(std::uint16_t{0}).put(std::uint16_t{0});
        directory.put(std::uint32_t{0}).put(offset).text(member.name);
    }
    const auto count = static_cast<std::uint16_t>(members.size());
    const auto begin = static_cast<std::uint32_t>(out.bytes().size());
    const auto size = static_cast<std::uint32_t>(directory.bytes().size());
    out.text(directory.bytes()).text("PK\5\6").put(std::uint32_t{0});
    out.put(count).put(count).put(size).put(begin).put(std::uint16_t{0});
    return out.bytes();
}

}  // namespace abrdf
