// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A quantity of a validation case: compared, and written as a row of the table of doc/validation.md.
#pragma once
#include "program.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::cases {

using app::test::Results;
using app::test::Workshop;

/// Relative to `scale`, which is the reference where it is not given.
inline void expect_value(const char* name, const Results& run, const std::string& quantity, double reference,
                         double value, double tolerance, double scale = 0.0) {
  const double error = std::abs(value - reference) / (scale > 0.0 ? scale : std::abs(reference));
  const auto& transient = run.summary.at("transient");
  fmt::print("| {} | {} | {:.9g} | {:.9g} | {:.1e} | {:.3g} | {} |\n", name, quantity, reference, value,
             error, transient.at("step_max_s").get<double>(), transient.at("scheme").get<std::string>());
  EXPECT_LE(error, tolerance) << name << ", " << quantity << ": " << value << ", reference " << reference;
}

/// The output nearest to an instant.
inline Eigen::Index at(const Results& run, double time) {
  Eigen::Index index = 0;
  (run.archive.series.time.array() - time).abs().minCoeff(&index);
  EXPECT_NEAR(run.archive.series.time(index), time, 1e-9) << "no output at this instant";
  return index;
}

} // namespace fretwork::cases
