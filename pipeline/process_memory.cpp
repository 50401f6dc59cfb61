// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/process_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace abrdf {

std::uint64_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t residentMemory() {
    std::ifstream stream("/proc/self/statm");
    std::uint64_t pages = 0;
    stream >> pages >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace abrdf
