// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/transposed_table.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/lock_file.h"
#include "abrdf/tile_order.h"

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <numeric>

using namespace abrdf;

namespace {

using Item = std::uint32_t;

Item itemOf(std::size_t row, std::size_t column) {
    return static_cast<Item>(1000 * row + column);
}

/// Every item is at its place of its band, for rows that come from many threads, singly or not.
void checkTable(const std::optional<std::filesystem::path>& scratch, std::size_t rowsAtOnce) {
    constexpr std::size_t kRows = 12;
    constexpr std::size_t kColumns = 23;
    TransposedTable table(kRows, sizeof(Item), {0, 1, 8, 9, kColumns}, scratch);
    CHECK(table.bytes() == kRows * kColumns * sizeof(Item));
    forEachTexelBlock(kRows, rowsAtOnce, [&](std::size_t begin, std::size_t end) {
        std::vector<Item> rows;
        for (std::size_t row = begin; row < end; ++row) {
            for (std::size_t c = 0; c < kColumns; ++c) rows.push_back(itemOf(row, c));
        }
        table.store(begin,
                    {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Item)});
    });
    std::vector<char> buffer;
    for (std::size_t b = 0; b < table.bands(); ++b) {
        const auto band = table.band(b, buffer);
        const std::size_t first = table.bandBegin(b);
        const std::size_t width = table.bandBegin(b + 1) - first;
        REQUIRE(band.size() == kRows * width * sizeof(Item));
        for (std::size_t i = 0; i < kRows * width; ++i) {
            Item item = 0;
            std::memcpy(&item, band.data() + i * sizeof item, sizeof item);
            CHECK(item == itemOf(i / width, first + i % width));
        }
    }
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("rows come out as columns, in memory and through a scratch file that leaves no name") {
    const auto folder = std::filesystem::temp_directory_path();
    for (const std::size_t rowsAtOnce : {1U, 5U}) {
        checkTable({}, rowsAtOnce);
        checkTable(folder, rowsAtOnce);
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        CHECK_FALSE(entry.path().filename().string().starts_with(".abrdf-scratch"));
    }
}

TEST_CASE("a scratch file that its disk cannot hold is refused at once, with a way out") {
    try {
        const ScratchFile file(std::filesystem::temp_directory_path(), std::uint64_t{1} << 60);
        FAIL("an exabyte was promised");
    } catch (const std::runtime_error& error) {
        CHECK(std::string(error.what()).find("--memory") != std::string::npos);
    }
    CHECK_THROWS_AS(ScratchFile("/no/such/folder", 1), std::runtime_error);
}

TEST_CASE("tiles hold each cell once, in the order that reorder() puts them") {
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {12, 4}, {3, 40}}) {
        const TileOrder order(width, height, 4, 3);
        std::vector<int> rows(order.cells());
        std::iota(rows.begin(), rows.end(), 0);
        std::vector<int> ordered(rows.size(), -1);
        order.reorder<int>(rows, ordered);
        std::size_t place = 0;
        for (std::size_t i = 0; i < order.tiles(); ++i) {
            const TileOrder::Tile tile = order.tile(i);
            CHECK(order.firstCell(i) == place);
            for (std::size_t c = 0; c < tile.cells(); ++c) {
                const auto x = tile.x + static_cast<int>(c) % tile.width;
                const auto y = tile.y + static_cast<int>(c) / tile.width;
                CHECK(ordered[place++] == y * width + x);
            }
        }
        CHECK(order.firstCell(order.tiles()) == order.cells());
        CHECK(order.isRowOrder() == (ordered == rows));
    }
}

TEST_CASE("a lock is one process's, and goes with its holder") {
    const auto path = std::filesystem::temp_directory_path() / "abrdf-lock-test";
    {
        const LockFile first(path);
        CHECK(first.isHeld());
        const LockFile second(path);
        CHECK_FALSE(second.isHeld());
    }
    CHECK(LockFile(path).isHeld());
    std::filesystem::remove(path);
}

TEST_SUITE_END();
