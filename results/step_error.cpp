// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/step_error.hpp"
#include "core/names.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::results {
namespace {

/// Of what the busiest contact does: below, the error of a contact matters to nobody.
constexpr double negligible = 0.01;
constexpr std::size_t most_named = 5;
/// Of the accuracy and of the standard error of a statistic: what is known of its error by the step is to be less.
constexpr double uncertain = 3.0;

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

/// Of a statistic in its window, relative; NaN where there is none.
double standard_error(const post::ContactSummary& of, transient::ReplayedFigure figure) {
  switch (figure) {
  case transient::replayed_work:
    return of.error.work_rate / of.work_rate;
  case transient::replayed_friction:
    return of.error.friction_power / of.friction_power;
  default:
    return std::numeric_limits<double>::quiet_NaN();
  }
}

RelativeError relative(const transient::StepError& e, const Figure& figure) {
  const double per = transient::statistic_share(figure.of) / e.sums[figure.of];
  return {figure.name, per * e.errors[figure.of], per * e.spreads[figure.of]};
}

/// Contacts and figures whose error fulfils a condition, and the one that `size` finds largest; those that do next to nothing are left out.
struct Named {
  std::vector<std::string> contacts;
  std::string where;
  RelativeError worst{"", 0.0, 0.0};
};
template <class Condition, class Size>
Named named_where(const RunResults& results, const Condition& condition, const Size& size) {
  transient::StepError::Figures busiest{};
  for (const transient::StepError& of : results.step_errors)
    for (std::size_t k = 0; k < transient::replayed_figures; ++k)
      busiest[k] = std::max(busiest[k], of.sums[k]);
  Named out;
  for (std::size_t c = 0; c < results.step_errors.size(); ++c) {
    const transient::StepError& of = results.step_errors[c];
    bool any = false;
    for (const Figure& figure : figures) {
      if (!(of.sums[figure.of] > negligible * busiest[figure.of]))
        continue;
      const RelativeError e = relative(of, figure);
      if (!condition(c, figure.of, e))
        continue;
      if (!any)
        out.contacts.push_back(results.contacts[c].name);
      any = true;
      if (size(e) > size(out.worst)) {
        out.worst = e;
        out.where = results.contacts[c].name;
      }
    }
  }
  return out;
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

bool RelativeError::is_resolved() const { // nor is one that is 0 in every replay uncertain
  return std::abs(value) >= significance * standard_error;
}

double RelativeError::upper_bound() const { return std::abs(value) + significance * standard_error; }

double ErrorsOfSums::size() const {
  double out = 0.0;
  for (const auto& e : {largest, least_known, impacts})
    if (e)
      out = std::max({out, std::abs(e->value), e->standard_error});
  return out;
}

ErrorsOfSums errors_of_sums(const RunResults& results) {
  ErrorsOfSums out;
  for (const RelativeError& e : relative_errors(sum_of(results.step_errors))) {
    if (e.name != "work_rate" && e.name != "friction_power" && e.name != "impacts_per_second")
      continue;
    if (e.is_resolved() && (!out.largest || std::abs(e.value) > std::abs(out.largest->value)))
      out.largest = e;
    if (e.is_resolved())
      continue;
    if (e.name == "impacts_per_second")
      out.impacts = e;
    else if (!out.least_known || e.upper_bound() > out.least_known->upper_bound())
      out.least_known = e;
  }
  if (out.largest && out.least_known && out.least_known->upper_bound() <= out.largest->upper_bound())
    out.least_known.reset();
  for (const auto& other : {out.largest, out.least_known})
    if (other && out.impacts && out.impacts->upper_bound() <= other->upper_bound())
      out.impacts.reset();
  if ((out.least_known || out.impacts) && out.largest && out.largest->value == 0.0)
    out.largest.reset();
  return out;
}

std::string unmet_accuracy(const RunResults& results) {
  const Named unmet = named_where(
      results,
      [&](std::size_t, transient::ReplayedFigure, const RelativeError& e) {
        return std::abs(e.value) > results.accuracy + significance * e.standard_error;
      },
      [](const RelativeError& e) { return std::abs(e.value); });
  if (unmet.contacts.empty())
    return {};
  return fmt::format(
      "the step changes statistics of {} by more than the accuracy of {:.2g} %, most of all {} of "
      "\"{}\": {:+.2g} +- {:.1g} %; set a smaller transient.accuracy or transient.step",
      core::list_names(unmet.contacts, most_named), 100.0 * results.accuracy, unmet.worst.name, unmet.where,
      100.0 * unmet.worst.value, 100.0 * unmet.worst.standard_error);
}

std::string uncertain_errors(const RunResults& results) {
  const Named named = named_where(
      results,
      [&](std::size_t c, transient::ReplayedFigure figure, const RelativeError& e) {
        return e.standard_error > uncertain * results.accuracy &&
               e.standard_error > uncertain * standard_error(results.contact_summaries[c], figure);
      },
      [](const RelativeError& e) { return e.standard_error; });
  if (named.contacts.empty())
    return {};
  return fmt::format(
      "replays do not resolve the error by the step of {}: {} of \"{}\" {:+.2g} +- {:.2g} %; it "
      "may exceed the accuracy of "
      "{:.2g} %; run longer, or set a smaller transient.accuracy",
      core::list_names(named.contacts, most_named), named.worst.name, named.where, 100.0 * named.worst.value,
      100.0 * named.worst.standard_error, 100.0 * results.accuracy);
}

} // namespace fretwork::results
