// SPDX-License-Identifier: BSD-3-Clause
//
// libFuzzer's entry; ABRDF_FUZZ_TARGET says what this program is for.
#include "tests/fuzz/targets.h"

#include <OpenImageIO/imageio.h>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    OIIO::attribute("threads", 1);  // As the program does.
    OIIO::attribute("exr_threads", -1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const abrdf::FuzzTarget kTarget = abrdf::fuzzTargetFromName(ABRDF_FUZZ_TARGET);
    kTarget.run({reinterpret_cast<const char*>(data), size});
    return 0;
}
