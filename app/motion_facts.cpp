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
  }
  for (std::size_t k = 0; k < study.support_motions.size(); ++k) {
    const study::SupportMotion& motion = study.support_motions[k];
    out.motions.push_back(
        facts_of(name_of_support_motion(motion, k), prescribed(motion), motion.function, duration));
    judge(out.motions.back(), !study.contacts.empty() && !motion.by_displacement, duration, out);
  }
}

} // namespace fretwork::app
