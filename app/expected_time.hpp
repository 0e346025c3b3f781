// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How long a run will take, from its first seconds.
#pragma once
#include "transient/run.hpp"
#include <chrono>
#include <functional>
#include <string>

namespace fretwork::app {

struct TimeLimit {
  double duration = 0.0; ///< s, simulated, of a run
  double most_hours = 0.0;
  std::function<void(const std::string&)> tell; ///< a line for the user
};

/// Watches one run. After `settling` on the clock it tells what is left where that is more than `worth_telling`, once, and refuses a run that
/// would take longer than the limit.
class ExpectedTime {
public:
  static constexpr std::chrono::seconds settling{2};
  static constexpr double worth_telling = 60.0; ///< s

  /// @param begin  s, simulated: where the run starts or goes on
  ExpectedTime(const TimeLimit& limit, double begin) : limit_(limit), begin_(begin) {}
  /// @param time  s, simulated so far
  /// @throws core::Error where the rest would take more than `limit.most_hours`
  void look(double time);

private:
  using Clock = std::chrono::steady_clock;
  const TimeLimit& limit_;
  double begin_;
  Clock::time_point start_ = Clock::now();
  bool told_ = false;
};

/// Time that a run takes on the clock, from a pilot run.
struct PilotTime {
  double seconds = 0.0;
  bool contacts_open = false; ///< none has closed in the pilot run: more from the first impact on
};
/// The pilot run is the beginning of the run, up to the budget (or the whole run). A third of it passes the first transient, the rest measures the
/// time per simulated second. Output, and contacts that come to need finer intervals, are left out.
[[nodiscard]] PilotTime pilot_time(const transient::Scene& scene, const transient::StepChoice& choice,
                                   std::chrono::duration<double> budget);
/// @throws core::Error where `seconds`, the forecast of a whole run, are more than `most_hours`
void check_expected_time(double seconds, double most_hours);

/// `0.62 s`, `12 min`, `3.4 h`
[[nodiscard]] std::string time_text(double seconds);
/// `about 12 min`, `at least 4.1 s (contacts are still open in the first steps)`
[[nodiscard]] std::string time_text(const PilotTime& time);

} // namespace fretwork::app
