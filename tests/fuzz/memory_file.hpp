// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A file without a place on a disk, for readers that take a path.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace fretwork::fuzz {

class MemoryFile {
public:
  MemoryFile() : file_(memfd_create("fretwork fuzz", MFD_CLOEXEC)) {
    if (file_ < 0)
      std::abort();
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }
  void fill(std::string_view bytes) const {
    if (ftruncate(file_, 0) != 0 ||
        pwrite(file_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      std::abort();
  }

private:
  int file_;
};

} // namespace fretwork::fuzz
