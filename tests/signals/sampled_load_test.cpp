// SPDX-License-Identifier: GPL-3.0-or-later
// Modal forces given by samples: their values.
#include "sampled_forces.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::signals::sampled_load_test {
namespace {

using tests::sampled_sines;
using tests::SineSamples;
constexpr double round_off = 1e-14;

TEST(SampledLoad, IsLinearBetweenSamples) {
  constexpr double step = 0.01;
  const SampledLoad load = sampled_sines({2.0, 3.0}, step);
  SampledForce force(load);
  for (const double time :
       {0.0, 0.004, 0.01, 0.637, 1.234, 0.31, 12.3456}) { // also back, and beyond a window
    const double place = time / step, k = std::floor(place);
    double f[2] = {1.0, -1.0}; // is added to
    force.add(time, f);
    for (int i = 0; i < 2; ++i) {
      const auto at = [&](double sample) { return SineSamples::value(load.rms(i), sample * step); };
      const double expected = (i == 0 ? 1.0 : -1.0) + (1.0 - place + k) * at(k) + (place - k) * at(k + 1.0);
      EXPECT_NEAR(f[i], expected, 1e3 * round_off) << time;
    }
  }
}

TEST(SampledLoad, SetsInByItsRamp) {
  SampledLoad load = sampled_sines({1.0}, 0.001);
  SampledForce plain(load);
  load.ramp = 0.5;
  SampledForce ramped(load);
  for (const double time : {0.0, 0.1, 0.25, 0.4, 0.5, 0.7}) {
    double a = 0.0, b = 0.0;
    plain.add(time, &a);
    ramped.add(time, &b);
    const double share = time < 0.5 ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / 0.5)) : 1.0;
    EXPECT_NEAR(b, share * a, round_off) << time;
  }
}

} // namespace
} // namespace fretwork::signals::sampled_load_test
