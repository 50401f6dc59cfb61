// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/printable.h"

#include <fmt/format.h>

namespace abrdf {

std::string printable(std::string_view message) {
    std::string text;
    for (std::size_t i = 0; i < message.size(); ++i) {
        const auto byte = static_cast<unsigned char>(message[i]);
        // U+0080 .. U+009F steer some terminals as well.
        const bool isLateControl = byte == 0xc2 && i + 1 < message.size() &&
                                   static_cast<unsigned char>(message[i + 1]) < 0xa0;
        if (byte == '\n') {
            text += "\\n";
        } else if (byte < 0x20 || byte == 0x7f || isLateControl) {
            text += fmt::format("\\x{:02x}", byte);
        } else {
            text += message[i];
        }
    }
    return text;
}

}  // namespace abrdf
