// SPDX-License-Identifier: GPL-3.0-or-later
// The share of the build-up from rest in statistics that begin at t = 0.
#include "app/build_up.hpp"
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace build_up_test {

using namespace fretwork;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

constexpr double pi = std::numbers::pi;

/// Modes of unit force under one load. @param damping  ratio
vibration::ForcedSystem forced(const std::vector<double>& hertz, double damping, double duration,
                               signals::TimeFunction load) {
  vibration::ForcedSystem out;
  const auto n = static_cast<Eigen::Index>(hertz.size());
  const Eigen::VectorXd omega = 2.0 * pi * Eigen::Map<const Eigen::VectorXd>(hertz.data(), n);
  out.system.stiffness = omega.array().square();
  out.system.damping = 2.0 * damping * omega;
  out.loads = {{std::move(load), Eigen::VectorXd::Ones(n)}};
  out.q0 = out.v0 = Eigen::VectorXd::Zero(n);
  out.duration = duration;
  return out;
}

} // namespace

TEST(BuildUp, OfOneModeIsThatOfItsDecay) {
  const app::BuildUp found = app::build_up(forced({10.0}, 0.01, 5.0, signals::Random{1.0, 5.0, 50.0}));
  const double decay = 1.0 / (0.01 * 2.0 * pi * 10.0);
  EXPECT_NEAR(found.decay_time, decay, 1e-12);
  EXPECT_NEAR(found.frequency, 10.0, 1e-12);
  EXPECT_NEAR(found.share, decay / 10.0 * (1.0 - std::exp(-10.0 / decay)), 1e-12);
}

// Against the motion itself: a resonance grows as 1 - exp(-t/T), so that the mean square lacks 2 T/D - T/(2 D) of it.
TEST(BuildUp, IsOfTheSizeOfThatOfAResonance) {
  const double damping = 0.01, duration = 20.0, omega = 2.0 * pi * 10.0, decay = 1.0 / (damping * omega);
  double square = 0.0;
  constexpr int steps = 200000;
  for (int i = 0; i < steps; ++i) {
    const double t = duration * (i + 0.5) / steps;
    square += std::pow((1.0 - std::exp(-t / decay)) * std::cos(omega * t), 2) / steps;
  }
  const double lacking = 1.0 - square / 0.5;
  const double share = app::build_up(forced({10.0}, damping, duration, signals::Harmonic{1.0, 10.0})).share;
  EXPECT_GT(lacking, share);
  EXPECT_LT(lacking, 4.0 * share);
}

TEST(BuildUp, CountsModesByTheirMeanSquares) {
  const signals::Random noise{1.0, 1.0, 50.0};
  const double slow = app::build_up(forced({2.0}, 0.01, 50.0, noise)).share,
               both = app::build_up(forced({2.0, 20.0}, 0.01, 50.0, noise)).share;
  EXPECT_LT(both, slow);
  EXPECT_NEAR(both, slow, 0.01 * slow); // the fast one moves 1/1000 of it
  EXPECT_NEAR(app::build_up(forced({2.0, 20.0}, 0.01, 50.0, noise)).frequency, 2.0, 1e-12);
  const signals::Random below{1.0, 1.0, 5.0};
  EXPECT_EQ(app::build_up(forced({20.0}, 0.01, 50.0, below)).share, 0.0) << "follows the force";
}

TEST(BuildUp, IsNoneOfWhatHasNoSteadyState) {
  EXPECT_EQ(app::build_up(forced({2.0}, 0.0, 50.0, signals::Random{1.0, 1.0, 50.0})).share, 0.0);
  EXPECT_EQ(app::build_up(forced({2.0}, 0.01, 50.0, signals::Constant{1.0})).share, 0.0);
  EXPECT_EQ(app::build_up(forced({2.0}, 0.01, 50.0, signals::Table{{0.0, 1.0}, {1.0, 0.0}})).share, 0.0);
}

TEST(BuildUp, IsNotedOfShortWindowsFromTheStart) {
  study::Study study;
  std::vector<app::BuiltScene> scenes(1);
  const signals::Random noise{1.0, 5.0, 50.0};
  static_cast<vibration::ForcedSystem&>(scenes[0].scene) = forced({10.0}, 0.01, 5.0, noise);
  EXPECT_THAT(app::build_up_note(study, scenes),
              HasSubstr("by about 16 % (mode at 10 Hz, decay time 1/(zeta omega) = 1.6 s)"));
  study.output.statistics_from = 1.0;
  EXPECT_THAT(app::build_up_note(study, scenes), IsEmpty());
  study.output.statistics_from = 0.0;
  static_cast<vibration::ForcedSystem&>(scenes[0].scene) = forced({10.0}, 0.01, 50.0, noise);
  EXPECT_THAT(app::build_up_note(study, scenes), IsEmpty());
  static_cast<vibration::ForcedSystem&>(scenes[0].scene) = forced({10.0}, 0.01, 5.0, noise);
  study.initial.resize(1);
  EXPECT_THAT(app::build_up_note(study, scenes), IsEmpty()) << "it may start in its steady state";
}

} // namespace build_up_test
