// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A folder for what lives only for a moment.
#pragma once
#include <filesystem>

namespace fretwork::core {

/// A folder fretwork-XXXXXX in the system's temporary folder, removed with its content at the end. A process that is killed cannot remove
/// its own: each new one removes those that no living process holds (by flock(2)).
class TemporaryDirectory {
public:
  /// @throws core::Error if it cannot be made
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  int hold_ = -1; ///< descriptor of the folder, locked
};

} // namespace fretwork::core
