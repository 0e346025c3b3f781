// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/batch_maxima.hpp"
#include "post/contact_statistics.hpp"
#include "post/verification.hpp"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace batch_maxima_test {

using namespace fretwork;
using namespace fretwork::post;

namespace {

/// 512 impacts in a window, with forces that `draw` gives.
template <class Draw> ContactSummary window_of(Draw draw) {
  ContactStatistics statistics(tests::centred(1), 0.0);
  tests::HandMade steps(statistics, 1, 0.01);
  for (int i = 0; i < 512; ++i) {
    steps.contact(0).normal_force = draw();
    steps.step();
    steps.step();
  }
  return statistics.summaries()[0];
}

} // namespace

TEST(BatchMaxima, ScatterByTheirStandardDeviation) {
  std::vector<double> maxima(8);
  std::iota(maxima.begin(), maxima.end(), 1.0);
  EXPECT_DOUBLE_EQ(error_of_largest(maxima), std::sqrt(6.0)); // n (n + 1)/12
  maxima.pop_back();
  EXPECT_TRUE(std::isnan(error_of_largest(maxima))); // too few batches
}

TEST(BatchMaxima, AreJoinedInPairs) {
  std::vector<double> pairs, all;
  for (int k = 0; k < 31; ++k) {
    pairs.push_back(std::cos(k) + 1.0);
    all.insert(all.end(), {pairs.back(), 0.5 * pairs.back()});
  }
  EXPECT_EQ(error_of_largest(all), error_of_largest(pairs));
  pairs.back() = 5.0;
  all.push_back(5.0); // joins the last pair
  EXPECT_EQ(error_of_largest(all), error_of_largest(pairs));
}

TEST(BatchMaxima, FollowTheBatchesOfAWindow) {
  BatchEnds ends(0);
  BatchMaxima maxima(2);
  std::vector<double> seen;
  for (int i = 1; i <= 1000; ++i) { // 1, 2, 4 ... 32 steps a batch in the end
    const double value = 2.0 + std::sin(i);
    maxima.watch(0, value);
    seen.push_back(value);
    ends.watch(0.1 * i, [&](double*) { maxima.end_batch(); });
  }
  std::vector<double> expected;
  for (std::size_t b = 0, i = 0; b < ends.size(); ++b) {
    double largest = 0.0;
    for (; i < seen.size() && 0.1 * static_cast<double>(i + 1) <= ends.time(b) + 1e-9; ++i)
      largest = std::max(largest, seen[i]);
    expected.push_back(largest);
  }
  EXPECT_EQ(maxima.error(0), error_of_largest(expected));
  EXPECT_EQ(maxima.error(1), 0.0); // nothing was seen of it
}

TEST(BatchMaxima, OfAContactAreThoseOfItsPeaks) {
  int i = 0;
  EXPECT_EQ(window_of([] { return 3.0; }).error.normal_max, 0.0); // a steady motion has one largest force
  EXPECT_GT(window_of([&] { return 3.0 + 0.1 * std::sin(++i); }).error.normal_max, 0.0);
}

// Forces whose tail is exponential, as that of a normal variable (speeds of impacts), or bounded: what a run says of its scatter against that over
// runs, and how often chance alone is reported as a difference.
TEST(BatchMaxima, GiveTheScatterOfTheLargestForceOfManyRuns) {
  std::mt19937_64 generator(5);
  std::exponential_distribution<double> exponential;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int runs = 400;
  struct Tail {
    const char* name;
    std::function<double()> draw;
    double most; ///< stated over true scatter: bounded tails are stated too large
  };
  for (const Tail& tail : {Tail{"exponential", [&] { return exponential(generator); }, 1.2},
                           Tail{"normal", [&] { return std::abs(normal(generator)); }, 1.5},
                           Tail{"bounded", [&] { return uniform(generator); }, 40.0}}) {
    std::vector<ContactSummary> all;
    double mean = 0.0, scatter = 0.0, stated = 0.0;
    for (int run = 0; run < runs; ++run) {
      all.push_back(window_of(tail.draw));
      mean += all.back().normal_max / runs;
    }
    for (const ContactSummary& s : all) {
      scatter += (s.normal_max - mean) * (s.normal_max - mean) / (runs - 1.0);
      stated += s.error.normal_max * s.error.normal_max / runs;
    }
    EXPECT_GT(std::sqrt(stated / scatter), 0.85) << tail.name; // the scatter of 400 runs is known to 5 %
    EXPECT_LT(std::sqrt(stated / scatter), tail.most) << tail.name;
    int differ = 0;
    for (int run = 0; run + 1 < runs; ++run)
      differ += !compare(all[static_cast<std::size_t>(run)], all[static_cast<std::size_t>(run) + 1], {0.0})[6]
                     .agrees;
    EXPECT_LT(differ, 0.08 * runs) << tail.name; // 0.0455 asked for
  }
}

} // namespace batch_maxima_test
