// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/shard.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace fretwork::sweep {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_places = 3; ///< of corrupt rows that are named
constexpr mode_t permissions = 0666;   ///< less the umask

std::vector<fs::path> row_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code absent;
  for (fs::recursive_directory_iterator at(folder, absent), end; at != end; at.increment(absent))
    if (at->is_regular_file() && at->path().extension() == ".rows")
      files.push_back(at->path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

Shard shard_of(const std::string& text) {
  Shard out{};
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, out.index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, out.count)
                            : std::from_chars_result{end, std::errc::invalid_argument};
  if (second.ec != std::errc{} || second.ptr != end || out.count < 1 || out.index < 1 ||
      out.index > out.count)
    throw core::Error(
        fmt::format("--shard {}: i/n with 1 <= i <= n is expected: part 2 of 8 is --shard 2/8", text));
  return out;
}

ShardFile::ShardFile(const fs::path& file) : path_(file) {
  std::error_code failure;
  fs::create_directories(file.parent_path(), failure);
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, permissions);
  if (file_ < 0)
    throw core::Error(fmt::format("{}: cannot be made: {}; check the folder and its permissions",
                                  path_.string(), std::strerror(errno)));
  struct stat status {};
  char last = '\n';
  if (::fstat(file_, &status) == 0 && status.st_size > 0 &&
      ::pread(file_, &last, 1, status.st_size - 1) == 1 && last != '\n')
    write("\n"); // the line of a process that was killed while it wrote
}

ShardFile::~ShardFile() { (void)::close(file_); }

void ShardFile::append(const Row& row) { write(line_of(row)); }

void ShardFile::write(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(file_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR)
      continue;
    if (written < 0)
      throw core::Error(fmt::format("{}: cannot be written: {}; make room, then give the same command again",
                                    path_.string(), std::strerror(errno)));
    done += static_cast<std::size_t>(written);
  }
}

FoundRows read_rows(const fs::path& folder, std::int64_t cases,
                    const std::function<std::string(std::int64_t)>& identity_of) {
  FoundRows out;
  for (const fs::path& path : row_files(folder)) {
    std::ifstream in(path, std::ios::binary);
    std::string line;
    for (std::int64_t number = 1; std::getline(in, line); ++number) {
      if (line.empty())
        continue;
      auto row = row_of(line);
      if (!row) {
        ++out.corrupt;
        if (out.where.size() < most_places)
          out.where.push_back(fmt::format("{}:{}", path.string(), number));
      } else if (row->number < 0 || row->number >= cases) {
        continue; // of a larger sweep
      } else if (row->identity != identity_of(row->number)) {
        ++out.of_others;
      } else {
        out.rows.push_back(std::move(*row));
      }
    }
  }
  std::stable_sort(out.rows.begin(), out.rows.end(),
                   [](const Row& a, const Row& b) { return a.number < b.number; });
  out.rows.erase(std::unique(out.rows.begin(), out.rows.end(),
                             [](const Row& a, const Row& b) { return a.number == b.number; }),
                 out.rows.end());
  return out;
}

} // namespace fretwork::sweep
