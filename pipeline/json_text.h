// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace abrdf {

/// The text of a report or a job. Bytes of files' names that are no UTF-8 come out as U+FFFD.
/// indent: spaces a level; below 0: one line.
inline std::string jsonText(const nlohmann::ordered_json& json, int indent = -1) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace abrdf
