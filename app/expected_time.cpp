// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/expected_time.hpp"
#include "core/error.hpp"
#include "post/contact_statistics.hpp"
#include <algorithm>
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

std::string time_text(const PilotTime& time) {
  return time.contacts_open ? fmt::format("at least {} (contacts are still open in the first steps)",
                                          time_text(time.seconds))
                            : "about " + time_text(time.seconds);
}

PilotTime pilot_time(const transient::Scene& scene, const transient::StepChoice& choice,
                     std::chrono::duration<double> budget) {
  using Clock = std::chrono::steady_clock;
  post::ContactStatistics contacts(scene.contacts, 0.0);
  transient::Observer* const observer = &contacts;
  transient::Run pilot(scene, choice, {&observer, scene.contacts.empty() ? 0u : 1u}, nullptr, {});
  const auto begin = Clock::now(); // after what is made once
  const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  bool more = true;
  const auto run_until = [&](double time) {
    do
      more = more && pilot.advance(records_between_looks);
    while (more && spent() < time);
  };
  run_until(budget.count() / 3.0);
  const double from = pilot.time(), spent_before = spent();
  run_until(budget.count());
  if (!more)
    return {spent(), false};
  const std::vector<post::ContactSummary> summaries = contacts.summaries();
  const bool open = !summaries.empty() &&
                    std::all_of(summaries.begin(), summaries.end(),
                                [](const post::ContactSummary& of) { return of.contact_time_ratio == 0.0; });
  const double pace = (spent() - spent_before) / (pilot.time() - from);
  return {spent() + (scene.duration - pilot.time()) * pace, open};
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
