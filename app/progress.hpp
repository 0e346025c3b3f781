// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One line on a terminal that tells how far the work is: stage, percent, simulated time, time left. Nothing
/// where stderr is not a terminal.
#pragma once
#include <chrono>
#include <string>

namespace fretwork::app {

class Progress {
public:
  explicit Progress(bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  [[nodiscard]] bool shown() const { return shown_; }
  void stage(const std::string& name);
  /// @param share  done, 0 to 1   @param time  simulated, s
  void update(double share, double time);

private:
  using Clock = std::chrono::steady_clock;
  void clear() const;
  bool shown_;
  std::string stage_;
  Clock::time_point begin_, last_;
};

} // namespace fretwork::app
