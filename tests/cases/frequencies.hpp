// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Comparisons of frequencies, each a recorded property of its test, so that the report of a test run is the table
/// of validation.
#pragma once
#include "modal/slepc_modes.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace fretwork::tests {

inline modal::Basis modes(const fem::Model& model, int count) {
  const auto parts = fem::structures(model);
  EXPECT_EQ(parts.size(), 1u);
  modal::Wanted wanted;
  wanted.count = count;
  return modal::solve_modes(MPI_COMM_SELF, model, parts.front(), wanted);
}

inline std::vector<double> hertz(const modal::Basis& basis) {
  std::vector<double> values;
  for (const double omega : basis.omega)
    values.push_back(omega / (2.0 * std::numbers::pi));
  return values;
}

/// Frequencies of the modes that move in the plane of x and z (or out of it).
inline std::vector<double> plane_frequencies(const modal::Basis& basis, bool in_plane) {
  std::vector<double> values;
  for (Eigen::Index j = 0; j < basis.size(); ++j) {
    double in = 0.0, out = 0.0;
    for (Eigen::Index row = 0; row < basis.shapes.rows(); row += 6) {
      in += std::pow(basis.shapes(row, j), 2) + std::pow(basis.shapes(row + 2, j), 2);
      out += std::pow(basis.shapes(row + 1, j), 2);
    }
    if ((in > out) == in_plane)
      values.push_back(basis.omega[j] / (2.0 * std::numbers::pi));
  }
  return values;
}

inline void expect_frequency(const std::string& name, double ours, double reference, double tolerance) {
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "reference %.10g ours %.10g error %.2e", reference, ours,
                ours / reference - 1.0);
  testing::Test::RecordProperty(name, text.data());
  EXPECT_NEAR(ours / reference, 1.0, tolerance) << name << ": " << ours << " Hz, reference " << reference;
}

inline void expect_frequencies(const std::string& name, const std::vector<double>& ours,
                               std::vector<double> reference, double tolerance) {
  std::sort(reference.begin(), reference.end());
  ASSERT_GE(ours.size(), reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    expect_frequency(name + "_" + std::to_string(i + 1), ours[i], reference[i], tolerance);
}

} // namespace fretwork::tests
