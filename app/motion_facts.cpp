// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/motion_facts.hpp"
#include "app/build_fields.hpp"
#include "app/support_motion.hpp"
#include "signals/prescribed_motion.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// Instants of a run at which a motion is looked at, besides the rows of a table: in all, and in a period of its highest frequency.
constexpr double fewest_instants = 20000, most_instants = 4e6, in_a_period = 40.0;
constexpr double far_away = 1.0; // m: no structure follows obstacles so far
constexpr double much_longer = 1.001;

results::MotionFacts facts_of(std::string name, const signals::PrescribedMotion& motion,
                              const signals::TimeFunction& given, double duration) {
  results::MotionFacts out{std::move(name)};
  const signals::MotionSignal signal(motion, duration);
  const double start = signal(0.0).displacement;
  const auto look = [&](double time) {
    if (const double a = std::abs(signal.acceleration(time)); a > out.largest) {
      out.largest = a;
      out.time = time;
    }
    out.displacement = std::max(out.displacement, std::abs(signal(time).displacement - start));
  };
  const auto instants = static_cast<int>(
      std::clamp(in_a_period * signals::highest_frequency(given) * duration, fewest_instants, most_instants));
  for (int i = 0; i <= instants; ++i)
    look(duration * i / instants);
  if (const auto* harmonic = std::get_if<signals::Harmonic>(&motion.acceleration);
      harmonic && harmonic->frequency * duration > 1.0)
    out.largest = std::abs(harmonic->amplitude);
  if (const auto* table = std::get_if<signals::Table>(&given)) {
    for (const double time : table->time)
      if (time >= 0.0 && time <= duration)
        look(time);
    out.rows = static_cast<std::int64_t>(table->time.size());
    out.record_from = table->time.front();
    out.record_to = table->time.back();
  }
  return out;
}

/// Of a record whose baseline goes away, with numbers; else empty. Judged by means over quarters, for a record may be cut off while it moves;
/// a displacement that goes one way is meant.
/// @param consequence  of the drift, in words
std::string drift_text(const std::string& name, const signals::PrescribedMotion& motion,
                       const signals::TimeFunction& given, bool by_displacement, double duration,
                       const char* consequence) {
  constexpr std::size_t fewest_rows = 64;         // of a record
  constexpr double moving = 0.2, displaced = 0.4; // of the largest velocity and displacement
  constexpr double one_way = 1.5;                 // path over the way from start to end
  const auto* table = std::get_if<signals::Table>(&given);
  if (!table || table->time.size() < fewest_rows || !(table->time.back() > 0.0) ||
      table->time.back() > much_longer * duration)
    return {};
  const signals::MotionSignal signal(motion, duration);
  const double end = std::min(table->time.back(), duration), start = signal(0.0).displacement,
               away = signal(end).displacement - start;
  constexpr int places = 4000; // of a quarter: a thousand
  double fastest = 0.0, farthest = 0.0, path = 0.0, last = start, first_quarter = 0.0, last_quarter = 0.0;
  for (int i = 0; i < places; ++i) {
    const auto [displacement, velocity] = signal((i + 0.5) * end / places);
    fastest = std::max(fastest, std::abs(velocity));
    farthest = std::max(farthest, std::abs(displacement - start));
    path += std::abs(displacement - last);
    last = displacement;
    (i < places / 4 ? first_quarter : last_quarter) +=
        i < places / 4 || i >= 3 * places / 4 ? 4.0 * displacement / places : 0.0;
  }
  const double velocity = (signal(end).displacement - signal(0.75 * end).displacement) / (0.25 * end);
  if ((std::abs(velocity) <= moving * fastest &&
       std::abs(last_quarter - first_quarter) <= displaced * farthest) ||
      (by_displacement && path <= one_way * std::abs(away)))
    return {};
  return fmt::format(
      "{}: its record moves by {:.3g} m/s on the average of its last quarter (largest velocity {:.3g} m/s) "
      "and ends {:.3g} m from where it starts (largest {:.3g} m): its baseline drifts{}",
      name, velocity, fastest, away, farthest, consequence);
}

/// Whether obstacles stay in space while bases move.
bool has_grounded(const study::Study& study) {
  return std::any_of(study.contacts.begin(), study.contacts.end(),
                     [](const study::Contact& contact) { return contact.grounded; });
}

void judge(const results::MotionFacts& facts, bool leaves_obstacles, double duration,
           results::RunResults& out) {
  if (facts.rows > 1 && facts.record_to > much_longer * duration)
    out.notes.push_back(fmt::format("{}: the run of {:g} s ends before the record, which goes on to {:g} s",
                                    facts.name, duration, facts.record_to));
  if (leaves_obstacles && facts.displacement > far_away)
    out.warnings.push_back(fmt::format(
        "{} goes {:.3g} m away from where it starts, and obstacles stay in space: an "
        "acceleration without baseline correction drifts; correct it, give a displacement, or let "
        "contacts move along (attached_to)",
        facts.name, facts.displacement));
}

} // namespace

void describe_motions(const study::Study& study, results::RunResults& out) {
  if (!study.transient)
    return;
  const double duration = study.transient->duration;
  for (std::size_t k = 0; k < study.base_motions.size(); ++k) {
    const study::BaseMotion& motion = study.base_motions[k];
    out.motions.push_back(
        facts_of(fmt::format("[[base_motion]]{} along {}",
                             study.base_motions.size() > 1 ? fmt::format(" entry {}", k + 1) : "",
                             fem::place(motion.direction)),
                 prescribed(motion), motion.acceleration, duration));
    judge(out.motions.back(), has_grounded(study), duration, out);
    if (std::string drift =
            drift_text(out.motions.back().name, prescribed(motion), motion.acceleration, false, duration,
                       has_grounded(study) ? "; correct the record, for obstacles stay in space"
                                           : ", of no effect on results, which are relative to the base");
        !drift.empty())
      (has_grounded(study) ? out.warnings : out.notes).push_back(std::move(drift));
  }
  for (std::size_t k = 0; k < study.support_motions.size(); ++k) {
    const study::SupportMotion& motion = study.support_motions[k];
    out.motions.push_back(
        facts_of(name_of_support_motion(motion, k), prescribed(motion), motion.function, duration));
    judge(out.motions.back(), !study.contacts.empty() && !motion.by_displacement, duration, out);
    if (std::string drift =
            drift_text(out.motions.back().name, prescribed(motion), motion.function, motion.by_displacement,
                       duration, "; correct the record: supports that drift apart strain what they hold");
        !drift.empty())
      out.warnings.push_back(std::move(drift));
  }
}

} // namespace fretwork::app
