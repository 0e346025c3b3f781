// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/judge_run.hpp"
#include "core/error.hpp"
#include "results/step_error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// Above this residual of the energy the results are not to be trusted, whatever they look like.
constexpr double residual_warning = 0.05;
/// What sound runs are balanced to, of the energy put in and of that taken up: the accuracy that the automatic step aims at. The 840 runs of 60 random
/// scenes by `splitting` (bench_accuracy, seed 90210) are so to 0.7 %.
constexpr double residual_of_sound = 0.01;
/// Of the work of loads to and fro, what counts.
constexpr double least_of_loads = 1e-3;
/// Likewise of the initial energy. Smaller: a preload may be ten thousand times what the motion dissipates.
constexpr double least_of_start = 1e-5;

/// Dampers of contacts that give back this share of the energy put in are no round-off.
constexpr double given_by_dampers = 0.01;

/// Of steps in which forces of contacts that move each other kept on changing.
std::string unconverged_warning(const transient::StepCounts& counts) {
  return fmt::format("in {} of {} steps ({:.2g} %) the forces of contacts that move each other kept on "
                     "changing; take a smaller step",
                     counts.unconverged, counts.steps,
                     100.0 * static_cast<double>(counts.unconverged) / static_cast<double>(counts.steps));
}

std::string cure_of_divergence(const study::Study& study, const transient::Report& report) {
  if (report.counts.unconverged > 0)
    return unconverged_warning(report.counts);
  return study.transient->step ? "take a smaller step, or leave step out to have one chosen"
                               : "take a smaller step than this automatic one";
}

/// J: what the motion took up of the energy put in, on modes, contacts and a fluid that damps, and what is stored more than at the start.
double taken_up(const transient::Energy& e) {
  const auto positive = [](double energy) { return std::max(0.0, energy); };
  return positive(e.modal_damping) + positive(e.contact_damping) + positive(e.friction) +
         positive(-e.fluid_work) + positive(e.stored - e.initial);
}

/// Of energy that is gained or lost without a cause: contacts, or what integrates the modes, then do otherwise than the laws say.
void judge_balance(const study::Study& study, const transient::StepChoice& choice,
                   const transient::Report& report, std::vector<std::string>& warnings) {
  const bool given = study.transient && study.transient->step;
  const char* cure = choice.scheme == transient::SchemeKind::runge_kutta_54
                         ? "set a smaller transient.tolerance"
                         : (given ? "take a smaller step" : "set a smaller transient.accuracy");
  const std::string balance = fmt::format("the energy balance is off by {:.3g} % of the energy put in",
                                          100.0 * report.residual_relative);
  if (report.residual_relative > residual_warning) { // what makes all figures wrong comes first
    warnings.insert(warnings.begin(),
                    fmt::format("{}: no figure of this run can be trusted; {}", balance, cure));
    return;
  }
  const std::string sound =
      fmt::format("a sound run is balanced to {:g} %; {}", 100.0 * residual_of_sound, cure);
  // loads that push to and fro put in far more than what the motion takes up
  const transient::Energy& e = report.energy;
  const double missing = e.residual(), taken = taken_up(e);
  const double least = least_of_loads * (e.scale - e.initial) + least_of_start * e.initial;
  if (e.dissipated() > least && std::abs(missing) > std::max(least, residual_of_sound * taken))
    warnings.push_back(fmt::format("the energy balance {} {:.3g} % of the energy dissipated and stored; {}",
                                   missing > 0.0 ? "lacks" : "has an excess of",
                                   100.0 * std::abs(missing) / taken, sound));
  else if (report.residual_relative > residual_of_sound)
    warnings.push_back(fmt::format("{}; {}", balance, sound));
}

void judge(const study::Study& study, const transient::StepChoice& choice, const transient::Report& report,
           results::RunResults& out) {
  for (const std::string& warning : choice.warnings)
    out.warnings.push_back(warning);
  if (report.outcome == transient::Outcome::diverged)
    throw core::ComputationError(fmt::format(
        "the transient diverged at t = {:.6g} s (scheme {}, step {:.3g} s): its energy has left all that was "
        "put in; {}",
        report.end_time, transient::name_of(choice.scheme), choice.step, cure_of_divergence(study, report)));
  if (report.outcome == transient::Outcome::step_failed)
    throw core::ComputationError(fmt::format("the transient stopped at t = {:.6g} s (scheme {}): {}",
                                             report.end_time, transient::name_of(choice.scheme),
                                             transient::name_of(report.failure)));
  judge_balance(study, choice, report, out.warnings);
  if (report.counts.unconverged > report.counts.steps / 1000)
    out.warnings.insert(out.warnings.begin(), unconverged_warning(report.counts));
}

/// Dampers that give energy: of friction that steps do not resolve, or of `reference`, whose spring is set by every slip and no work pays for it.
void judge_dampers(const BuiltScene& built, const transient::Report& report, results::RunResults& out) {
  const auto jumps = [](const transient::ContactPoint& point) {
    const contact::FrictionLaw& law = point.support.friction;
    return law.active() && law.kind == contact::FrictionMemoryKind::reference;
  };
  const auto& points = built.scene.contacts;
  const double input = std::abs(report.energy.initial + report.energy.load_work);
  if (!(report.energy.contact_damping < -given_by_dampers * input))
    return;
  const std::string given =
      fmt::format("the dampers of the contacts gave {:.2g} % of the energy put in instead of taking some",
                  -100.0 * report.energy.contact_damping / input);
  out.warnings.push_back(
      std::any_of(points.begin(), points.end(), jumps)
          ? "friction_memory = \"reference\": " + given +
                ", because that memory's springs jump in a slip; the energies of friction are not to be "
                "trusted, and the motion depends on scheme and step; take friction_memory = \"return_map\""
          : given + ": steps do not resolve their friction, whose energies are not to be trusted; set a "
                    "smaller transient.accuracy or transient.step");
}

} // namespace

void judge_run(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
               const transient::Report& report, results::RunResults& out) {
  judge(study, choice, report, out);
  judge_dampers(built, report, out);
}

transient::StepError without_round_off(transient::StepError error, const post::ContactSummary& of) {
  if (of.work_rate == 0.0)
    for (const std::size_t k : {transient::replayed_work, transient::replayed_friction})
      error.sums[k] = error.errors[k] = error.spreads[k] = 0.0;
  return error;
}

void judge_step_errors(results::RunResults& out) {
  if (std::string unmet = results::unmet_accuracy(out); !unmet.empty())
    out.warnings.push_back(std::move(unmet));
  else if (std::string uncertain = results::uncertain_errors(out); !uncertain.empty())
    out.warnings.push_back(std::move(uncertain));
}

void tell_impacts_left_out(std::int64_t kept, results::RunResults& out) {
  std::int64_t left_out = 0, tables = 0;
  for (const post::ContactImpacts& impacts : out.impacts) {
    left_out += impacts.left_out;
    tables += impacts.left_out > 0 ? 1 : 0;
  }
  if (left_out > 0)
    out.notes.push_back(fmt::format("the table{} of impacts of {} contact{} end{} after output.impacts = {} "
                                    "rows: {} later impacts have no row (the statistics count them); raise "
                                    "output.impacts, or start output.statistics_from later",
                                    tables == 1 ? "" : "s", tables, tables == 1 ? "" : "s",
                                    tables == 1 ? "s" : "", kept, left_out));
}

} // namespace fretwork::app
