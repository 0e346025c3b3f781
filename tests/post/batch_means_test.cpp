// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/batch_means.hpp"
#include "post/contact_statistics.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace batch_means_test {

using namespace fretwork;
using namespace fretwork::post;

namespace {

constexpr int runs = 400; ///< of an ensemble: its mean square error is then known to a few percent
constexpr std::size_t samples = 1 << 14; ///< of a run

/// What BatchEnds and batch_means make of samples of unequal lengths.
BatchEstimate estimate(const std::vector<double>& values, const std::vector<double>& lengths) {
  BatchEnds ends(1);
  double elapsed = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    elapsed += lengths[i];
    sum += values[i] * lengths[i];
    ends.watch(elapsed, [&](double* row) { row[0] = sum; });
  }
  std::vector<double> t, x;
  double begin = 0.0, before = 0.0;
  for (std::size_t b = 0; b < ends.size(); ++b) {
    t.push_back(ends.time(b) - begin);
    x.push_back(ends.sum(b, 0) - before);
    begin = ends.time(b);
    before = ends.sum(b, 0);
  }
  if (elapsed > begin) {
    t.push_back(elapsed - begin);
    x.push_back(sum - before);
  }
  return batch_means(t, x);
}

/// Samples x_k = phi x_(k-1) + white noise of variance 1, started in its stationary state.
std::vector<double> autoregressive(double phi, std::mt19937_64& generator) {
  std::normal_distribution<double> noise;
  std::vector<double> out(samples);
  double x = noise(generator) / std::sqrt(1.0 - phi * phi);
  for (double& value : out) {
    value = x;
    x = phi * x + noise(generator);
  }
  return out;
}

/// Root of the mean square of the errors of an ensemble, over the exact one: variance of the mean of N samples
/// (1/(1-phi)^2)/N to order 1/N.
double ratio_of_errors(double phi) {
  std::mt19937_64 generator(7);
  const std::vector<double> equal(samples, 1.0);
  double squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    const double error = estimate(autoregressive(phi, generator), equal).error;
    squares += error * error;
  }
  const double exact = 1.0 / ((1.0 - phi) * (1.0 - phi) * static_cast<double>(samples));
  return std::sqrt(squares / runs / exact);
}

} // namespace

TEST(BatchMeans, HaveTheErrorOfWhiteNoise) {
  constexpr double tolerance =
      0.06; // of 16 to 31 batches the correction of their correlation makes the square up to 8 % too large
  EXPECT_NEAR(ratio_of_errors(0.0), 1.0, tolerance);
}

TEST(BatchMeans, HaveTheErrorOfAProcessThatRemembers) {
  constexpr double tolerance = 0.08;                   // the same, and what the shortest batches miss
  EXPECT_NEAR(ratio_of_errors(0.9), 1.0, tolerance);   // correlated over 10 samples, a batch has 256 to 512
  EXPECT_NEAR(ratio_of_errors(-0.5), 1.0, tolerance);  // anticorrelated
  EXPECT_NEAR(ratio_of_errors(0.995), 1.0, tolerance); // correlated over 200, a window of 82 such times
  constexpr double of_short_window =
      0.35; // over 1000, a window of 16: the mean of squares of few degrees of freedom is above
  EXPECT_NEAR(ratio_of_errors(0.999), 1.0, of_short_window);
}

TEST(BatchMeans, HaveFewDegreesOfFreedomWhereBatchesFollowOneAnother) {
  std::mt19937_64 generator(3);
  const std::vector<double> equal(samples, 1.0);
  const auto mean = [&](double phi) {
    constexpr int series = 40;
    double sum = 0.0;
    for (int i = 0; i < series; ++i)
      sum += estimate(autoregressive(phi, generator), equal).batches / series;
    return sum;
  };
  EXPECT_GT(mean(0.0), 5.5); // a third of 16 to 31, and 1
  EXPECT_LT(mean(0.9995), 5.0);
}

TEST(BatchMeans, WeighUnequalStepsByTheirLengths) {
  // white noise held over unequal lengths w: variance of the mean = sum w^2 / (sum w)^2
  std::mt19937_64 generator(11);
  std::normal_distribution<double> noise;
  std::exponential_distribution<double> length(1.0);
  double squares = 0.0, exact = 0.0;
  for (int run = 0; run < runs; ++run) {
    std::vector<double> values(samples), lengths(samples);
    double sum = 0.0, sum2 = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
      values[i] = noise(generator);
      lengths[i] = length(generator);
      sum += lengths[i];
      sum2 += lengths[i] * lengths[i];
    }
    const double error = estimate(values, lengths).error;
    squares += error * error;
    exact += sum2 / (sum * sum);
  }
  constexpr double tolerance = 0.06; // as of white noise
  EXPECT_NEAR(std::sqrt(squares / exact), 1.0, tolerance);
}

