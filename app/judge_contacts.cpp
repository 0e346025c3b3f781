// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/judge_contacts.hpp"
#include "app/shared_signals.hpp"
#include "contact/restitution.hpp"
#include "core/names.hpp"
#include "results/figures.hpp"
#include "results/totals.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

/// Of the busiest entry's sum of squared impact velocities: what matters to nobody.
constexpr double negligible_impacts = 0.01;
/// Shares of time from which on a contact is closed, and sticks, as a rule.
constexpr double mostly = 0.5;
constexpr std::size_t most_named = 5;

/// Of an entry of [[contacts]].
struct Impacts {
  double number = 0.0, squares = 0.0; ///< squares: m2/s2, sum of squared velocities
  [[nodiscard]] double rms() const { return std::sqrt(squares / number); }
};

std::vector<Impacts> impacts_by_entry(const study::Study& study, const std::vector<PlacedContact>& placed,
                                      const results::RunResults& out) {
  std::vector<Impacts> impacts(study.contacts.size());
  for (std::size_t c = 0; c < placed.size(); ++c) {
    const post::ContactSummary& of = out.contact_summaries[c];
    const auto number = static_cast<double>(of.impacts);
    impacts[placed[c].entry].number += number;
    impacts[placed[c].entry].squares += number * of.impact_velocity_rms * of.impact_velocity_rms;
  }
  return impacts;
}

/// Empty where the restitution is as asked for. That of Kelvin and Voigt's law is the same at every velocity.
std::string restitution_warning(const study::Contact& entry, double velocity) {
  if (!entry.restitution || entry.normal_damper != study::NormalDamper::hunt_crossley)
    return {};
  const auto [asked, mass, asked_at] = *entry.restitution;
  const double reached =
      contact::restitution_of_dissipation(contact::dissipation_of_restitution(asked, asked_at) * velocity);
  if (!(std::abs(reached - asked) > restitution_tolerance))
    return {};
  const auto lost = [](double restitution) { return 100.0 * (1.0 - restitution * restitution); };
  return fmt::format(
      "contact \"{}\": the rms impact velocity is {:.3g} m/s, {:.2g} times restitution_velocity = "
      "{:g} m/s: the restitution of hunt_crossley there is {:.2f}, not {:g}, and an impact loses "
      "{:.2g} % of its energy, not {:.2g} %; set restitution_velocity = {:.2g}",
      entry.name, velocity, velocity / asked_at, asked_at, reached, asked, lost(reached), lost(asked),
      velocity);
}

/// Of an entry of [[contacts]], or of several.
struct StuckDampers {
  double work = 0.0;                       ///< J
  double least = HUGE_VAL, most = 0.0;     ///< N s/m
  double lowest = HUGE_VAL, highest = 0.0; ///< Hz, from which on the damper is stiffer than the spring

  void add(const StuckDampers& other) {
    work += other.work;
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
};

bool sticks(const post::ContactSummary& of) {
  return of.contact_time_ratio > mostly && of.sticking_ratio > mostly;
}

std::vector<StuckDampers> stuck_dampers(const study::Study& study, const std::vector<PlacedContact>& placed,
                                        const std::vector<BuiltScene>& scenes,
                                        const std::vector<post::ContactSummary>& summaries) {
  std::vector<StuckDampers> out(study.contacts.size());
  for (const BuiltScene& built : scenes)
    for (std::size_t k = 0; k < built.contacts.size(); ++k) {
      const std::size_t c = built.contacts[k];
      const contact::FrictionLaw& law = built.scene.contacts[k].support.friction;
      if (!law.active() || !(law.damping > 0.0) || study.contacts[placed[c].entry].tangential_damping ||
          !sticks(summaries[c]))
        continue;
      const double damping = law.damping / placed[c].share,
                   hz = law.stiffness / law.damping / (2.0 * std::numbers::pi);
      out[placed[c].entry].add({summaries[c].damping_work, damping, damping, hz, hz});
    }
  return out;
}

std::string range(double least, double most) {
  constexpr int digits = 3;
  const std::string low = results::without_exponent(least, digits),
                    high = results::without_exponent(most, digits);
  return low == high ? low : low + " to " + high;
}

} // namespace

