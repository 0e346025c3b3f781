// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/folder_lock.hpp"
#include "core/error.hpp"
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace fretwork::app {
namespace {

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

/// False where the holder before has removed the file between its opening and its lock.
bool is_still_there(int file, const std::filesystem::path& path) {
  struct stat held {
  }, named{};
  return ::fstat(file, &held) == 0 && ::lstat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

std::string holder(int file) {
  std::array<char, 512> text{};
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "another process";
}

} // namespace

FolderLock::FolderLock(const std::filesystem::path& directory, const std::string& user)
    : path_(directory / ".lock") {
  constexpr mode_t permissions = 0644;
  for (;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, permissions);
    if (file_ < 0)
      return;
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const bool held = errno == EWOULDBLOCK;
      const std::string by = held ? holder(file_) : "";
      (void)::close(std::exchange(file_, -1));
      if (!held)
        return;
      throw core::Error(
          fmt::format("the results folder \"{}\" is in use by {}; wait for its end, or give another with -o",
                      directory.string(), by));
    }
    if (is_still_there(file_, path_))
      break;
    (void)::close(file_);
  }
  const std::string by = fmt::format("process {} on {}: {}", ::getpid(), host(), user);
  (void)!::ftruncate(file_, 0);
  (void)!::pwrite(file_, by.data(), by.size(), 0);
}

FolderLock::~FolderLock() {
  if (file_ < 0)
    return;
  (void)::unlink(path_.c_str());
  (void)::close(file_);
}

} // namespace fretwork::app