TEST(BatchMeans, WeighUnequalBatchesByTheirLengths) {
  // X_b of variance T_b: the estimate of the square has the mean 1/T
  std::mt19937_64 generator(5);
  std::normal_distribution<double> noise;
  constexpr int batches = 60;
  std::vector<double> lengths, sums(batches);
  for (int b = 0; b < batches; ++b)
    lengths.push_back(b % 3 == 0 ? 2.0 : 1.0);
  constexpr int many = 20000;
  double squares = 0.0;
  for (int run = 0; run < many; ++run) {
    for (std::size_t b = 0; b < sums.size(); ++b)
      sums[b] = std::sqrt(lengths[b]) * noise(generator);
    const BatchEstimate e = batch_means(lengths, sums);
    squares += e.error * e.error;
  }
  constexpr double tolerance = 0.04; // the correction of their correlation, of second order in 1/60
  EXPECT_NEAR(squares / many * 80.0, 1.0, tolerance);
}

TEST(BatchMeans, OfAConstantAreZero) {
  const BatchEstimate e = estimate(std::vector<double>(1000, 3.25), std::vector<double>(1000, 0.5));
  EXPECT_EQ(e.error, 0.0);
  EXPECT_GE(e.batches, 16.0);
}

TEST(BatchMeans, OfTooFewAreNotANumber) {
  EXPECT_TRUE(std::isnan(estimate({}, {}).error));
  EXPECT_TRUE(std::isnan(estimate(std::vector<double>(7, 1.0), std::vector<double>(7, 1.0)).error));
  EXPECT_EQ(estimate(std::vector<double>(8, 1.0), std::vector<double>(8, 1.0)).error, 0.0);
}

TEST(BatchMeans, KeepBetweenHalfAndAllOfTheirPlaces) {
  BatchEnds ends(1);
  for (int i = 1; i <= 100000; ++i) {
    ends.watch(i * 0.1, [&](double* row) { row[0] = i; });
    EXPECT_LT(ends.size(), BatchEnds::most);
    EXPECT_GE(ends.size(), std::min<std::size_t>(static_cast<std::size_t>(i), BatchEnds::most / 2));
  }
  for (std::size_t b = 0; b < ends.size(); ++b)
    EXPECT_NEAR(ends.time(b), 0.1 * ends.sum(b, 0), 1e-9);
}

TEST(ContactStatistics, HaveStandardErrorsThatAreTheScatterOfManyRuns) {
  // slides and moves at random: what each run says of its own scatter against the scatter over runs
  constexpr std::size_t ensemble = 200;
  std::mt19937_64 generator(13);
  std::normal_distribution<double> noise;
  std::vector<std::array<double, 7>> values, errors;
  for (std::size_t run = 0; run < ensemble; ++run) {
    ContactStatistics statistics(tests::centred(1), 0.0);
    tests::HandMade steps(statistics, 1, 0.01);
    double slow = 0.0, y = 0.0;
    for (int i = 0; i < 4096; ++i) {
      slow = 0.8 * slow + noise(generator);
      y = 0.9 * y + noise(generator);
      auto& state = steps.contact(0);
      state.normal_force = std::max(0.0, slow);
      state.displacement = {0.0, 1.0};
      state.slides = true;
      state.slid = 1.0;
      state.friction_work = state.normal_force * 0.3;
      steps.y(0) = 5.0 + y;
      steps.z(0) = noise(generator);
      steps.step();
    }
    const ContactSummary s = statistics.summaries()[0];
    const StandardErrors& e = s.error;
    values.push_back(
        {s.work_rate, s.friction_power, s.normal_rms, s.impact_rate, s.y.std, s.z.std, s.contact_time_ratio});
    errors.push_back(
        {e.work_rate, e.friction_power, e.normal_rms, e.impact_rate, e.y_std, e.z_std, e.contact_time_ratio});
    const StandardErrors sums = statistics.errors_of_sums(); // of one contact: its own
    EXPECT_EQ(sums.work_rate, e.work_rate);
    EXPECT_EQ(sums.impact_rate, e.impact_rate);
  }
  for (std::size_t k = 0; k < 7; ++k) {
    double mean = 0.0, scatter = 0.0, estimated = 0.0;
    for (const auto& v : values)
      mean += v[k] / ensemble;
    for (std::size_t r = 0; r < ensemble; ++r) {
      scatter += (values[r][k] - mean) * (values[r][k] - mean) / (ensemble - 1.0);
      estimated += errors[r][k] * errors[r][k] / ensemble;
    }
    constexpr double tolerance = 0.2; // the scatter of 200 runs is known to 5 %: four times that
    EXPECT_NEAR(std::sqrt(estimated / scatter), 1.0, tolerance) << k;
  }
}

} // namespace batch_means_test
