// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/line_kernels.hpp"
#include "flow/philox.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace line_kernels_test {

using namespace fretwork::flow;

namespace {

struct alignas(64) Group {
  double re[group_lines], im[group_lines];
};

Group drawn(const LineSequence& sequence, std::uint32_t group) {
  Group out;
  draw_lines(sequence, group, out.re);
  return out;
}

constexpr double to_turns = 0x1p-32;

} // namespace

TEST(Philox, HasTheKnownAnswersOfRandom123) {
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t all = 0xffffffff;
  EXPECT_EQ(philox({all, all, all, all}, {all, all}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Lines, AreThoseOfTheirCounters) {
  constexpr double tolerance = 2e-13; // series of logarithm, sine and cosine; |e| up to 7
  for (const bool phase_only : {false, true})
    for (std::uint32_t group = 0; group < 20; ++group) {
      const LineSequence s{7, 3, 11, 5, 2, phase_only};
      const Group e = drawn(s, group);
      for (std::uint32_t l = 0; l < group_lines; ++l) {
        const auto words = philox({32 * group + l % 32, s.block, s.point, s.stream}, {s.seed, s.draw});
        const std::uint32_t x = words[l < 32 ? 0 : 2], y = words[l < 32 ? 1 : 3];
        const double r = phase_only ? std::sqrt(2.0) : std::sqrt(-2.0 * std::log((x + 0.5) * to_turns));
        const double theta = 2.0 * std::numbers::pi * y * to_turns;
        EXPECT_NEAR(e.re[l], r * std::cos(theta), tolerance);
        EXPECT_NEAR(e.im[l], r * std::sin(theta), tolerance);
      }
    }
}

TEST(Lines, AreNormalAndIndependent) {
  double m1 = 0, m2 = 0, m4 = 0, product = 0, next = 0, other = 0;
  double count = 0;
  for (std::uint32_t group = 0; group < 5000; ++group) {
    const Group e = drawn({1, 0, 0, 0, 0, false}, group),
                of_next_patch = drawn({1, 0, 0, 1, 0, false}, group);
    for (int l = 0; l < group_lines; ++l) {
      const double a = e.re[l], b = e.im[l];
      m1 += a + b;
      m2 += a * a + b * b;
      m4 += a * a * a * a + b * b * b * b;
      product += a * b;
      next += l > 0 ? a * e.re[l - 1] : 0.0;
      other += a * of_next_patch.re[l];
      count += 1.0;
    }
  }
  // three standard deviations for 320000 pairs
  EXPECT_NEAR(m1 / (2 * count), 0.0, 3.0 / std::sqrt(2 * count));
  EXPECT_NEAR(m2 / (2 * count), 1.0, 3.0 * std::sqrt(2.0 / (2 * count)));
  EXPECT_NEAR(m4 / (2 * count), 3.0, 3.0 * std::sqrt(96.0 / (2 * count)));
  for (const double sum : {product, next, other})
    EXPECT_NEAR(sum / count, 0.0, 3.0 / std::sqrt(count));
}

TEST(Lines, FollowOneAnotherAsAMarkovSequence) {
  constexpr double r = 0.8;
  alignas(64) double amplitude[group_lines], z[group_size], y[group_size];
  std::fill_n(amplitude, group_lines, 2.0);
  double variance = 0.0, neighbours = 0.0, count = 0.0;
  for (std::uint32_t group = 0; group < 2000; ++group) {
    std::fill_n(z, group_size, 0.0);
    std::vector<double> before(group_size, 0.0);
    for (std::uint32_t k = 0; k < 5; ++k) {
      advance_lines({1, 0, 0, k, 0, false}, group, k == 0 ? 0.0 : r, amplitude, z, y);
      for (int l = 0; l < group_size; ++l) {
        EXPECT_EQ(y[l], 2.0 * z[l]);
        if (k > 0) {
          variance += z[l] * z[l];
          neighbours += z[l] * before[static_cast<std::size_t>(l)];
          count += 1.0;
        }
        before[static_cast<std::size_t>(l)] = z[l];
      }
    }
  }
  constexpr double tolerance =
      0.008; // three standard deviations: a million numbers correlated over some five
  EXPECT_NEAR(variance / count, 1.0, tolerance);
  EXPECT_NEAR(neighbours / count, r, tolerance);
}

TEST(Lines, AreProjectedAsByAProductOfMatrices) {
  constexpr int blocks = 3, points = 7;
  alignas(64) double lines[points * group_size], sums[blocks * mode_block * group_size];
  std::vector<double> shapes(blocks * mode_block * points);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    shapes[i] = std::sin(1.0 + 3.0 * static_cast<double>(i));
  for (int i = 0; i < points * group_size; ++i)
    lines[i] = std::cos(2.0 + 0.7 * i);
  std::fill_n(sums, blocks * mode_block * group_size, 1.0);
  project_lines(blocks, points, shapes.data(), lines, sums, group_size);
  constexpr double round_off = 1e-14;
  for (int mode = 0; mode < blocks * mode_block; ++mode)
    for (int l = 0; l < group_size; ++l) {
      double sum = 1.0;
      for (int k = 0; k < points; ++k)
        sum += shapes[static_cast<std::size_t>((mode / mode_block * points + k) * mode_block +
                                               mode % mode_block)] *
               lines[k * group_size + l];
      EXPECT_NEAR(sums[mode * group_size + l], sum, round_off);
    }
}

} // namespace line_kernels_test
