// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far the work is: stage, percent, simulated time, time left. One line that changes on a terminal; where stderr
/// is a file or a pipe, lines of work that takes long.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace fretwork::app {

/// How long work will take: by the pace since it was first looked at. What was done before, by a run that this one goes on from, took none
/// of its time.
class Pace {
public:
  /// @param share  done, 0 to 1   @param seconds  on the clock
  /// @return seconds left; none at the first call, which begins the measurement, and before anything more is done
  std::optional<double> left(double share, double seconds);

private:
  std::optional<std::pair<double, double>> begin_; ///< share and seconds of the first call
};

class Progress {
public:
  /// @param between_lines  least time from one line to the next where stderr is no terminal
  explicit Progress(bool wanted, std::chrono::milliseconds between_lines = std::chrono::seconds(10));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  [[nodiscard]] bool shown() const { return shown_; }
  void stage(const std::string& name);
  /// @param share  done, 0 to 1   @param time  simulated, s
  void update(double share, double time);
  /// Of a sweep: cases that have ended, of so many, and how many of them without a result.
  void update_cases(std::int64_t ended, std::int64_t all, std::int64_t failed);

private:
  using Clock = std::chrono::steady_clock;
  /// Whether a line is due at a share of the work; the seconds left.
  bool is_due(double share, std::optional<double>& left);
  void print(std::string text, std::optional<double> left) const;
  void clear() const;
  bool shown_, on_terminal_;
  std::chrono::milliseconds between_lines_;
  double last_share_ = 0.0; ///< of the last line
  std::string stage_;
  Clock::time_point begin_, last_;
  Pace pace_;
};

} // namespace fretwork::app
