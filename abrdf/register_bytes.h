// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace abrdf {

/// Bytes of the widest registers that the processor has and this program knows: 64 (AVX-512), 32
/// (AVX2) or 16. Loops are compiled for each and chosen at run time; they have the same bits.
int registerBytes();

/// Bounds registerBytes() while it lives, so that one machine can show that bits are the same. One
/// such object at a time, and no loop under way.
class RegisterLimit {
  public:
    explicit RegisterLimit(int bytes);
    ~RegisterLimit();
    RegisterLimit(const RegisterLimit&) = delete;
    RegisterLimit& operator=(const RegisterLimit&) = delete;
};

/// The one of three functions that is for these registers.
template <typename Function>
Function* forRegisters(Function* of64, Function* of32, Function* of16) {
    const int bytes = registerBytes();
    return bytes >= 64 ? of64 : bytes >= 32 ? of32 : of16;
}

}  // namespace abrdf
