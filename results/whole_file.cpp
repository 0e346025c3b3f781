// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/whole_file.hpp"
#include "core/error.hpp"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fretwork::results {

namespace fs = std::filesystem;

namespace {

constexpr mode_t usual_permissions = 0666; ///< less the umask

/// The part file while it is written; removed unless it took its name.
class Part {
public:
  /// A new file: what stands in its place is removed, and a symbolic link is removed, not followed.
  explicit Part(const fs::path& path) : path_(path) {
    (void)::unlink(path_.c_str());
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, usual_permissions);
    check(file_ >= 0);
  }
  ~Part() {
    if (file_ >= 0)
      (void)::close(file_);
    if (!named_)
      (void)::unlink(path_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR)
        continue;
      check(written >= 0);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  /// A file system that cannot synchronise says EINVAL or ENOTSUP: there is nothing to do.
  void synchronise() { check(::fsync(file_) == 0 || errno == EINVAL || errno == ENOTSUP); }
  void close() { check(::close(std::exchange(file_, -1)) == 0); }
  void take_name(const fs::path& name) {
    check(::rename(path_.c_str(), name.c_str()) == 0);
    named_ = true;
  }

private:
  void check(bool done) {
    if (!done)
      throw std::system_error(errno, std::generic_category());
  }
  fs::path path_;
  int file_ = -1;
  bool named_ = false;
};

void synchronise_folder(const fs::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0)
    return;
  (void)::fsync(file); // the file is whole under its old or its new name, whatever this returns
  (void)::close(file);
}

} // namespace

void write_whole(const fs::path& file, std::initializer_list<std::string_view> parts, Durability durability) {
  try {
    if (file.has_parent_path())
      fs::create_directories(file.parent_path());
    fs::path name = file;
    Part part(name.replace_extension(".part" + file.extension().string()));
    for (const std::string_view bytes : parts)
      part.write(bytes);
    if (durability == Durability::on_disk)
      part.synchronise();
    part.close();
    part.take_name(file);
  } catch (const std::system_error& failure) {
    throw core::Error(
        fmt::format("{}: cannot be written: {}; check the folder, its permissions and the space left",
                    file.string(), failure.code().message()));
  }
  if (durability == Durability::on_disk)
    synchronise_folder(file.parent_path());
}

} // namespace fretwork::results
