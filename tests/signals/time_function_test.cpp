// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/time_function.hpp"
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

namespace time_function_test {

using namespace fretwork::signals;

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Power of samples at a frequency, Hann's window; 1 for a unit sine there.
double power_at(const std::vector<double>& samples, double step, double frequency) {
  std::complex<double> sum = 0.0;
  const auto n = static_cast<double>(samples.size());
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const double t = static_cast<double>(j) * step,
                 window = 1.0 - std::cos(two_pi * static_cast<double>(j) / n);
    sum += window * samples[j] * std::exp(std::complex<double>(0.0, -two_pi * frequency * t));
  }
  return std::norm(2.0 * sum / n);
}

std::vector<double> sampled(const Signal& signal, double duration, int n) {
  std::vector<double> out;
  for (int j = 0; j < n; ++j)
    out.push_back(signal(duration * j / n));
  return out;
}

double over_step(const Signal& signal, double time, double h) {
  return signal.over_step(time, h, Signal::window(time, h));
}

} // namespace

TEST(Signal, OfAConstantIsTheConstant) {
  const Signal signal(Constant{3.5}, 1.0);
  EXPECT_EQ(signal(0.0), 3.5);
  EXPECT_EQ(signal(0.7), 3.5);
  EXPECT_TRUE(signal.is_constant());
}

TEST(Signal, OfAnIntegralIsTheVelocity) {
  const double w = two_pi * 5.0;
  const Signal of_harmonic(Integral{Harmonic{2.0, 5.0, 0.3}, -0.1}, 1.0);
  const Signal of_table(Integral{Table{{0.5, 1.5}, {4.0, 0.0}}, 1.0}, 2.0);
  for (const double t : {0.0, 0.013, 0.9})
    EXPECT_NEAR(of_harmonic(t), -0.1 + 2.0 / w * (std::cos(0.3) - std::cos(w * t + 0.3)), 1e-14);
  EXPECT_DOUBLE_EQ(of_table(0.25), 2.0);
  EXPECT_DOUBLE_EQ(of_table(1.0), 1.0 + 2.0 + 1.5);
  EXPECT_DOUBLE_EQ(of_table(1.9), 1.0 + 2.0 + 2.0);
  EXPECT_EQ(highest_frequency(Integral{Random{1.0, 2.0, 8.0}, 0.0}), 8.0);
  EXPECT_FALSE(of_table.is_constant());
}

TEST(Signal, OfAHarmonicIsItsSine) {
  const Signal signal(Harmonic{2.0, 5.0, 0.3}, 1.0);
  for (const double t : {0.0, 0.013, 0.9})
    EXPECT_DOUBLE_EQ(signal(t), 2.0 * std::sin(two_pi * 5.0 * t + 0.3));
  EXPECT_FALSE(signal.is_constant());
}

TEST(Signal, OfATableIsLinearBetweenAndConstantOutside) {
  const Signal signal(Table{{1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}}, 5.0);
  EXPECT_EQ(signal(0.0), 10.0);
  EXPECT_EQ(signal(1.0), 10.0);
  EXPECT_EQ(signal(1.25), 12.5);
  EXPECT_EQ(signal(2.0), 20.0);
  EXPECT_EQ(signal(3.0), 10.0);
  EXPECT_EQ(signal(4.0), 0.0);
  EXPECT_EQ(signal(9.0), 0.0);
}

TEST(Signal, OfATableJumpsWhereTwoPointsHaveOneTime) {
  const Signal signal(Table{{0.0, 1.0, 1.0, 2.0}, {1.0, 1.0, 5.0, 5.0}}, 2.0);
  EXPECT_EQ(signal(std::nextafter(1.0, 0.0)), 1.0);
  EXPECT_EQ(signal(1.0), 5.0); // the second value holds from there
  const Signal last(Table{{0.0, 1.0, 1.0}, {2.0, 2.0, 7.0}}, 2.0);
  EXPECT_EQ(last(0.5), 2.0);
  EXPECT_EQ(last(1.0), 7.0);
  EXPECT_EQ(Signal(Table{{1.0}, {4.0}}, 2.0)(0.0), 4.0);
}

