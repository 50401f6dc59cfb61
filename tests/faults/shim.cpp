// SPDX-License-Identifier: BSD-3-Clause
//
// Preloaded into a job (LD_PRELOAD), makes one of its calls fail as disks do, or kills it there:
//   ABRDF_FAULT=CALL:NUMBER:ACTION[:PATTERN]
// CALL: open read write rename unlink fsync mmap; the NUMBER-th of them (from 1) on a file whose
// path holds PATTERN. ACTION: eio enospc eacces (the call fails so), kill and killafter (SIGKILL
// before and after it), cut and remove (the file is cut to nothing or removed before it; mmap:
// after it).
//   ABRDF_MORE_MEMORY=BYTES
// bounds the address space (RLIMIT_AS) to so much more than the libraries take, as main() begins.
//   ABRDF_NEWS=NUMBER
// so many calls of operator new from main() on get memory, and none after them.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <string>

namespace {

struct Fault {
    std::string call;
    long number = 0;
    std::string action;
    std::string pattern;
};

const Fault& fault() {
    static const Fault* const fault = [] {
        auto* result = new Fault;  // Never destroyed: calls go on after main().
        const char* text = std::getenv("ABRDF_FAULT");
        if (text == nullptr) return result;
        std::string words[4];
        std::size_t word = 0;
        for (const char* c = text; *c != '\0'; ++c) {
            if (*c == ':' && word < 3) {
                ++word;
            } else {
                words[word] += *c;
            }
        }
        *result = {words[0], std::atol(words[1].c_str()), words[2], words[3]};
        return result;
    }();
    return *fault;
}

std::atomic<long> gCalls = 0;

/// Empty where no fault is meant: a name takes memory.
std::string pathOf(int file) {
    if (fault().call.empty()) return {};
    const int error = errno;
    char path[4096];
    const std::string link = "/proc/self/fd/" + std::to_string(file);
    const ssize_t size = readlink(link.c_str(), path, sizeof path);
    errno = error;
    return size > 0 ? std::string(path, static_cast<std::size_t>(size)) : std::string();
}

/// Whether this is the call that is meant.
bool isMeant(const char* call, const std::string& path) {
    if (fault().call != call || path.find(fault().pattern) == std::string::npos) return false;
    return ++gCalls == fault().number;
}

/// The errno with which the meant call fails; 0 where it goes on.
int before(const std::string& path) {
    const std::string& action = fault().action;
    if (action == "kill") raise(SIGKILL);
    if (action == "cut" && truncate(path.c_str(), 0) != 0) abort();
    if (action == "remove" && std::remove(path.c_str()) != 0) abort();
    if (action == "eio") return EIO;
    if (action == "enospc") return ENOSPC;
    if (action == "eacces") return EACCES;
    return 0;
}

void after() {
    if (fault().action == "killafter") raise(SIGKILL);
}

constexpr long kEndless = std::numeric_limits<long>::max();
std::atomic<long> gNewsLeft = kEndless;

bool isMemoryLeft() {
    return gNewsLeft.load(std::memory_order_relaxed) == kEndless || --gNewsLeft >= 0;
}

template <typename Function>
Function real(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// real(arguments...), or its failure.
template <typename Result, typename Call>
Result through(const char* kind, const std::string& path, Result failure, const Call& call) {
    if (!isMeant(kind, path)) return call();
    const int error = before(path);
    if (error != 0) {
        errno = error;
        return failure;
    }
    const Result result = call();
    after();
    return result;
}

}  // namespace

// Each stands for libc's own function of its name.
#define STANDS_FOR(name) static const auto next = real<decltype(&name)>(#name)

extern "C" {

int __libc_start_main(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(),
                      void*);

ssize_t read(int file, void* bytes, size_t count) {
    STANDS_FOR(read);
    return through<ssize_t>("read", pathOf(file), -1, [&] { return next(file, bytes, count); });
}
ssize_t pread(int file, void* bytes, size_t count, off_t place) {
    STANDS_FOR(pread);
    return through<ssize_t>("read", pathOf(file), -1,
                            [&] { return next(file, bytes, count, place); });
}
ssize_t pread64(int file, void* bytes, size_t count, off64_t place) {
    STANDS_FOR(pread64);
    return through<ssize_t>("read", pathOf(file), -1,
                            [&] { return next(file, bytes, count, place); });
}
size_t fread(void* bytes, size_t size, size_t count, FILE* file) {
    STANDS_FOR(fread);
    return through<size_t>("read", pathOf(fileno(file)), 0,
                           [&] { return next(bytes, size, count, file); });
}
ssize_t write(int file, const void* bytes, size_t count) {
    STANDS_FOR(write);
    return through<ssize_t>("write", pathOf(file), -1, [&] { return next(file, bytes, count); });
}
ssize_t writev(int file, const iovec* pieces, int count) {
    STANDS_FOR(writev);
    return through<ssize_t>("write", pathOf(file), -1, [&] { return next(file, pieces, count); });
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t place) {
    STANDS_FOR(pwrite);
    return through<ssize_t>("write", pathOf(file), -1,
                            [&] { return next(file, bytes, count, place); });
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t place) {
    STANDS_FOR(pwrite64);
    return through<ssize_t>("write", pathOf(file), -1,
                            [&] { return next(file, bytes, count, place); });
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
    STANDS_FOR(fwrite);
    return through<size_t>("write", pathOf(fileno(file)), 0,
                           [&] { return next(bytes, size, count, file); });
}
int fsync(int file) {
    STANDS_FOR(fsync);
    return through<int>("fsync", pathOf(file), -1, [&] { return next(file); });
}
int rename(const char* from, const char* to) noexcept {
    STANDS_FOR(rename);
    return through<int>("rename", to, -1, [&] { return next(from, to); });
}
int unlink(const char* path) noexcept {
    STANDS_FOR(unlink);
    return through<int>("unlink", path, -1, [&] { return next(path); });
}
int remove(const char* path) noexcept {
    STANDS_FOR(remove);
    return through<int>("unlink", path, -1, [&] { return next(path); });
}
int unlinkat(int folder, const char* path, int flags) noexcept {
    STANDS_FOR(unlinkat);
    return through<int>("unlink", path, -1, [&] { return next(folder, path, flags); });
}
FILE* fopen(const char* path, const char* mode) {
    STANDS_FOR(fopen);
    return through<FILE*>("open", path, nullptr, [&] { return next(path, mode); });
}
FILE* fopen64(const char* path, const char* mode) {
    STANDS_FOR(fopen64);
    return through<FILE*>("open", path, nullptr, [&] { return next(path, mode); });
}
void* mmap(void* place, size_t size, int protection, int flags, int file, off_t offset) noexcept {
    STANDS_FOR(mmap);
    void* const result = next(place, size, protection, flags, file, offset);
    if (file >= 0) {
        const std::string path = pathOf(file);
        if (isMeant("mmap", path)) before(path);
    }
    return result;
}

using Main = int (*)(int, char**, char**);

Main programsMain = nullptr;

void boundAddresses(long more) {
    long pages = 0;
    if (FILE* sizes = std::fopen("/proc/self/statm", "r"); sizes != nullptr) {
        if (std::fscanf(sizes, "%ld", &pages) != 1) abort();
        std::fclose(sizes);
    }
    const auto bytes = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + more);
    const rlimit bound{bytes, bytes};
    setrlimit(RLIMIT_AS, &bound);
}

int boundMain(int argc, char** argv, char** environment) {
    if (const char* more = std::getenv("ABRDF_MORE_MEMORY"); more != nullptr) {
        boundAddresses(std::atol(more));
    }
    if (const char* news = std::getenv("ABRDF_NEWS"); news != nullptr) gNewsLeft = std::atol(news);
    return programsMain(argc, argv, environment);
}

// What the libraries do before main(), as CLI11 that makes its validators there, is theirs.
int __libc_start_main(Main main, int argc, char** argv, void (*first)(), void (*last)(),
                      void (*linkerLast)(), void* stackEnd) {
    STANDS_FOR(__libc_start_main);
    programsMain = main;
    return next(boundMain, argc, argv, first, last, linkerLast, stackEnd);
}

}  // extern "C"

void* operator new(std::size_t size) {
    void* const place = isMemoryLeft() ? std::malloc(size) : nullptr;
    if (place == nullptr) throw std::bad_alloc();
    return place;
}

void* operator new(std::size_t size, std::align_val_t alignment) {
    void* place = nullptr;
    if (!isMemoryLeft() || posix_memalign(&place, static_cast<std::size_t>(alignment), size) != 0) {
        throw std::bad_alloc();
    }
    return place;
}

void operator delete(void* place) noexcept {
    std::free(place);
}
void operator delete(void* place, std::size_t) noexcept {
    std::free(place);
}
void operator delete(void* place, std::align_val_t) noexcept {
    std::free(place);
}
void operator delete(void* place, std::size_t, std::align_val_t) noexcept {
    std::free(place);
}
