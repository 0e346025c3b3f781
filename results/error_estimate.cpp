// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/error_estimate.hpp"
#include "results/step_error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::results {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double sum(const RunResults& results, double post::ContactSummary::*figure) {
  double out = 0.0;
  for (const post::ContactSummary& contact : results.contact_summaries)
    out += contact.*figure;
  return out;
}

/// The larger of what is known; a figure that is 0 in both runs has no relative error.
double larger(double known, double error, double scale) {
  if (!(scale > 0.0) || std::isnan(error))
    return known;
  return std::isnan(known) ? error / scale : std::max(known, error / scale);
}

double relative_scatter(const RunResults& results) {
  const post::StandardErrors& e = results.errors_of_sums;
  double out = larger(nan, e.work_rate, sum(results, &post::ContactSummary::work_rate));
  out = larger(out, e.friction_power, sum(results, &post::ContactSummary::friction_power));
  return larger(out, e.impact_rate, sum(results, &post::ContactSummary::impact_rate));
}

/// Largest error of the run by its step that the differences allow.
double relative_step_error(const Verification& verification) {
  double out = nan;
  for (const post::ComparedFigure& f : verification.sums)
    out = larger(out, std::abs(f.difference()) / post::least_share_shown,
                 std::max(std::abs(f.value), std::abs(f.at_half)));
  return out;
}

} // namespace

namespace {

/// 3.6, 15, 104: two digits, more where there are more before the point; of little more than nothing, over 1000.
std::string percent(double share) {
  if (share > 10.0)
    return "over 1000";
  return fmt::format(fmt::runtime(share < 0.995 ? "{:.2g}" : "{:.0f}"), 100.0 * share);
}

/// A standard error, or a bound of an error, above this share of the figure says little.
constexpr double says_little = 0.3;

/// The scatter of a window, and that it says little where it is large. Where nothing slides it is that of the impacts alone.
std::string scatter_text(const RunResults& results, double scatter) {
  const bool slides = sum(results, &post::ContactSummary::work_rate) > 0.0;
  return percent(scatter) + " % standard error of " +
         (slides ? "this window" : "the rate of impacts in this window (there is no work of sliding)") +
         (scatter > says_little ? ", which is too short for statistics or holds no stationary motion" : "");
}

/// The largest error that replays resolve, and bounds of those that may be larger. An error whose bound says little is unknown; a bound above the figure itself is none.
std::string step_text(const ErrorsOfSums& errors) {
  std::string known, unknown;
  const auto join = [](std::string& text, const std::string& more) {
    text += (text.empty() ? "" : " and ") + more;
  };
  if (const auto& e = errors.largest)
    join(known,
         fmt::format("{} by {} +- {} %", e->name, percent(std::abs(e->value)), percent(e->standard_error)));
  for (const auto& e : {errors.least_known, errors.impacts})
    if (e && e->upper_bound() > says_little)
      join(unknown, e->upper_bound() > 1.0
                        ? e->name
                        : fmt::format("{} (below {} %)", e->name, percent(e->upper_bound())));
    else if (e)
      join(known, fmt::format("{} by less than {} %", e->name, percent(e->upper_bound())));
  if (!known.empty())
    known = "; the step changes " + known + " over all contacts (replays)";
  if (!unknown.empty())
    known += "; by how much the step changes " + unknown + " is unknown (replays, which scatter too much)";
  return known;
}

} // namespace

std::string name_of(ErrorKind kind) {
  switch (kind) {
  case ErrorKind::none:
    return "none";
  case ErrorKind::statistical:
    return "statistical";
  case ErrorKind::measured:
    return "measured";
  case ErrorKind::verified:
    return "verified";
  }
  return {};
}

ErrorEstimate error_estimate(const RunResults& results) {
  if (results.contacts.empty())
    return {ErrorKind::none, nan, "none: there are no contacts, whose statistics would be compared"};
  if (const auto& verification = results.verification; verification && verification->failure.empty()) {
    const Disagreement found = disagreement(*verification, results.contacts);
    const double of_step = relative_step_error(*verification), scatter = relative_scatter(results);
    const double relative = std::isnan(scatter) ? of_step : std::hypot(of_step, scatter);
    return {ErrorKind::verified, relative,
            fmt::format("{} of {} figures agree with those at half the step{}", found.compared - found.differ,
                        found.compared,
                        std::isnan(of_step)
                            ? ""
                            : fmt::format(", the step changes sums over contacts {}{}",
                                          of_step > 1.0 ? "by more than their size"
                                                        : "by at most " + percent(of_step) + " %",
                                          std::isnan(scatter) ? "" : ", " + scatter_text(results, scatter)))};
  }
  const double relative = relative_scatter(results);
  if (std::isnan(relative))
    return {ErrorKind::none, nan,
            "none: no impacts in the window of the statistics, or steps too few for batches; "
            "transient.verify = true compares with half the step"};
  if (const ErrorsOfSums of_step = errors_of_sums(results); of_step.measured())
    return {ErrorKind::measured, std::hypot(relative, of_step.size()),
            scatter_text(results, relative) + step_text(of_step)};
  return {ErrorKind::statistical, relative,
          scatter_text(results, relative) + "; that of the step is unknown (transient.verify)"};
}

Disagreement disagreement(const Verification& verification, const std::vector<ContactFacts>& contacts) {
  Disagreement out;
  double worst = 0.0;
  const auto look = [&](const std::string& where, const std::vector<post::ComparedFigure>& figures) {
    for (const post::ComparedFigure& f : figures) {
      ++out.compared;
      if (f.agrees)
        continue;
      ++out.differ;
      const double relative = std::abs(f.difference()) / std::max(std::abs(f.value), std::abs(f.at_half));
      if (relative > worst) {
        worst = relative;
        out.worst =
            fmt::format("{} of {} is {:.4g}, at half the step {:.4g}", f.name, where, f.value, f.at_half);
        if (std::isfinite(f.error))
          out.worst += fmt::format(" (standard error of the difference {:.2g})", f.error);
      }
    }
  };
  look("all contacts", verification.sums);
  for (std::size_t c = 0; c < verification.contacts.size(); ++c)
    look(fmt::format("contact \"{}\"", contacts[c].name), verification.contacts[c]);
  return out;
}

} // namespace fretwork::results