TEST(RandomSignal, HasTheRmsOfItsEnsembleAndIsGaussianWithoutMean) {
  constexpr int seeds = 400, points = 64;
  constexpr double rms = 2.0;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Signal signal(Random{rms, 5.0, 45.0, static_cast<std::uint64_t>(seed)}, 2.0);
    for (int j = 0; j < points; ++j) {
      const double x = signal(2.0 * j / points);
      sum += x;
      squares += x * x;
      fourths += x * x * x * x;
    }
  }
  constexpr double n = seeds * points;
  // four standard errors of n samples, of which about every second is independent
  EXPECT_NEAR(sum / n, 0.0, 4.0 * rms * std::sqrt(2.0 / n));
  EXPECT_NEAR(squares / n / (rms * rms), 1.0, 4.0 * std::sqrt(2.0 * 2.0 / n));
  EXPECT_NEAR(fourths / n / (3.0 * rms * rms * rms * rms), 1.0, 4.0 * std::sqrt(96.0 * 2.0 / n) / 3.0);
}

TEST(RandomSignal, HasItsPowerInItsBand) {
  constexpr double duration = 10.0, low = 20.0, high = 60.0, rms = 1.5;
  constexpr int n = 4096;
  const auto samples = sampled(Signal(Random{rms, low, high, 3}, duration), duration, n);
  double inside = 0.0, outside = 0.0;
  for (double f = 0.1; f < 150.0; f += 0.1) {
    const double p = power_at(samples, duration / n, f);
    if (f > low && f < high)
      inside += p;
    else if (f < low - 1.0 || f > high + 1.0) // a hertz for the window's skirts
      outside += p;
  }
  constexpr double leak = 1e-8; // Hermite interpolation of the samples (4e-6)^2 and the window's side lobes
  EXPECT_LT(outside, leak * inside);
  // power of the band: sum over lines 1/duration apart of |c|^2/2, each seen 3/2 times through the window
  constexpr double one_draw = 0.2; // 400 lines: 5 % standard error of one draw
  EXPECT_NEAR(inside / 3.0 / (rms * rms), 1.0, one_draw);
}

TEST(RandomSignal, IsSmoothBetweenItsSamples) {
  // the mean slope over a tiny interval is continuous: no interval of the grid shows
  const Signal signal(Random{1.0, 10.0, 100.0, 5}, 1.0);
  constexpr double d = 1e-6;
  const double bend = 3.0 * std::pow(two_pi * 100.0, 2); // 3 rms of the second derivative of a 100 Hz sine
  for (int j = 1; j < 20000; ++j) {
    const double t = j * 5e-5, second = (signal(t + d) - 2.0 * signal(t) + signal(t - d)) / (d * d);
    ASSERT_LT(std::abs(second), 2.0 * bend) << "at " << t;
  }
}

TEST(RandomSignal, IsFixedByItsSeed) {
  const Random function{1.0, 10.0, 50.0, 7};
  Random other = function;
  other.seed = 8;
  const auto a = sampled(Signal(function, 1.0), 1.0, 100);
  EXPECT_EQ(a, sampled(Signal(function, 1.0), 1.0, 100));
  EXPECT_NE(a, sampled(Signal(other, 1.0), 1.0, 100));
}

TEST(RandomSignal, SharesItsSamplesWithThoseInUseOfTheSameFunction) {
  constexpr double duration = 300.0; // of more samples than are kept when no signal uses them
  const Random function{1.0, 0.0, 100.0, 7};
  const Signal run(function, duration), other(Random{1.0, 0.0, 100.0, 8}, duration),
      replay(function, duration), longer(function, 2.0 * duration);
  EXPECT_EQ(run.samples().data(), replay.samples().data());
  EXPECT_NE(run.samples().data(), other.samples().data());
  EXPECT_NE(run.samples().data(), longer.samples().data());
}

