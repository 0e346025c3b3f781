// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One run at a time in a results folder.
#pragma once
#include <filesystem>
#include <string>

namespace fretwork::app {

/// Holds DIR/.lock by flock(2), which ends with the process however that ends; the file says who holds it. Where the file system has no locks,
/// or the folder cannot be written, nothing is held.
class FolderLock {
public:
  /// @param user  what holds it, for the message of another that wants it
  /// @throws core::Error if another process holds it
  FolderLock(const std::filesystem::path& directory, const std::string& user);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  std::filesystem::path path_;
  int file_ = -1;
};

} // namespace fretwork::app
