// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/end_signal.hpp"
#include <csignal>

namespace fretwork::app {
namespace {

volatile std::sig_atomic_t ended_by = 0; ///< the signal that has come; 0: none

void note(int signal) { ended_by = signal; }

} // namespace

EndSignal::EndSignal() : on_terminate_(std::signal(SIGTERM, note)), on_interrupt_(std::signal(SIGINT, note)) {
  if (on_interrupt_ == SIG_IGN)
    (void)std::signal(SIGINT, SIG_IGN);
}

EndSignal::~EndSignal() {
  (void)std::signal(SIGTERM, on_terminate_);
  (void)std::signal(SIGINT, on_interrupt_);
}

std::string EndSignal::came() {
  if (ended_by == 0)
    return {};
  return ended_by == SIGINT ? "Ctrl-C (SIGINT)" : "SIGTERM";
}

} // namespace fretwork::app
