// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A library to be loaded before the others (LD_PRELOAD): it counts the calls that change files below a folder, and lets the n-th fail.
///
///     FAULT_FOLDER   the folder
///     FAULT_AT       n, from 1 on; 0: none fails
///     FAULT_KIND     ENOSPC, EIO, short (a write takes half of its bytes, once, then ENOSPC), kill (SIGKILL in the place of the call)
///     FAULT_LASTING  1: all calls from the n-th on fail
///     FAULT_COUNT    a file outside of the folder that is given the number of calls, a byte each
/// Calls: write, pwrite, fsync, close of a file open for writing, rename, and open with O_CREAT.
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

bool below_folder(const std::string& path) {
  static const std::string folder = setting("FAULT_FOLDER");
  return !folder.empty() && path.starts_with(folder);
}

bool below_folder(int file) {
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  char path[4096];
  const ssize_t length = readlink(link.c_str(), path, sizeof path);
  return length > 0 && below_folder(std::string(path, static_cast<std::size_t>(length)));
}

enum class Fault { none, error, half };

/// Counts a call. @return what is to become of it, errno set
Fault next_fault() {
  static const long at = std::atol(setting("FAULT_AT").c_str());
  static const std::string kind = setting("FAULT_KIND");
  static const bool lasting = setting("FAULT_LASTING") == "1";
  static const std::string count = setting("FAULT_COUNT");
  const int counter =
      static_cast<int>(syscall(SYS_openat, AT_FDCWD, count.c_str(), O_WRONLY | O_APPEND | O_CREAT, 0600));
  syscall(SYS_write, counter, "x", 1);
  const long calls = lseek(counter, 0, SEEK_END); // of all processes of a run
  syscall(SYS_close, counter);
  if (at == 0 || calls < at || (calls > at && !lasting && kind != "short"))
    return Fault::none;
  if (kind == "kill")
    raise(SIGKILL);
  if (kind == "short" && calls == at)
    return Fault::half;
  errno = kind == "EIO" ? EIO : ENOSPC;
  return Fault::error;
}

} // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  const Fault fault = below_folder(file) ? next_fault() : Fault::none;
  if (fault == Fault::error)
    return -1;
  return syscall(SYS_write, file, bytes, fault == Fault::half ? count / 2 : count);
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off_t offset) {
  if (below_folder(file) && next_fault() != Fault::none)
    return -1;
  return syscall(SYS_pwrite64, file, bytes, count, offset);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset) {
  return pwrite64(file, bytes, count, offset);
}

int fsync(int file) {
  if (below_folder(file) && next_fault() != Fault::none)
    return -1;
  return static_cast<int>(syscall(SYS_fsync, file));
}

int close(int file) {
  const bool watched = (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY && below_folder(file);
  const Fault fault = watched ? next_fault() : Fault::none;
  const int error = errno, status = static_cast<int>(syscall(SYS_close, file)); // it is closed in any case
  if (fault == Fault::none)
    return status;
  errno = error;
  return -1;
}

int rename(const char* from, const char* to) {
  if (below_folder(to) && next_fault() != Fault::none)
    return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int open64(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
    if (below_folder(path) && next_fault() != Fault::none)
      return -1;
  }
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  return open64(path, flags, mode);
}

} // extern "C"
