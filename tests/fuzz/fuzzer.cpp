// SPDX-License-Identifier: BSD-3-Clause
//
// libFuzzer's entry. ABRDF_FUZZ_TARGET in the environment says which target it is for: one program
// for all of them is linked once.
#include "tests/fuzz/targets.h"

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <iostream>

namespace {

const abrdf::FuzzTarget& chosenTarget() {
    static const abrdf::FuzzTarget kTarget = [] {
        const char* name = std::getenv("ABRDF_FUZZ_TARGET");
        try {
            return abrdf::fuzzTargetFromName(name == nullptr ? "" : name);
        } catch (const std::exception& error) {
            std::cerr << error.what() << "; set ABRDF_FUZZ_TARGET to one of them" << std::endl;
            std::exit(2);
        }
    }();
    return kTarget;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    OIIO::attribute("threads", 1);  // As the program does.
    OIIO::attribute("exr_threads", -1);
    chosenTarget();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    chosenTarget().run({reinterpret_cast<const char*>(data), size});
    return 0;
}
