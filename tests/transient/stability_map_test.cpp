// SPDX-License-Identifier: GPL-3.0-or-later
// No fixed step is stable and wrong without a warning.
#include "bench/stability_map.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace stability_map_test {

using namespace fretwork;
using transient::SchemeKind;

namespace {

/// Of the energy, an impact: as much as a restitution of 0.995, less than dampers of real supports take.
constexpr double wrong_energy = 0.01;
/// Of the friction power: what an automatic step at 1 % may add up to over terms at their limits.
constexpr double wrong_power = 0.1;
constexpr double resolutions[] = {0.1, 0.5, 0.75, 1.0, 1.25, 1.5, 1.95, 2.5};

using Point = bench::MapPoint (*)(SchemeKind, double, double);

class StabilityMap : public testing::TestWithParam<SchemeKind> {
protected:
  void expect_no_silent_error(Point point, const std::vector<double>& levels, double wrong) const {
    for (const double level : levels)
      for (const double resolution : resolutions) {
        const bench::MapPoint p = point(GetParam(), resolution, level);
        EXPECT_TRUE(p.warned || std::abs(p.error) <= wrong)
            << "resolution " << resolution << ", level " << level << ": " << p.error;
      }
  }
};

} // namespace

TEST_P(StabilityMap, OfImpactsHasNoErrorWithoutAWarning) {
  expect_no_silent_error(bench::bouncing, {0.0, 3.0, 20.0}, wrong_energy);
}

TEST_P(StabilityMap, OfFrictionHasNoErrorWithoutAWarning) {
  expect_no_silent_error(bench::rubbing, {0.2, 2.0, 10.0}, wrong_power);
}

TEST_P(StabilityMap, HasNoWarningWhereTheStepResolves) {
  const bench::MapPoint p = bench::bouncing(GetParam(), 0.25, 0.0);
  EXPECT_FALSE(p.warned);
  EXPECT_LE(std::abs(p.error), 0.1 * wrong_energy);
}

INSTANTIATE_TEST_SUITE_P(Schemes, StabilityMap,
                         testing::Values(SchemeKind::splitting, SchemeKind::collocation,
                                         SchemeKind::energy_conserving, SchemeKind::euler,
                                         SchemeKind::devogelaere),
                         [](const auto& tested) { return transient::name_of(tested.param); });

} // namespace stability_map_test
