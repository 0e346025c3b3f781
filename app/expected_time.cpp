// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/expected_time.hpp"
#include "core/error.hpp"
#include <fmt/format.h>

namespace fretwork::app {
namespace {

constexpr double minute = 60.0, hour = 3600.0; // s
constexpr std::int64_t records_between_looks = 64;

constexpr const char* cure = "shorten the duration, take a longer step, or raise max_hours";

} // namespace

std::string time_text(double seconds) {
  return seconds < minute ? fmt::format("{:.2g} s", seconds)
         : seconds < hour ? fmt::format("{:.0f} min", seconds / minute)
                          : fmt::format("{:.3g} h", seconds / hour);
}

double trial_of(const transient::Scene& scene, const transient::StepChoice& choice,
                std::chrono::duration<double> budget) {
  using Clock = std::chrono::steady_clock;
  transient::Run trial(scene, choice, {}, nullptr, {});
  const auto begin = Clock::now(); // after what is made once
  const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - begin); };
  bool more = trial.advance(records_between_looks);
  while (more && spent() < budget)
    more = trial.advance(records_between_looks);
  return more ? spent().count() * scene.duration / trial.time() : spent().count();
}

void check_expected_time(double seconds, double most_hours) {
  if (seconds > most_hours * hour)
    throw core::Error(fmt::format("transient: as its first steps show, a run would take {}, more than "
                                  "transient.max_hours = {:g}; {}",
                                  time_text(seconds), most_hours, cure));
}

void ExpectedTime::look(double time) {
  if (told_ || time <= begin_ || Clock::now() - start_ < settling)
    return;
  told_ = true;
  const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
  const double left = spent * (limit_.duration - time) / (time - begin_);
  if (left > limit_.most_hours * hour)
    throw core::Error(
        fmt::format("transient: {:.3g} s of {:.6g} s have taken {:.2g} s; the rest would take {}, more than "
                    "transient.max_hours = {:g}; {}",
                    time - begin_, limit_.duration, spent, time_text(left), limit_.most_hours, cure));
  if (left > worth_telling)
    limit_.tell(fmt::format("transient: {} to go", time_text(left)));
}

} // namespace fretwork::app
