// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace abrdf {

/// What a call throws; empty where it passes.
template <typename Fault = std::runtime_error, typename Call>
std::string faultOf(const Call& call) {
    try {
        call();
        return {};
    } catch (const Fault& error) {
        return error.what();
    }
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace abrdf
