// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace abrdf {

#if !defined(__has_feature)
#define __has_feature(x) 0
#endif

/// Sanitizers take terabytes of addresses, and a multiple of the memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace abrdf
