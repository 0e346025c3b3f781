// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/temporary_directory.hpp"
#include "core/error.hpp"
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fretwork::core {
namespace {

namespace fs = std::filesystem;

const std::string name_start = "fretwork-", pattern = name_start + "XXXXXX";
constexpr std::time_t settling_time = 60; ///< s: younger folders may be on the way to their lock

/// A lock that nobody else has; -1 where there is none.
int hold(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
    return descriptor;
  if (descriptor >= 0)
    (void)::close(descriptor);
  return -1;
}

bool is_left_over(const fs::path& folder) {
  const std::string name = folder.filename().string();
  struct stat facts {};
  return name.starts_with(name_start) && name.size() == pattern.size() &&
         ::lstat(folder.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == ::geteuid() &&
         facts.st_mtime + settling_time < std::time(nullptr);
}

void remove_left_over(const fs::path& parent) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; !ignored && entry != end; entry.increment(ignored))
    if (is_left_over(entry->path()))
      if (const int held = hold(entry->path()); held >= 0) {
        std::error_code none;
        fs::remove_all(entry->path(), none);
        (void)::close(held);
      }
}

} // namespace

TemporaryDirectory::TemporaryDirectory() {
  std::error_code failure;
  const fs::path parent = fs::temp_directory_path(failure);
  std::string made = (parent / pattern).string();
  if (failure || ::mkdtemp(made.data()) == nullptr)
    throw Error("no temporary folder can be made (" +
                (failure ? failure.message() : made + ": " + std::strerror(errno)) +
                "); set TMPDIR to a writable folder");
  path_ = made;
  hold_ = hold(path_);
  remove_left_over(parent);
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (hold_ >= 0)
    (void)::close(hold_);
}

} // namespace fretwork::core
