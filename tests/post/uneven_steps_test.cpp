// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of contacts over steps of different lengths.
#include "hand_made.hpp"
#include "post/contact_statistics.hpp"
#include <gtest/gtest.h>

namespace uneven_steps_test {

using namespace fretwork;
using namespace fretwork::tests;
using post::ContactStatistics;
using post::ContactSummary;

namespace {

constexpr double h = 0.01; // s
constexpr double round_off = 1e-12;

/// Uneven steps of two contacts that open, stick, slide and move, each cut into `parts` of equal length.
std::vector<ContactSummary> of_uneven_steps(int parts) {
  ContactStatistics statistics(centred(2), 0.0);
  HandMade run(statistics, 2, h);
  const double lengths[] = {0.5, 0.125, 2.0, 0.25, 1.0, 0.0625, 4.0, 0.5};
  for (int i = 0; i < 8; ++i) {
    run.step_length(lengths[i] / parts);
    for (int part = 0; part < parts; ++part) {
      for (std::size_t c = 0; c < 2; ++c) {
        auto& state = run.contact(c);
        run.y(c) = 1e-3 * (i + 1.0) * (c == 0 ? 1.0 : 2.0);
        run.z(c) = -2e-3 * i * i;
        const bool closed = i % 4 != 3;
        state.normal_force = closed ? 10.0 * (i + 1.0) : 0.0;
        state.friction = {closed ? 1.0 : 0.0, closed ? -0.5 * i : 0.0};
        state.displacement = {3e-4 / parts, 4e-4 / parts};
        state.slides = i % 2 == 0;
        state.slid = state.slides ? 5e-4 / parts : 0.0;
        state.friction_work = state.slides ? 1e-3 / parts : 0.0;
        state.damper_work = closed ? 2e-3 / parts : 0.0;
        state.approach = part == 0 ? 0.5 * (i % 4 == 3 ? -1.0 : 1.0) : 99.0;
      }
      run.step();
    }
  }
  return statistics.summaries();
}

std::vector<double> numbers(const ContactSummary& s) {
  return {static_cast<double>(s.impacts),
          s.contact_time_ratio,
          s.normal_mean,
          s.normal_rms,
          s.normal_max,
          s.normal_in_contact_mean,
          s.normal_in_contact_rms,
          s.tangential_rms,
          s.tangential_max,
          s.y.mean,
          s.y.std,
          s.y.min,
          s.y.max,
          s.z.mean,
          s.z.std,
          s.radial_rms,
          s.radial_max,
          s.work_rate,
          s.friction_power,
          s.impact_velocity_mean,
          s.impact_velocity_rms,
          s.impact_velocity_max,
          s.contact_duration_mean,
          s.contact_duration_max,
          s.departure_velocity_mean,
          s.departure_velocity_max,
          s.impulse,
          s.sliding_distance,
          s.sticking_ratio,
          s.damping_work,
          s.friction_work};
}

} // namespace

TEST(ContactStatistics, OfUnevenStepsAreThoseOfTheirHalves) {
  const auto whole = of_uneven_steps(1), halves = of_uneven_steps(2), quarters = of_uneven_steps(4);
  for (std::size_t c = 0; c < 2; ++c) {
    const auto one = numbers(whole[c]), two = numbers(halves[c]), four = numbers(quarters[c]);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_NEAR(two[i], one[i], round_off * std::abs(one[i])) << i;
      EXPECT_NEAR(four[i], one[i], round_off * std::abs(one[i])) << i;
    }
  }
}

TEST(ContactStatistics, WeighEachStepByItsLength) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, 0.1);
  run.y(0) = 1.0;
  run.closed(1, 10.0);
  run.step_length(0.3);
  run.y(0) = 5.0;
  run.closed(1, 20.0);
  run.step_length(0.6);
  run.open(1);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_NEAR(s.normal_mean, 7.0, round_off);
  EXPECT_NEAR(s.normal_rms, std::sqrt(0.1 * 100.0 + 0.3 * 400.0), round_off);
  EXPECT_NEAR(s.normal_in_contact_mean, 17.5, round_off);
  EXPECT_NEAR(s.y.mean, 0.1 + 0.9 * 5.0, round_off);
  EXPECT_NEAR(s.y.std, 4.0 * std::sqrt(0.1 * 0.9), round_off);
}

} // namespace uneven_steps_test
