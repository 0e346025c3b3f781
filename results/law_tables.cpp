// SPDX-License-Identifier: GPL-3.0-or-later
// Stability under the fluidelastic law of a flow: the table of the terminal, and the diagram as CSV.
#include "results/flow_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace fretwork::results {
namespace {

constexpr std::size_t most_crossings = 40;

/// A number, or a dash where there is none.
std::string or_dash(std::optional<double> value) { return value ? fmt::format("{:.4g}", *value) : "-"; }

/// Of a mode of the diagram; of several tubes with its tube.
std::string name_of(const LawStability& law, Eigen::Index mode) {
  if (mode < 0)
    return "lag";
  const LawStability::Mode& its = law.modes[static_cast<std::size_t>(mode)];
  return law.tubes.size() > 1 ? fmt::format("{}:{}", its.tube, its.number + 1)
                              : fmt::format("{}", its.number + 1);
}

std::string crossings_table(const LawStability& law) {
  const auto& crossings = law.diagram.crossings;
  if (crossings.empty())
    return "  no root crosses zero damping\n";
  std::string text = fmt::format("  {:>8} {:>9} {:>9} {:>9} {:>6}   {}\n", "factor", "V m/s", "Hz", "V/(f D)",
                                 "mode", "zero damping");
  for (std::size_t i = 0; i < std::min(most_crossings, crossings.size()); ++i) {
    const flow::Crossing& one = crossings[i];
    const double hertz = flow::frequency_of(one.root);
    const std::optional<double> reduced = law.reduced_velocity(one.factor, hertz);
    text += fmt::format("  {:>8.5g} {:>9.4g} {:>9.4g} {:>9} {:>6}   {}{}{}\n", one.factor,
                        one.factor * law.velocity, hertz, or_dash(reduced), name_of(law, one.mode),
                        one.to_unstable ? "becomes UNSTABLE" : "becomes stable",
                        hertz > 0.0 ? "" : " (divergence)",
                        reduced && law.outside(*reduced) ? ", outside the law's range" : "");
  }
  if (crossings.size() > most_crossings)
    text += fmt::format("  ... {} more in summary.json\n", crossings.size() - most_crossings);
  return text;
}

/// Row of the factor nearest to 1.
Eigen::Index working_point(const flow::StabilityDiagram& diagram) {
  const auto& factors = diagram.factors;
  return std::min_element(factors.begin(), factors.end(),
                          [](double a, double b) { return std::abs(a - 1.0) < std::abs(b - 1.0); }) -
         factors.begin();
}

std::string modes_under_law(const LawStability& law) {
  const Eigen::Index row = working_point(law.diagram);
  std::string text = fmt::format("  modes at factor {:g}\n  {:>5} {:>9} {:>10} {:>9} {:>10} {:>10}\n",
                                 law.diagram.factors[static_cast<std::size_t>(row)], "mode", "Hz",
                                 "damping %", "V/(f D)", "critical", "Connors");
  for (Eigen::Index mode = 0; mode < law.diagram.roots.cols(); ++mode) {
    const std::complex<double> root = law.diagram.roots(row, mode);
    const double hertz = flow::frequency_of(root),
                 connors = law.modes[static_cast<std::size_t>(mode)].connors;
    text +=
        fmt::format("  {:>5} {:>9.4g} {:>10.4f} {:>9} {:>10} {:>10}{}\n", name_of(law, mode), hertz,
                    100.0 * flow::damping_of(root),
                    or_dash(law.reduced_velocity(law.diagram.factors[static_cast<std::size_t>(row)], hertz)),
                    or_dash(law.critical_factor(mode)),
                    or_dash(std::isfinite(connors) ? std::optional(connors) : std::nullopt),
                    root.real() > 0.0 ? "  UNSTABLE" : "");
  }
  return text;
}

} // namespace

std::string law_table(const StabilityAssessment& assessment) {
  if (!assessment.law)
    return {};
  const LawStability& law = *assessment.law;
  return fmt::format("  fluidelastic law{}, factors {:g} to {:g} of {:.4g} m/s\n",
                     law.tubes.size() > 1 ? fmt::format(" of {} tubes", law.tubes.size()) : "",
                     law.diagram.factors.front(), law.diagram.factors.back(), law.velocity) +
         crossings_table(law) + modes_under_law(law);
}

std::string stability_diagram_csv(const RunResults& results) {
  std::string text;
  for (const StabilityAssessment& assessment : results.stability) {
    if (!assessment.law)
      continue;
    if (text.empty())
      text = "assessment,tube,mode,factor [1],velocity [m/s],frequency [Hz],damping [1],growth [1/s]\n";
    const flow::StabilityDiagram& diagram = assessment.law->diagram;
    for (Eigen::Index mode = 0; mode < diagram.roots.cols(); ++mode) {
      const LawStability::Mode& its = assessment.law->modes[static_cast<std::size_t>(mode)];
      for (Eigen::Index i = 0; i < diagram.roots.rows(); ++i) {
        const double factor = diagram.factors[static_cast<std::size_t>(i)];
        const std::complex<double> root = diagram.roots(i, mode);
        text += fmt::format("{},{},{},{},{},{},{},{}\n", quoted(assessment.name), quoted(its.tube),
                            its.number + 1, factor, factor * assessment.law->velocity,
                            flow::frequency_of(root), flow::damping_of(root), root.real());
      }
    }
  }
  return text;
}

} // namespace fretwork::results
