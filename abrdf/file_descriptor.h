// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <utility>

namespace abrdf {

/// A file that the system holds open under a number, closed with the object.
class FileDescriptor {
  public:
    FileDescriptor() = default;
    /// Owns what open(2) and its like returned; below 0: none.
    explicit FileDescriptor(int number) : number_(number) {}
    FileDescriptor(FileDescriptor&& other) noexcept : number_(other.release()) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~FileDescriptor() {
        if (isOpen()) close(number_);
    }

    bool isOpen() const { return number_ >= 0; }
    int number() const { return number_; }
    /// Another owner's from now on.
    int release() { return std::exchange(number_, -1); }

  private:
    int number_ = -1;
};

}  // namespace abrdf
