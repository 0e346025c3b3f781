// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/step_error.hpp"
#include "core/names.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

/// By how many standard errors an error is to stand out.
constexpr double significance = 2.0;
/// Of what the busiest contact does: below, the error of a contact matters to nobody.
constexpr double negligible = 0.01;
constexpr std::size_t most_named = 5;

struct Figure {
  transient::ReplayedFigure of;
  const char* name;
};
constexpr Figure figures[] = {{transient::replayed_work, "work_rate"},
                              {transient::replayed_friction, "friction_power"},
                              {transient::replayed_square, "normal_force_rms"},
                              {transient::replayed_impulse, "normal_force_mean"},
                              {transient::replayed_closed_time, "contact_time_ratio"},
                              {transient::replayed_impacts, "impacts_per_second"}};

RelativeError relative(const transient::StepError& e, const Figure& figure) {
  const double per = transient::statistic_share(figure.of) / e.sums[figure.of];
  return {figure.name, per * e.errors[figure.of], per * e.spreads[figure.of]};
}

} // namespace

std::vector<RelativeError> relative_errors(const transient::StepError& of) {
  std::vector<RelativeError> out;
  for (const Figure& figure : figures)
    if (of.sums[figure.of] > 0.0)
      out.push_back(relative(of, figure));
  return out;
}

transient::StepError sum_of(const std::vector<transient::StepError>& contacts) {
  transient::StepError out;
  for (const transient::StepError& of : contacts) {
    out.parts = std::max(out.parts, of.parts);
    for (std::size_t k = 0; k < transient::replayed_figures; ++k) {
      out.sums[k] += of.sums[k];
      out.errors[k] += of.errors[k];
      out.spreads[k] = std::hypot(out.spreads[k], of.spreads[k]);
    }
  }
  return out;
}

std::optional<RelativeError> largest_error_of_sums(const RunResults& results) {
  std::optional<RelativeError> out;
  for (const RelativeError& e : relative_errors(sum_of(results.step_errors))) {
    const bool summed = e.name == "work_rate" || e.name == "friction_power" || e.name == "impacts_per_second";
    if (summed && (!out || std::abs(e.value) > std::abs(out->value)))
      out = e;
  }
  return out;
}

std::string unmet_accuracy(const RunResults& results) {
  transient::StepError::Figures busiest{};
  for (const transient::StepError& of : results.step_errors)
    for (std::size_t k = 0; k < transient::replayed_figures; ++k)
      busiest[k] = std::max(busiest[k], of.sums[k]);
  std::vector<std::string> names;
  std::string where;
  RelativeError worst{"", 0.0, 0.0};
  for (std::size_t c = 0; c < results.step_errors.size(); ++c) {
    const transient::StepError& of = results.step_errors[c];
    bool unmet = false;
    for (const Figure& figure : figures) {
      if (!(of.sums[figure.of] > negligible * busiest[figure.of]))
        continue;
      const RelativeError e = relative(of, figure);
      if (!(std::abs(e.value) > results.accuracy + significance * e.standard_error))
        continue;
      unmet = true;
      if (std::abs(e.value) > std::abs(worst.value)) {
        worst = e;
        where = results.contacts[c].name;
      }
    }
    if (unmet)
      names.push_back(results.contacts[c].name);
  }
  if (names.empty())
    return {};
  return fmt::format(
      "the step changes statistics of {} by more than the accuracy of {:.2g} %, most of all {} of "
      "\"{}\": {:+.2g} +- {:.1g} %; set a smaller transient.accuracy or transient.step",
      core::list_names(names, most_named), 100.0 * results.accuracy, worst.name, where, 100.0 * worst.value,
      100.0 * worst.standard_error);
}

} // namespace fretwork::results
