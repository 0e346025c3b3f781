// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the tests of static equilibria share.
#pragma once
#include "scenes.hpp"
#include "transient/statics/static_start.hpp"
#include <gtest/gtest.h>

namespace fretwork::tests {

/// Closed forms and the residual: round-off, some operations deep.
constexpr double round_off = 1e-11;

inline transient::Equilibrium found(const transient::Scene& scene) {
  transient::Equilibrium e = transient::static_equilibrium(scene);
  EXPECT_EQ(e.balance, transient::Balance::found) << e.residual;
  EXPECT_LT(e.residual, round_off);
  EXPECT_EQ(e.motion.size(), 0);
  return e;
}

inline contact::Support spring_at(const contact::Obstacle& obstacle, double stiffness) {
  return {obstacle, {stiffness}, {}};
}

} // namespace fretwork::tests
