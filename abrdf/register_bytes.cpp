// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/register_bytes.h"

#include <algorithm>
#include <atomic>

namespace abrdf {

namespace {

constexpr int kWidest = 64;
std::atomic<int> gLimit = kWidest;

int bytesOfProcessor() {
    if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
        __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512dq") != 0) {
        return kWidest;
    }
    return __builtin_cpu_supports("avx2") != 0 ? 32 : 16;
}

}  // namespace

int registerBytes() {
    static const int kBytes = bytesOfProcessor();
    return std::min(kBytes, gLimit.load(std::memory_order_relaxed));
}

RegisterLimit::RegisterLimit(int bytes) {
    gLimit = bytes;
}

RegisterLimit::~RegisterLimit() {
    gLimit = kWidest;
}

}  // namespace abrdf
