// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/write.hpp"
#include <fmt/format.h>
#include <system_error>

namespace fretwork::results {

namespace fs = std::filesystem;

void write_whole(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  const auto refuse = [&](const std::string& why) {
    throw core::Error(
        fmt::format("{}: cannot be written: {}; check the folder, its permissions and the space left",
                    file.string(), why));
  };
  std::error_code failure;
  if (file.has_parent_path())
    fs::create_directories(file.parent_path(), failure);
  if (failure)
    refuse(failure.message());
  fs::path part = file; // the ending stays: some writers choose the format by it
  part.replace_extension(".part" + file.extension().string());
  try {
    write(part);
  } catch (...) {
    fs::remove(part, failure);
    throw;
  }
  fs::rename(part, file, failure);
  if (failure) {
    std::error_code ignored;
    fs::remove(part, ignored);
    refuse(failure.message());
  }
}

} // namespace fretwork::results