TEST(RandomSignal, BeginsAlikeWhateverTheDurationOfItsRun) {
  for (const Random& function : {Random{2.0, 5.0, 60.0, 3}, Random{1.0, 0.0, 200.0, 1},
                                 Random{1.0, 10.0, 10.5, 9}, Random{1.0, 5.0, 60.0, 4, true}}) {
    const Signal longest(function, 40.0); // over several blocks
    for (const double duration : {0.05, 1.0, 7.0, 20.0}) {
      const Signal signal(function, duration);
      for (int j = 0; j <= 1000; ++j)
        ASSERT_EQ(signal(duration * j / 1000.0), longest(duration * j / 1000.0)) << duration << " " << j;
    }
  }
}

TEST(RandomSignal, HasItsRmsInFadesToo) {
  // blocks of 1024 periods of 50 Hz, 20.48 s: the middle of the first fade is at 20.48 (1 - 1/8) - 20.48/16
  constexpr int seeds = 2000;
  constexpr double block = 1024.0 / 50.0, middle = block * (1.0 - 3.0 / 16.0);
  double squares = 0.0;
  for (int seed = 1; seed <= seeds; ++seed)
    squares += std::pow(Signal(Random{1.0, 5.0, 50.0, static_cast<std::uint64_t>(seed)}, middle)(middle), 2);
  EXPECT_NEAR(squares / seeds, 1.0, 4.0 * std::sqrt(2.0 / seeds)); // four standard errors
}

// Fades of a displacement change its acceleration by 2 w' v + w'' y: in the middle of a fade by 2 % at the lower end of the band.
TEST(RandomSignal, OfAMotionHasItsRmsInFadesToo) {
  constexpr int seeds = 2000;
  constexpr double low = 10.0, high = 50.0, block = 1024.0 / high, middle = block * (1.0 - 3.0 / 16.0);
  for (const double time : {1.0, middle, middle + block / 32.0}) {
    double squares = 0.0;
    for (int seed = 1; seed <= seeds; ++seed)
      squares += std::pow(
          Signal(Random{1.0, low, high, static_cast<std::uint64_t>(seed), true}, middle + 1.0)(time), 2);
    EXPECT_NEAR(squares / seeds, 1.0, 4.0 * std::sqrt(2.0 / seeds)) << time; // four standard errors
  }
}

TEST(RandomSignal, OfAMotionHasTheLinesOfItsSeedBetweenFades) {
  const Random plain{1.0, 10.0, 100.0, 5};
  Random moving = plain;
  moving.of_motion = true;
  const Signal a(plain, 2.0), b(moving, 2.0);
  for (const double t : {0.11, 0.7, 1.9}) // after the rise from rest, one period of 10 Hz
    EXPECT_EQ(a(t), b(t)) << t;
}

TEST(RandomSignal, OfAMotionHasTheSlopeOfItsValues) {
  const Signal signal(Random{1.0, 10.0, 100.0, 5, true}, 12.0);
  const std::span<const double> samples = signal.samples(); // values and slopes, through the start and a fade
  double most = 0.0;
  for (std::size_t i = 2; i + 6 < samples.size(); i += 2) {
    // of order 4; where a third derivative of a weight jumps less
    const double slope =
        (8.0 * (samples[i + 2] - samples[i - 2]) - (i > 2 ? samples[i + 4] - samples[i - 4] : 0.0)) / 12.0;
    if (i > 2)
      most = std::max(most, std::abs(slope - samples[i + 1]));
  }
  EXPECT_LT(most, 5e-5); // (2 pi/32)^5/30 of the highest lines is 1e-5
}

