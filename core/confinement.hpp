// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a child process that reads a stranger's file may do, enforced by the kernel (Linux: Landlock and seccomp).
///
/// - It reads what its user may read, and writes only below one folder.
/// - What it starts, or turns itself into, is confined like it. Where processes are refused it starts none: one that tries is ended by SIGSYS.
/// - It opens no socket, changes no permissions, owners, dates or mounts, and sends no signal to another process.
/// Sources: landlock(7), seccomp(2).
#pragma once
#include <filesystem>

namespace fretwork::core {

enum class Processes { refused, allowed };

/// Prepared by the parent, put into force by the child between fork and exec: `enforce` only makes system calls.
class Confinement {
public:
  /// @param writable  the folder below which files may be made, changed and removed
  /// @throws core::Error if the kernel refuses although `available()`
  explicit Confinement(const std::filesystem::path& writable, Processes processes = Processes::refused);
  ~Confinement();
  Confinement(const Confinement&) = delete;
  Confinement& operator=(const Confinement&) = delete;

  /// True where the kernel has what is needed. FRETWORK_CONFINEMENT = "off" in the environment counts as no.
  [[nodiscard]] static bool available();
  /// Of this process and all that it becomes, for ever. @return false if the kernel refuses
  [[nodiscard]] bool enforce() const noexcept;

private:
  Processes processes_;
  int rules_ = -1; ///< descriptor of the Landlock rules
};

/// The signal that ends a confined process which tries to start another.
inline constexpr int process_refused = 31; // SIGSYS

} // namespace fretwork::core
