// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/totals.hpp"
#include "results/grouped_messages.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace fretwork::results {
namespace {

void add(std::size_t structure, const modal::Basis& basis, Eigen::Index first, Eigen::Index count,
         std::vector<ModeOf>& modes) {
  for (Eigen::Index k = first; k < first + count; ++k)
    modes.push_back({structure, k, basis.omega(k) / (2.0 * std::numbers::pi)});
}

void sort(std::vector<ModeOf>& modes) {
  std::stable_sort(modes.begin(), modes.end(),
                   [](const ModeOf& a, const ModeOf& b) { return a.frequency < b.frequency; });
}

} // namespace

std::vector<ModeOf> sorted_modes(const std::vector<modal::Basis>& bases) {
  std::vector<ModeOf> modes;
  for (std::size_t s = 0; s < bases.size(); ++s)
    add(s, bases[s], 0, bases[s].true_modes(), modes);
  sort(modes);
  return modes;
}

std::vector<ModeOf> sorted_static_modes(const std::vector<modal::Basis>& bases) {
  std::vector<ModeOf> modes;
  for (std::size_t s = 0; s < bases.size(); ++s)
    add(s, bases[s], bases[s].true_modes(), bases[s].static_modes, modes);
  sort(modes);
  return modes;
}

TransientTotals add_up(const std::vector<TransientFacts>& transients) {
  assert(!transients.empty());
  TransientTotals sum;
  std::vector<std::string> schemes;
  sum.end_time = transients[0].report.end_time;
  for (const TransientFacts& one : transients) {
    const transient::StepChoice& choice = one.choice;
    const transient::Report& report = one.report;
    const std::string scheme = transient::name_of(choice.scheme);
    if (std::find(schemes.begin(), schemes.end(), scheme) == schemes.end()) {
      sum.scheme += (schemes.empty() ? "" : ", ") + scheme;
      schemes.push_back(scheme);
    }
    sum.steps += report.counts.steps;
    sum.evaluations += report.counts.evaluations;
    sum.rejected += report.counts.rejected;
    sum.unconverged += report.counts.unconverged;
    if (sum.step_min == 0.0 || report.counts.step_min < sum.step_min) {
      sum.step_min = report.counts.step_min;
      sum.step_reason = choice.reason;
      sum.scheme_reason = choice.scheme_reason;
    }
    sum.step_max = std::max(sum.step_max, report.counts.step_max);
    sum.contact_frequency = std::max(sum.contact_frequency, choice.contact_frequency);
    const double h = report.counts.step_max;
    Resolution& r = sum.resolution;
    r.contact = std::max(r.contact, choice.contact_frequency * h);
    r.stick = std::max(r.stick, choice.stick_frequency * h);
    r.structure = std::max(r.structure, choice.structure_frequency * h);
    r.damper = std::max(r.damper, choice.damper_rate * h);
    r.highest_mode = std::max(r.highest_mode, choice.highest_mode * h);
    sum.scaled_modes += choice.scaled;
    if (const double hz = choice.fastest / (2.0 * std::numbers::pi); hz > 0.0)
      sum.fastest_hz = sum.fastest_hz > 0.0 ? std::min(sum.fastest_hz, hz) : hz;
    sum.diverged = sum.diverged || report.outcome == transient::Outcome::diverged;
    sum.end_time = std::min(sum.end_time, report.end_time);
    const transient::Energy& e = report.energy;
    sum.energy.initial += e.initial;
    sum.energy.input += e.initial + e.load_work;
    sum.energy.fluid += e.fluid_work;
    sum.energy.stored += e.stored;
    sum.energy.modal_damping += e.modal_damping;
    sum.energy.contact_damping += e.contact_damping;
    sum.energy.friction += e.friction;
    // a NaN must stay: std::max would drop it
    if (!std::isnan(sum.energy.residual_relative) &&
        !(report.residual_relative <= sum.energy.residual_relative))
      sum.energy.residual_relative = report.residual_relative;
  }
  return sum;
}

std::vector<std::string> all_warnings(const RunResults& results) {
  std::vector<std::string> all = results.warnings;
  for (const TransientFacts& transient : results.transients)
    for (const std::string& warning : transient.choice.warnings)
      if (std::find(all.begin(), all.end(), warning) == all.end())
        all.push_back(warning);
  return grouped_messages(all);
}

std::vector<std::string> all_notes(const RunResults& results) { return grouped_messages(results.notes); }

} // namespace fretwork::results