void judge_restitution(const study::Study& study, const std::vector<PlacedContact>& placed,
                       results::RunResults& out) {
  const std::vector<Impacts> impacts = impacts_by_entry(study, placed, out);
  double busiest = 0.0;
  for (const Impacts& of : impacts)
    busiest = std::max(busiest, of.squares);
  for (std::size_t e = 0; e < impacts.size(); ++e)
    if (impacts[e].squares > negligible_impacts * busiest)
      if (std::string warning = restitution_warning(study.contacts[e], impacts[e].rms()); !warning.empty())
        out.warnings.push_back(std::move(warning));
}

void judge_stuck_dampers(const study::Study& study, const std::vector<PlacedContact>& placed,
                         const std::vector<BuiltScene>& scenes, results::RunResults& out) {
  const std::vector<StuckDampers> entries = stuck_dampers(study, placed, scenes, out.contact_summaries);
  StuckDampers all;
  for (const StuckDampers& entry : entries)
    all.add(entry);
  if (!(all.work > 0.0) || out.transients.empty())
    return;
  const results::EnergyTotals energy = results::add_up(out.transients).energy; // of the whole run
  const double duration = study.transient->duration,
               whole = all.work * duration / (duration - study.output.statistics_from),
               share = whole / (energy.modal_damping + energy.contact_damping + energy.friction);
  if (!(share > taken_by_stuck))
    return;
  std::vector<std::string> names;
  for (std::size_t e = 0; e < entries.size(); ++e)
    if (entries[e].work > 0.0)
      names.push_back(study.contacts[e].name);
  out.warnings.push_back(fmt::format(
      "the automatic tangential_damping of {} takes {:.2g} % of the energy dissipated, in contacts that "
      "stick: its {} N s/m are stiffer than tangential_stiffness above {} Hz, and motion and wear follow "
      "from them; "
      "set tangential_damping (that of a loss factor eta at f Hz is eta K_T/(2 pi f))",
      core::list_names(names, most_named), 100.0 * share, range(all.least, all.most),
      range(all.lowest, all.highest)));
}

void judge_sliding(const study::Study& study, const std::vector<PlacedContact>& placed,
                   results::RunResults& out) {
  bool touches = false;
  for (std::size_t c = 0; c < placed.size(); ++c) {
    const post::ContactSummary& of = out.contact_summaries[c];
    if (!(study.contacts[placed[c].entry].friction_dynamic > 0.0))
      continue;
    if (of.work_rate != 0.0)
      return;
    touches = touches || of.normal_rms > 0.0;
  }
  const std::vector<SharedSignal> shared = touches ? shared_signals(study) : std::vector<SharedSignal>{};
  if (!shared.empty())
    out.warnings.push_back(fmt::format(
        "no contact slides, though contacts have friction: {}, which may move the structure along "
        "one line, with impacts but without sliding; give each another seed (in a sweep by seeds, or each = "
        "true)",
        text_of(shared.front())));
}

void judge_contacts(const study::Study& study, const std::vector<PlacedContact>& placed,
                    const std::vector<BuiltScene>& scenes, results::RunResults& out) {
  judge_restitution(study, placed, out);
  judge_stuck_dampers(study, placed, scenes, out);
  judge_sliding(study, placed, out);
}

void judge_reach(results::RunResults& out) {
  const auto closed = [](const post::ContactSummary& c) { return c.normal_rms > 0.0; };
  const auto& all = out.contact_summaries;
  if (!all.empty() && std::none_of(all.begin(), all.end(), closed))
    out.notes.push_back(
        "no contact closes in the window of the statistics: the motion does not cross the gaps");
}

} // namespace fretwork::app
