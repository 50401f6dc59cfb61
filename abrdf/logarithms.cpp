// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/logarithms.h"

#include "abrdf/portable_math.h"
#include "abrdf/portable_vector.h"
#include "abrdf/register_bytes.h"

namespace abrdf {

namespace {

template <std::size_t kBytes>
[[gnu::always_inline]] inline void allLogs(float* values, std::size_t count) {
    using V = portable::Vector<kBytes>;
    std::size_t i = 0;
    for (; i + V::kCount <= count; i += V::kCount) log(V::at(values + i)).store(values + i);
    for (; i < count; ++i) values[i] = portable::log(values[i]);
}

// The same loops for the registers that a processor has.
[[gnu::target("avx512f")]] void logsAvx512(float* values, std::size_t count) {
    allLogs<64>(values, count);
}
[[gnu::target("avx2")]] void logsAvx2(float* values, std::size_t count) {
    allLogs<32>(values, count);
}
void logsPortable(float* values, std::size_t count) {
    allLogs<16>(values, count);
}

}  // namespace

void takeLogarithms(std::span<float> values) {
    forRegisters(logsAvx512, logsAvx2, logsPortable)(values.data(), values.size());
}

}  // namespace abrdf
