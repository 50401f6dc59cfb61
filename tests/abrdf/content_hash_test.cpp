// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/content_hash.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("every bit, the length and the seed change the hash") {
    std::set<std::uint64_t> hashes;
    std::size_t tried = 0;
    for (const std::size_t length : {0U, 1U, 7U, 8U, 31U, 32U, 33U, 100U}) {
        const std::string text(length, 'a');
        hashes.insert(contentHash(text));
        hashes.insert(contentHash(text, 1));
        tried += 2;
        for (std::size_t bit = 0; bit < 8 * length; ++bit) {
            std::string changed = text;
            changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
            hashes.insert(contentHash(changed));
            ++tried;
        }
    }
    CHECK(hashes.size() == tried);
    CHECK(contentHash(std::string("abrdf")) == contentHash(std::string("abrdf")));
}

TEST_SUITE_END();
