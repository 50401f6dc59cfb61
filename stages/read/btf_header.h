// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "stages/read/byte_cursor.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace abrdf {

/// The kinds of the University of Bonn's .btf container.
enum class BtfKind {
    kDfmf,  ///< Colours decorrelated, one factorisation a channel.
    kFmf,   ///< One factorisation of all channels.
    kPvf,   ///< One principal component analysis a view.
    kBdi,   ///< The full table.
};

/// What stands before the data of every kind.
struct BtfHeader {
    BtfKind kind = BtfKind::kDfmf;
    bool hasRotations = false;  ///< By the signature; where they stand differs.
    bool hasVersionByte = false;
    bool cosineIsIn = false;
    std::vector<std::string> channels;
    std::vector<Direction> views;   ///< As stored: theta may lie past the horizon.
    std::vector<Direction> lights;  ///< The first view's list, which all views must repeat in size.
};

/// True where a file begins as a .btf of any kind does, known or not.
bool beginsAsBtf(std::string_view head);

/// Signature, metadata and directions; the cursor then stands behind them. Throws
/// std::runtime_error that names the file.
BtfHeader readBtfHeader(ByteCursor& file);

/// Passes over the rotations of local frames, which decoding does not use.
void skipBtfRotations(ByteCursor& file);

}  // namespace abrdf
