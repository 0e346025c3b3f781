// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The signals by which users and batch systems end a program.
#pragma once
#include <string>

namespace fretwork::app {

/// While it lives SIGTERM and SIGINT (Ctrl-C) are noted, and whoever looks can save its work. A SIGINT that the program was started to
/// ignore stays ignored.
class EndSignal {
public:
  EndSignal();
  ~EndSignal();
  EndSignal(const EndSignal&) = delete;
  EndSignal& operator=(const EndSignal&) = delete;

  /// What the user calls the signal that has come; empty: none has.
  [[nodiscard]] static std::string came();

private:
  void (*on_terminate_)(int); ///< what SIGTERM did before
  void (*on_interrupt_)(int); ///< what SIGINT did before
};

} // namespace fretwork::app