TEST(StaticValue, IsThatAtTheStartButForRandomSignals) {
  EXPECT_EQ(static_value(Constant{2.0}, 1.0), 2.0);
  EXPECT_EQ(static_value(Table{{0.0, 1.0}, {3.0, 0.0}}, 1.0), 3.0);
  EXPECT_EQ(static_value(Harmonic{2.0, 5.0, two_pi / 4.0}, 1.0), 2.0);
  const Random random{1.0, 5.0, 45.0, 1};
  EXPECT_NE(Signal(random, 1.0)(0.0), 0.0);
  EXPECT_EQ(static_value(random, 1.0), 0.0);
}

TEST(RandomSignal, OfARunShorterThanItsBandsMemoryHasItsRmsToo) {
  constexpr int seeds = 4000;
  double squares = 0.0;
  for (int seed = 1; seed <= seeds; ++seed)
    squares += std::pow(Signal(Random{1.0, 10.0, 12.0, static_cast<std::uint64_t>(seed)}, 0.01)(0.005), 2);
  EXPECT_NEAR(squares / seeds, 1.0, 4.0 * std::sqrt(2.0 / seeds)); // four standard errors
}

TEST(HighestFrequency, IsThatToBeResolved) {
  EXPECT_EQ(highest_frequency(Constant{1.0}), 0.0);
  EXPECT_EQ(highest_frequency(Harmonic{1.0, 37.0}), 37.0);
  EXPECT_EQ(highest_frequency(Random{1.0, 2.0, 80.0}), 80.0);
  EXPECT_EQ(highest_frequency(Table{{0.0, 1.0}, {0.0, 1.0}}), 0.0);
}

TEST(RandomSignal, IsTheHermiteCubicOfItsSamples) {
  const Signal signal(Random{1.0, 10.0, 100.0, 5}, 1.0);
  for (const std::size_t interval : {0, 1, 77}) {
    const double* p = signal.samples().data() + 2 * interval;
    const auto at = [&](double s) {
      return signal((static_cast<double>(interval) + s) * signal.grid_step());
    };
    constexpr double near = 1e-12;
    EXPECT_NEAR(at(0.0), p[0], near);
    EXPECT_NEAR(at(1.0), p[2], near);
    EXPECT_NEAR(at(0.5), 0.5 * (p[0] + p[2]) + 0.125 * (p[1] - p[3]), near);
    EXPECT_NEAR(at(0.25), (54.0 * p[0] + 10.0 * p[2] + 9.0 * p[1] - 3.0 * p[3]) / 64.0, near);
  }
}

TEST(Signal, KeepsTheImpulseOfWhatATableDoesInsideAStep) {
  constexpr double round_off = 1e-14;
  const Signal spike(Table{{0.0, 0.41, 0.42, 0.43, 1.0}, {0.0, 0.0, 6.0, 0.0, 0.0}}, 1.0); // area 0.06
  double impulse = 0.0;
  for (int k = 0; k < 10; ++k)
    impulse += 0.1 * over_step(spike, 0.1 * k + 0.05, 0.1);
  EXPECT_NEAR(impulse, 0.06, round_off);
  // wherever it stands among the steps, also where they part it; Simpson's rule takes windows at the ends and the middle of steps
  for (int phase = 0; phase < 50; ++phase) {
    const double t = 0.4 + 0.1 * phase / 49.0;
    const Signal pulse(Table{{0.0, t - 0.003, t, t + 0.005, 1.0}, {0.0, 0.0, 6.0, 0.0, 0.0}},
                       1.0); // area 0.024
    double sum = 0.0, simpson = 0.0;
    for (int k = 0; k < 10; ++k) {
      sum += 0.1 * over_step(pulse, 0.1 * k + 0.05, 0.1);
      simpson += 0.1 / 6.0 *
                 (over_step(pulse, 0.1 * k, 0.1) + 4.0 * over_step(pulse, 0.1 * k + 0.05, 0.1) +
                  over_step(pulse, 0.1 * k + 0.1, 0.1));
    }
    EXPECT_NEAR(sum, 0.024, 2.0 * round_off) << t;
    EXPECT_NEAR(simpson, 0.024, 2.0 * round_off) << t;
  }
  const Signal jump(Table{{0.0, 0.25, 0.25, 1.0}, {1.0, 1.0, 5.0, 5.0}}, 1.0);
  EXPECT_NEAR(over_step(jump, 0.3, 0.2), 0.25 * 1.0 + 0.75 * 5.0, round_off);
  EXPECT_EQ(over_step(jump, 0.15, 0.1), 1.0); // before it
  EXPECT_EQ(over_step(jump, 0.31, 0.1), 5.0); // after it
}

