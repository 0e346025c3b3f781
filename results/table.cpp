// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/contact_table.hpp"
#include "results/error_estimate.hpp"
#include "results/figures.hpp"
#include "results/flow_text.hpp"
#include "results/force_results.hpp"
#include "results/text_file.hpp"
#include "results/totals.hpp"
#include "results/wear_json.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numeric>

namespace fretwork::results {
namespace {

constexpr std::size_t text_width = 88; // of what follows the labels: about 100 columns in all
constexpr std::size_t name_width = 20; // of a contact
constexpr std::size_t most_lacking = 3;
constexpr double least_missing = 1e-3; // flexibility times stiffness of a contact from which on it is shown
constexpr std::size_t most_frequencies = 8;
constexpr std::size_t most_warnings = 5;
constexpr std::size_t most_notes = 3;
constexpr std::size_t most_motions = 6;

/// Lines with a label in the first column: `  label      text`.
class Lines {
public:
  void add(const std::string& label, const std::string& text) {
    const std::vector<std::string> parts = wrapped(text, text_width);
    for (std::size_t i = 0; i < parts.size(); ++i)
      row(i == 0 ? label : "", parts[i]);
  }
  void row(const std::string& label, const std::string& text) {
    text_ += fmt::format("  {:<11} {}\n", label, text);
  }
  void plain(const std::string& line) { text_ += line + '\n'; }
  [[nodiscard]] std::string text() && { return std::move(text_); }

private:
  std::string text_;
};

std::string modes_text(const std::vector<modal::Basis>& bases) {
  const std::vector<ModeOf> modes = sorted_modes(bases);
  if (modes.empty())
    return "none";
  std::string text = fmt::format("{}", modes.size());
  if (bases.size() > 1)
    text += fmt::format(" of {} structures", bases.size());
  text += ":";
  for (std::size_t k = 0; k < std::min(most_frequencies, modes.size()); ++k)
    text += fmt::format(" {:.5g}", modes[k].frequency);
  if (modes.size() > most_frequencies)
    text += fmt::format(" ... {:.5g}", modes.back().frequency);
  double residual = 0.0;
  for (const modal::Basis& basis : bases)
    if (basis.true_modes() > 0)
      residual = std::max(residual, basis.residuals.head(basis.true_modes()).maxCoeff());
  return text + fmt::format(" Hz (largest residual {:.0e})", residual);
}

std::string closed_text(const std::vector<double>& frequencies) {
  std::string text;
  for (std::size_t k = 0; k < std::min(most_frequencies, frequencies.size()); ++k)
    text += fmt::format("{:.5g} ", frequencies[k]);
  return text + "Hz with the contacts on fixed obstacles closed (springs of K_N and, with friction, K_T)";
}

/// Contacts whose modes lack flexibility beside their own, the worst first.
void add_flexibility(Lines& lines, const RunResults& results) {
  std::vector<std::pair<double, const ContactFacts*>> lacking;
  for (const ContactFacts& c : results.contacts)
    if (c.static_flexibility && c.static_flexibility->missing * c.normal_stiffness > least_missing)
      lacking.emplace_back(c.static_flexibility->missing * c.normal_stiffness, &c);
  if (lacking.empty())
    return;
  std::stable_sort(lacking.begin(), lacking.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const std::size_t shown = std::min(most_lacking, lacking.size());
  lines.plain(fmt::format("  {:<34} {:>12} {:>12} {:>12} {:>12}",
                          shown < lacking.size()
                              ? fmt::format("static flexibility, worst {} of {}", shown, lacking.size())
                              : "static flexibility",
                          "exact m/N", "modes m/N", "missing m/N", "missing K_N"));
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [product, c] = lacking[i];
    lines.plain(fmt::format("  {:<34} {:>12.4g} {:>12.4g} {:>12.3g} {:>12.2g}",
                            shortened(c->name, name_width), c->static_flexibility->exact,
                            c->static_flexibility->basis, c->static_flexibility->missing, product));
  }
  lines.plain("");
}

/// Of the input: an energy at the start that is given separately.
constexpr double least_initial = 1e-3;

std::string energy_text(const EnergyTotals& e) {
  const auto shown = [&](double part) {
    return fmt::format("{:.4g}", without_round_off(part, std::max(std::abs(e.input), std::abs(e.stored))));
  };
  const bool apart = std::abs(e.initial) > least_initial * std::max(std::abs(e.input), std::abs(e.stored));
  const std::string start =
      apart ? fmt::format("loads {} J + at the start {}", shown(e.input - e.initial), shown(e.initial))
            : "input " + shown(e.input);
  const std::string fluid = e.fluid == 0.0 ? "" : " + fluid " + shown(e.fluid);
  return fmt::format(
      "{} J{} = stored {} + modal damping {} + contact damping {} + friction {}; balanced to {:.1e}", start,
      fluid, shown(e.stored), shown(e.modal_damping), shown(e.contact_damping), shown(e.friction),
      e.residual_relative);
}

/// The sums over contacts, and the one figure that differs most where one does.
void add_verification(Lines& lines, const RunResults& results) {
  const Verification& v = *results.verification;
  if (!v.failure.empty())
    return lines.add("verified", "no: " + v.failure);
  const Disagreement found = disagreement(v, results.contacts);
  lines.add("verified",
            fmt::format("at half the step ({:.3g} s): {} of {} figures agree within {:.2g} "
                        "standard errors (sums {:.2g}) + {:.2g} % (half the accuracy)",
                        v.step_max, found.compared - found.differ, found.compared, v.factor,
                        post::factor_of_sums, 100.0 * results.accuracy * post::least_share_shown));
  lines.row("", fmt::format("{:<22} {:>11} {:>13} {:>11} {:>15}", "all contacts", "this run", "at half step",
                            "difference", "standard error"));
  for (const post::ComparedFigure& f : v.sums)
    lines.row("", fmt::format("{:<22} {:>11.4g} {:>13.4g} {:>11.2g} {:>15.2g}{}", f.name, f.value, f.at_half,
                              f.difference(), f.error, f.agrees ? "" : "  differs"));
}

constexpr double standard_gravity = 9.80665; // m/s2

} // namespace

std::string motion_text(const MotionFacts& m) {
  std::string text = fmt::format(
      "{}: largest acceleration {} m/s2 ({} g) at {:.4g} s, largest displacement {} m", m.name,
      figure(m.largest, 4), figure(m.largest / standard_gravity, 3), m.time, figure(m.displacement, 3));
  if (m.rows > 1)
    text += fmt::format("; table of {} rows from {:.4g} to {:.4g} s", grouped(m.rows), m.record_from,
                        m.record_to);
  return text;
}

namespace {

void add_transient(Lines& lines, const RunResults& results) {
  for (std::size_t k = 0; k < std::min(most_motions, results.motions.size()); ++k)
    lines.add(k == 0 ? "motion" : "", motion_text(results.motions[k]));
  const TransientTotals t = add_up(results.transients);
  const std::string step = t.step_max > t.step_min ? fmt::format("{:.3g} to {:.3g}", t.step_min, t.step_max)
                                                   : fmt::format("{:.3g}", t.step_min);
  lines.add("transient",
            fmt::format("{:.6g} s, statistics from {:.6g} s; {}, {} steps of {} s", results.duration,
                        results.statistics_from, t.scheme, grouped(t.steps), step));
  lines.add("step", t.step_reason);
  if (!t.scheme_reason.empty())
    lines.add("scheme", t.scheme_reason);
  if (t.diverged)
    lines.add("DIVERGED",
              fmt::format("at {:.6g} s: the numbers below are of no use; take a smaller step", t.end_time));
  if (t.unconverged > 0)
    lines.add("contacts", fmt::format("{} of {} steps left contact forces that kept on changing",
                                      grouped(t.unconverged), grouped(t.steps)));
  if (!results.contact_summaries.empty()) {
    lines.plain("");
    for (const std::string& line : contact_lines(results))
      lines.plain(line);
    lines.plain("");
  }
  for (const auto& table : {node_lines(results), force_lines(results)}) {
    for (const std::string& line : table)
      lines.plain(line);
    if (!table.empty())
      lines.plain("");
  }
  add_flexibility(lines, results);
  if (results.wear) {
    for (const std::string& line : wear_lines(*results.wear))
      lines.plain(line);
    lines.plain("");
  }
  lines.add("energy", energy_text(t.energy));
  for (const std::string& line : law_motion_lines(results))
    lines.add("law", line);
  if (results.verification)
    add_verification(lines, results);
  lines.add("error", error_estimate(results).text);
}

void add_messages(Lines& lines, const std::string& label, const std::vector<std::string>& messages,
                  std::size_t most) {
  for (std::size_t i = 0; i < std::min(most, messages.size()); ++i)
    lines.add(label, messages[i]);
  if (messages.size() > most)
    lines.add("", fmt::format("and {} more in summary.json", messages.size() - most));
}

std::string timings_text(const RunResults& results) {
  const Timings& t = results.timings;
  std::string text = fmt::format("{:.3g} s", t.total);
  const char* separator = ": ";
  const std::pair<const char*, double> stages[] = {
      {"reading", t.read}, {"mesh", t.mesh},           {"matrices", t.assembly}, {"modes", t.modes},
      {"basis", t.basis},  {"transient", t.transient}, {"output", t.output}};
  for (const auto& [name, seconds] : stages)
    if (seconds >= 0.01 * t.total && seconds > 0.0) {
      text += fmt::format("{}{} {:.2g}", separator, name, seconds);
      separator = ", ";
    }
  return text + (results.record.ranks > 1 ? fmt::format(" ({} ranks)", results.record.ranks) : "");
}

} // namespace

std::string terminal_table(const RunResults& results, const std::filesystem::path& directory) {
  Lines lines;
  if (!results.record.title.empty())
    lines.plain(results.record.title);
  const ModelFacts& m = results.model;
  lines.add("model", fmt::format("{}, {}, {}, {:.4g} kg", counted(m.nodes, "node"),
                                 counted(m.elements, "beam"), counted(m.dofs, "free dof"), m.mass_kg));
  lines.add("modes", modes_text(results.bases));
  if (!results.closed_frequencies.empty())
    lines.add("on contacts", closed_text(results.closed_frequencies));
  if (!results.transients.empty())
    add_transient(lines, results);
  add_messages(lines, "warning", all_warnings(results), most_warnings);
  add_messages(lines, "note", all_notes(results), most_notes);
  lines.add("time", timings_text(results));
  if (!directory.empty())
    lines.row("results", directory.string());
  return std::move(lines).text();
}

} // namespace fretwork::results
