// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace abrdf {

/// Memory that the system hands out as zeros, so that no thread has to write them first: pages
/// come into being where and when a thread touches them.
template <typename T>
struct ZeroedAllocator {
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;

    ZeroedAllocator() = default;
    template <typename U>
    explicit ZeroedAllocator(const ZeroedAllocator<U>&) {}

    T* allocate(std::size_t count) {
        void* memory = std::calloc(count, sizeof(T));
        if (memory == nullptr && count > 0) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { std::free(memory); }

    /// Zeros are what the memory holds already.
    template <typename U>
    void construct(U*) const {}
    template <typename U, typename... Arguments>
    void construct(U* place, Arguments&&... arguments) const {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }

    bool operator==(const ZeroedAllocator&) const { return true; }
};

/// A vector made once at its size, every value zero. It is not to be resized: what it would hand
/// out again is not zeroed again.
template <typename T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

}  // namespace abrdf