TEST(Signal, LeavesASingleBendToTheInterpolationBetweenSteps) {
  const Signal bend(Table{{0.0, 0.5, 1.0}, {0.0, 1.0, 0.0}}, 1.0);
  EXPECT_EQ(over_step(bend, 0.5, 0.1), 1.0);
}

namespace {

/// By the midpoint rule.
InStep by_parts(const Signal& signal, double from, double to) {
  constexpr int parts = 100'000;
  InStep out;
  for (int i = 0; i < parts; ++i) {
    const double x = (2.0 * i + 1.0) / parts - 1.0,
                 v = signal(0.5 * (from + to) + 0.5 * x * (to - from)) / parts;
    out.mean += v;
    out.slope += 3.0 * x * v;
    out.bend += 2.5 * (3.0 * x * x - 1.0) * v;
  }
  return out;
}
void expect_near(const InStep& a, const InStep& b, double most) {
  EXPECT_NEAR(a.mean, b.mean, most);
  EXPECT_NEAR(a.slope, b.slope, most);
  EXPECT_NEAR(a.bend, b.bend, most);
}

} // namespace

TEST(Signal, IsItsMomentsInAStep) {
  expect_near(Signal(Constant{3.0}, 1.0).in_step(0.2, 0.3), {3.0, 0.0, 0.0}, 0.0);
  // ten steps in a period; the rule is exact to degree 5, of the bend to degree 3
  const Signal sine(Harmonic{2.0, 1.0, 0.4}, 1.0), random(Random{1.0, 0.2, 1.0, 7}, 1.0);
  for (const double from : {0.0, 0.13, 0.77}) {
    expect_near(sine.in_step(from, from + 0.1), by_parts(sine, from, from + 0.1), 2.0 * 3e-4);
    expect_near(random.in_step(from, from + 0.1), by_parts(random, from, from + 0.1), 3e-4);
  }
}

TEST(Signal, OfATableIsItsMomentsInAStepWhereverItsRowsAre) {
  const Signal table(Table{{0.1, 0.2, 0.32, 0.32, 0.35, 0.9}, {1.0, -2.0, 4.0, 0.5, 7.0, 7.0}}, 1.0);
  constexpr double of_the_rule = 2e-4; // at a jump half a part of it
  for (const auto& [from, to] : {std::pair(0.0, 0.3),
                                 {0.0, 0.05},
                                 {0.05, 0.15},
                                 {0.12, 0.18},
                                 {0.3, 0.34},
                                 {0.2, 0.4},
                                 {0.1, 0.95},
                                 {0.32, 0.35}})
    expect_near(table.in_step(from, to), by_parts(table, from, to), of_the_rule);
  // up to a jump, and from it on
  const InStep before = table.in_step(0.28, 0.32), after = table.in_step(0.32, 0.335);
  EXPECT_NEAR(before.mean + before.slope, 4.0, 1e-12);
  EXPECT_NEAR(after.mean - after.slope, 0.5, 1e-12);
  EXPECT_NEAR(before.bend, 0.0, 1e-12);
  // an impulse that lies inside one step is kept
  const Signal pulse(Table{{0.5, 0.5001, 0.5002}, {0.0, 1e4, 0.0}}, 1.0);
  EXPECT_NEAR(pulse.in_step(0.45, 0.55).mean * 0.1, 1.0, 1e-12);
}

} // namespace time_function_test
