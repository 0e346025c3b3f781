// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>

namespace fretwork::app {

/// Seconds since it was made, or since the last lap.
class Stopwatch {
public:
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }
  [[nodiscard]] double total() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

} // namespace fretwork::app
