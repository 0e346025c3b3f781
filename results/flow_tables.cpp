// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/flow_text.hpp"
#include "results/text_file.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <numeric>

namespace fretwork::results {
namespace {

constexpr std::size_t most_rows = 20, most_cases = 20, most_names = 8;
constexpr int widest_direction = 12;
constexpr std::size_t widest_name = 40, widest_tube = 12; // of an assessment and its tube; of a tube

/// K of the zones that have one: `water 3, steam 2.4`.
std::string constants_text(const flow::StabilityCase& one, const StabilityAssessment& assessment,
                           const char* between = ", ") {
  std::string text;
  for (std::size_t z = 0; z < one.constants.size(); ++z)
    if (one.constants[z] > 0.0)
      text += fmt::format("{}{} {:g}", text.empty() ? "" : between, assessment.damping.zones[z],
                          one.constants[z]);
  return text.empty() ? "no flow" : text;
}

std::string case_row(std::size_t number, const flow::StabilityCase& one,
                     const StabilityAssessment& assessment) {
  if (!one.margin())
    return fmt::format("  {:>5}   not assessed: no mode moves in a velocity across the tube\n", number + 1);
  const double scale = one.critical_scale();
  return fmt::format("  {:>5} {:>9} {:>9.4g} {:>9.4f} {:>9.4f} {:>9.4g}   {}\n", number + 1,
                     one.critical_mode + 1,
                     assessment.stability.modes[static_cast<std::size_t>(one.critical_mode)].frequency,
                     1.0 - *one.margin(), *one.margin(), scale, constants_text(one, assessment));
}

std::string cases_table(const StabilityAssessment& assessment) {
  const auto& cases = assessment.stability.cases;
  std::string text = fmt::format("  {:>5} {:>9} {:>9} {:>9} {:>9} {:>9}   {}\n", "case", "crit.mode", "Hz",
                                 "V/Vc", "margin", "scale", "Connors constants");
  for (std::size_t k = 0; k < std::min(most_cases, cases.size()); ++k)
    text += case_row(k, cases[k], assessment);
  if (cases.size() > most_cases)
    text += fmt::format("  ... {} more in stability.csv\n", cases.size() - most_cases);
  return text;
}

/// The modes nearest to instability, by their numbers.
std::vector<std::size_t> nearest_modes(const flow::StabilityCase& one) {
  std::vector<std::size_t> modes(static_cast<std::size_t>(one.ratio.size()));
  std::iota(modes.begin(), modes.end(), std::size_t{0});
  std::stable_sort(modes.begin(), modes.end(), [&](std::size_t a, std::size_t b) {
    return one.ratio(static_cast<Eigen::Index>(a)) > one.ratio(static_cast<Eigen::Index>(b));
  });
  modes.resize(std::min(most_rows, modes.size()));
  std::sort(modes.begin(), modes.end());
  return modes;
}

/// Ratios to critical as a row of %: of each term, and of their sum as the set of stability has it.
std::string terms_text(const flow::DampingTerms& t) {
  return fmt::format(" {:>8.4f} {:>9.4f} {:>8.4f} {:>8.4f} {:>8.4f}", 100.0 * t.viscous, 100.0 * t.two_phase,
                     100.0 * t.squeeze_film, 100.0 * t.friction, 100.0 * t.gas);
}

const std::string heads_of_terms =
    fmt::format(" {:>8} {:>9} {:>8} {:>8} {:>8}", "viscous", "two-phase", "squeeze", "friction", "gas");

std::string case_modes(const StabilityAssessment& assessment, std::size_t number) {
  const flow::StabilityCase& one = assessment.stability.cases[number];
  const bool by_flow = !assessment.damping_given;
  const auto modes = static_cast<std::size_t>(one.ratio.size());
  const std::vector<std::size_t> shown = nearest_modes(one);
  std::string text = fmt::format(
      "  modes of case {}{}\n  {:>5} {:>9} {:>{}} {:>10} {:>10} {:>9} {:>10}{}\n", number + 1,
      shown.size() < modes ? fmt::format(", the {} nearest to instability", most_rows) : std::string(),
      "mode", "Hz", "moves", widest_direction, "V_eff m/s", "V_c m/s", "V/Vc", "damping %",
      by_flow ? heads_of_terms : std::string());
  for (const std::size_t i : shown) {
    const auto k = static_cast<Eigen::Index>(i);
    const flow::ModeInFlow& mode = assessment.stability.modes[i];
    if (one.ratio(k) == 0.0) { // it moves along the tube, or where nothing flows
      text += fmt::format("  {:>5} {:>9.4g} {:>{}} {:>10} {:>10} {:>9} {:>10}  not in the flow\n", i + 1,
                          mode.frequency, flow::short_text(assessment.directions[i]), widest_direction, "-",
                          "-", "-", "-");
      continue;
    }
    text += fmt::format("  {:>5} {:>9.4g} {:>{}} {:>10.4g} {:>10.4g} {:>9.4f} {:>10.4f}{}{}\n", i + 1,
                        mode.frequency, flow::short_text(assessment.directions[i]), widest_direction,
                        mode.effective_velocity, one.critical_velocity(k), one.ratio(k), 100.0 * mode.damping,
                        by_flow ? terms_text(assessment.damping.damping.modes[i].sum) : std::string(),
                        one.ratio(k) >= 1.0 ? "  UNSTABLE" : "");
  }
  if (shown.size() < modes)
    text += fmt::format("  ... {} more in stability.csv\n", modes - shown.size());
  return text;
}

/// A row for the worst case of each assessment, the nearest to instability first; empty of a single one.
std::string assessments_table(const std::vector<StabilityAssessment>& assessments) {
  std::vector<std::pair<double, std::string>> rows;
  for (const StabilityAssessment& one : assessments) {
    if (one.stability.modes.empty())
      continue;
    const flow::StabilityCase& worst = one.stability.cases[worst_case(one.stability)];
    const std::string tube = shortened(one.damping.tube, widest_tube);
    const std::string name = shortened(one.name, widest_name - 2 - tube.size()) + ", " + tube;
    if (!worst.margin()) {
      rows.emplace_back(
          std::numeric_limits<double>::infinity(),
          fmt::format("  {:<{}} not assessed: no velocity across the tube\n", name, widest_name));
      continue;
    }
    const double margin = *worst.margin();
    const flow::ModeInFlow& mode = one.stability.modes[static_cast<std::size_t>(worst.critical_mode)];
    rows.emplace_back(
        worst.critical_scale(),
        fmt::format("  {:<{}} {:>5} {:>9.4g} {:>{}} {:>10.4f} {:>9.4f} {:>9.4f}{}\n", name, widest_name,
                    worst.critical_mode + 1, mode.frequency,
                    flow::short_text(one.directions[static_cast<std::size_t>(worst.critical_mode)]),
                    widest_direction, 100.0 * mode.damping, 1.0 - margin, margin,
                    margin <= 0.0 ? "  UNSTABLE" : ""));
  }
  if (rows.size() < 2)
    return {};
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text =
      fmt::format("Stability by Connors: the critical mode of each assessment and tube\n  {:<{}} {:>5} {:>9} "
                  "{:>{}} {:>10} {:>9} {:>9}\n",
                  "assessment, tube", widest_name, "mode", "Hz", "moves", widest_direction, "damping %",
                  "V/Vc", "margin");
  for (const auto& [scale, row] : rows)
    text += row;
  return text;
}

std::string sweep_line(const StabilityAssessment& assessment, std::size_t number) {
  if (!assessment.stability.cases[number].margin())
    return {};
  const Eigen::MatrixXd sweep = flow::velocity_sweep(assessment.stability.cases[number], assessment.sweep);
  std::string text = "  velocities times";
  for (Eigen::Index k = 0; k < sweep.rows() && sweep.cols() > 0; ++k)
    text += fmt::format("{} {:g}: V/Vc {:.4f}, {} unstable", k ? ";" : "",
                        assessment.sweep[static_cast<std::size_t>(k)], sweep.row(k).maxCoeff(),
                        (sweep.row(k).array() >= 1.0).count());
  return text + "\n";
}

} // namespace

std::size_t worst_case(const flow::Stability& stability) {
  const auto scale = [](const flow::StabilityCase& one) { return one.critical_scale(); };
  const auto& cases = stability.cases;
  return static_cast<std::size_t>(
      std::min_element(cases.begin(), cases.end(),
                       [&](const auto& a, const auto& b) { return scale(a) < scale(b); }) -
      cases.begin());
}

std::string pinned_text(const std::vector<std::string>& names) {
  if (names.empty())
    return "nothing pinned";
  std::string text = "pinned at ";
  for (std::size_t k = 0; k < std::min(most_names, names.size()); ++k)
    text += (k ? ", " : "") + names[k];
  if (names.size() > most_names)
    text += fmt::format(" and {} more", names.size() - most_names);
  return text;
}

std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string flow_damping_table(const RunResults& results) {
  std::string text;
  for (const TubeDamping& tube : results.flow_damping) {
    text += fmt::format(
        "Damping of tube \"{}\" by its flow, %: {} spans, the longest of {:.4g} m on average; modes of "
        "the transient, with its contacts open\n",
        tube.tube, tube.damping.layout.spans, tube.damping.layout.mean_span);
    text +=
        fmt::format("  {:>5} {:>9}{} {:>9} {:>9}\n", "mode", "Hz", heads_of_terms, "stability", "transient");
    const auto& modes = tube.damping.modes;
    for (std::size_t i = 0; i < std::min(most_rows, modes.size()); ++i) {
      text += fmt::format("  {:>5} {:>9.4g}{} {:>9.4f} {:>9.4f}{}\n", i + 1,
                          tube.frequency(static_cast<Eigen::Index>(i)), terms_text(modes[i].sum),
                          100.0 * modes[i].stability, 100.0 * modes[i].transient,
                          modes[i].assessed ? "" : "  not across the tube");
    }
    if (modes.size() > most_rows)
      text += fmt::format("  ... {} more in summary.json\n", modes.size() - most_rows);
  }
  return text;
}

std::string stability_table(const RunResults& results) {
  std::string text = assessments_table(results.stability);
  for (const StabilityAssessment& assessment : results.stability) {
    text += fmt::format("Stability \"{}\" of tube \"{}\", {}{}{}\n", assessment.name, assessment.damping.tube,
                        pinned_text(assessment.pinned), assessment.elastic ? ", elastic" : "",
                        assessment.sticking ? ", sticking" : "");
    if (assessment.stability.modes.empty()) {
      text += "  no modes up to the limit of [modes]\n";
      continue;
    }
    const std::size_t worst = worst_case(assessment.stability);
    text += cases_table(assessment) + case_modes(assessment, worst) + sweep_line(assessment, worst) +
            law_table(assessment);
  }
  return text;
}

void write_stability_csv(const std::filesystem::path& folder, const RunResults& results) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "assessment,tube,case,connors_constants,mode,frequency [Hz],direction,direction_share "
                 "[1],damping [1],decrement [1],"
                 "effective_velocity [m/s],critical_velocity [m/s],ratio [1],margin [1],critical_scale [1],"
                 "viscous_damping [1],two_phase_damping [1],squeeze_film_damping [1],friction_damping [1],"
                 "gas_damping [1]\n");
  for (const StabilityAssessment& assessment : results.stability)
    for (std::size_t c = 0; c < assessment.stability.cases.size(); ++c) {
      const flow::StabilityCase& one = assessment.stability.cases[c];
      for (Eigen::Index i = 0; i < one.ratio.size(); ++i) {
        const flow::ModeInFlow& mode = assessment.stability.modes[static_cast<std::size_t>(i)];
        const flow::DampingTerms& t = assessment.damping.damping.modes[static_cast<std::size_t>(i)].sum;
        const flow::ModeDirection& direction = assessment.directions[static_cast<std::size_t>(i)];
        const char* along = flow::key_of(direction.kind);
        fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                       quoted(assessment.name), quoted(assessment.damping.tube), c + 1,
                       quoted(constants_text(one, assessment, "; ")), i + 1, mode.frequency,
                       along ? along : "", direction.share, mode.damping, mode.decrement,
                       mode.effective_velocity, one.critical_velocity(i), one.ratio(i), 1.0 - one.ratio(i),
                       1.0 / one.ratio(i), t.viscous, t.two_phase, t.squeeze_film, t.friction, t.gas);
      }
    }
  write_text(folder / "stability.csv", {text.data(), text.size()});
  const std::filesystem::path diagram = folder / "stability_diagram.csv";
  std::error_code absent; // one of an earlier state of the study, with a law
  if (const std::string text_of_laws = stability_diagram_csv(results); !text_of_laws.empty())
    write_text(diagram, text_of_laws);
  else
    std::filesystem::remove(diagram, absent);
}

} // namespace fretwork::results
