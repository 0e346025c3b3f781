// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/verification.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fretwork::post {
namespace {

ComparedFigure compared(std::string name, double a, double error_a, double b, double error_b,
                        const Criterion& criterion) {
  ComparedFigure out{std::move(name), a, b, std::hypot(error_a, error_b), true};
  const double noise = std::isfinite(out.error) ? criterion.factor * out.error : 0.0;
  out.agrees =
      std::abs(a - b) <= noise + least_share_shown * criterion.accuracy * std::max(std::abs(a), std::abs(b));
  return out;
}

/// Chance that a normal variable leaves +-k.
double outside(double k) { return std::erfc(k / std::numbers::sqrt2); }

} // namespace

double critical_factor(std::size_t figures) {
  const double wanted = outside(factor_of_sums) / static_cast<double>(figures);
  double low = factor_of_sums, high = 40.0; // erfc is 0 in double precision before 40
  while (high - low > 1e-12 * high)
    (outside(0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
  return figures == 1 ? factor_of_sums : 0.5 * (low + high);
}

double factor_of_largest(double k) {
  return std::numbers::sqrt3 / std::numbers::pi * std::log(2.0 / outside(k) - 1.0);
}

std::vector<ComparedFigure> compare(const ContactSummary& run, const ContactSummary& half,
                                    const Criterion& criterion) {
  const StandardErrors &a = run.error, &b = half.error;
  const auto figure = [&](const char* name, double x, double error_x, double y, double error_y) {
    return compared(name, x, error_x, y, error_y, criterion);
  };
  return {
      figure("work_rate", run.work_rate, a.work_rate, half.work_rate, b.work_rate),
      figure("friction_power", run.friction_power, a.friction_power, half.friction_power, b.friction_power),
      figure("impacts_per_second", run.impact_rate, a.impact_rate, half.impact_rate, b.impact_rate),
      figure("contact_time_ratio", run.contact_time_ratio, a.contact_time_ratio, half.contact_time_ratio,
             b.contact_time_ratio),
      figure("normal_force.mean", run.normal_mean, a.normal_mean, half.normal_mean, b.normal_mean),
      figure("normal_force.rms", run.normal_rms, a.normal_rms, half.normal_rms, b.normal_rms),
      compared("normal_force.max", run.normal_max, a.normal_max, half.normal_max, b.normal_max,
               {criterion.accuracy, factor_of_largest(criterion.factor)}),
      figure("displacement.y.std", run.y.std, a.y_std, half.y.std, b.y_std),
      figure("displacement.z.std", run.z.std, a.z_std, half.z.std, b.z_std)};
}

std::vector<ComparedFigure> compare_sums(const std::vector<ContactSummary>& run,
                                         const StandardErrors& run_errors,
                                         const std::vector<ContactSummary>& half,
                                         const StandardErrors& half_errors, const Criterion& criterion) {
  const auto figure = [&](const char* name, double ContactSummary::*value, double StandardErrors::*error) {
    const auto sum = [value](const std::vector<ContactSummary>& contacts) {
      double out = 0.0;
      for (const ContactSummary& contact : contacts)
        out += contact.*value;
      return out;
    };
    return compared(name, sum(run), run_errors.*error, sum(half), half_errors.*error, criterion);
  };
  return {figure("work_rate", &ContactSummary::work_rate, &StandardErrors::work_rate),
          figure("friction_power", &ContactSummary::friction_power, &StandardErrors::friction_power),
          figure("impacts_per_second", &ContactSummary::impact_rate, &StandardErrors::impact_rate)};
}

} // namespace fretwork::post
