// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/work_rate.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include "wear/student.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::wear {
namespace {

constexpr double least_freedom = 2.0;      ///< as of batch means
constexpr double largest_exponent = 100.0; ///< ends of an interval that says nothing stay finite

} // namespace

WorkRate work_rate(double value) {
  check_not_negative("work rate", "value", value, "W");
  return {value, value, value, false, false};
}

WorkRate work_rate_with_error(double value, double standard_error) {
  if (std::isnan(standard_error))
    return work_rate(value);
  check_not_negative("work rate", "value", value, "W");
  check_not_negative("work rate", "standard error", standard_error, "W");
  return {value, std::max(0.0, value - standard_error), value + standard_error, value < standard_error, true};
}

WorkRate work_rate_with_confidence(double value, double standard_error, double batches, double confidence) {
  if (std::isnan(standard_error))
    return work_rate(value);
  if (!(batches > 1.0))
    throw core::Error(
        fmt::format("work rate: an error from {:g} batches has no confidence; give more than 1", batches));
  if (!(confidence > 0.0 && confidence < 1.0))
    throw core::Error(
        fmt::format("work rate: confidence {:g} makes no sense; give a number between 0 and 1", confidence));
  check_not_negative("work rate", "value", value, "W");
  check_not_negative("work rate", "standard error", standard_error, "W");
  if (value == 0.0 || standard_error == 0.0)
    return work_rate_with_error(value, standard_error);
  const double of_batches = batches - 1.0, share = standard_error / value,
               freedom = std::max(1.0 / (1.0 / of_batches + 0.5 * share * share),
                                  std::min(of_batches, least_freedom)),
               factor = std::exp(std::min(student_factor(freedom, confidence) * share, largest_exponent));
  return {value, value / factor, value * factor, false, true};
}

WorkRate work_rate_between(double low, double value, double high) {
  check_not_negative("work rate", "lower end", low, "W");
  check_not_negative("work rate", "value", value, "W");
  check_not_negative("work rate", "upper end", high, "W");
  if (low > value || value > high)
    throw core::Error(
        fmt::format("work rate: {:g} W is not between its ends {:g} and {:g} W; give low <= value <= "
                    "high",
                    value, low, high));
  return {value, low, high, false, true};
}

WorkRate sum_of_points(std::span<const WorkRate> points) {
  if (points.empty())
    throw core::Error("work rate: a support without contact points has none; name at least one contact");
  WorkRate out{0.0, 0.0, 0.0, false, false};
  for (const auto& point : points) {
    out.value += point.value;
    out.low += point.low;
    out.high += point.high;
    out.low_at_zero = out.low_at_zero || point.low_at_zero;
    out.has_interval = out.has_interval || point.has_interval;
  }
  return out;
}

} // namespace fretwork::wear
