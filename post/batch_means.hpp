// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Standard errors of means over time, from one run. A window of length T is cut into consecutive batches b of lengths T_b, in which
/// the integral of x is X_b:
///     m = sum X_b / T,   e_b = X_b - m T_b,   n = 1 / sum (T_b/T)^2
///     standard error^2 = f sum e_b^2 / T^2 / (1 - 1/n) / (1 - (f - 1)/(n - 1))
/// n is the effective number of batches, their number where they are equally long. Where batches are independent f = 1, variances of their
/// means being as 1/T_b, and the estimate of the square has no bias, whatever their lengths.
/// Of more than 31 batches pairs are joined: a weak slow motion beside a fast one shows in long batches.
/// Batches that are shorter than the memory of the motion follow one another. Their correlation is that of neighbours, less the bias of a
/// window of n batches (F. H. C. Marriott and J. A. Pope, Biometrika 41 (1954) 390):
///     r' = sum e_b e_(b+1) / sum e_b^2,   r = r' + (1 + 3 r')/n,   cut to -0.35..0.8
/// f is that of a memory exp(-t/tau), whose batches of length a tau have
///     r = (1 - e^-a)^2 / (2 (a - 1 + e^-a)),   f = a / (a - 1 + e^-a);   f = 1 + 2 r for r <= 0.
/// The last factor is what the mean of the window takes of the scatter about it.
/// Degrees of freedom: the relative variance of sum e_b^2 is 2 (1 + r^2)/(n (1 - r^2)), that of f, of an autoregression of order 1,
/// 4/(n (1 - r^2)); both together are those of a chi-squared variable with n (1 - r^2)/(3 + r^2) degrees of freedom, at least 2. Intervals
/// take Student's t with them.
/// Limits: it is the scatter of a stationary motion; of a window with a single event it says only that there is no more than one. A weak
/// motion that remembers far longer than the rest is seen where its batches stand out (measured: doc/benchmarks.md, Coverage).
#pragma once
#include "core/state_archive.hpp"
#include <cstddef>
#include <span>
#include <vector>

namespace fretwork::post {

struct BatchEstimate {
  double error;   ///< of the mean, in its unit; not a number where there are fewer than 8 batches
  double batches; ///< degrees of freedom of the error + 1; n where it has none
};

/// @param lengths  T_b, s   @param sums  X_b
[[nodiscard]] BatchEstimate batch_means(std::span<const double> lengths, std::span<const double> sums);

/// The error of a standard deviation, which moves by d(s^2)/(2 s).
/// @param first, squares  in each batch the integrals of d and of d^2, d being the signal less a constant
/// @param shift  mean of d over the window   @param deviation  s of the window
[[nodiscard]] BatchEstimate batch_deviation(std::span<const double> lengths, std::span<const double> first,
                                            std::span<const double> squares, double shift, double deviation);

/// Batches of a window: lengths, s, and for each sum what each batch adds to it.
struct BatchSums {
  std::vector<double> lengths;
  std::vector<std::vector<double>> sums;
};

/// What some sums over time have come to at the ends of batches. Constant memory, no allocation after construction: as many as `most`
/// batches are kept, then pairs are joined and later batches are twice as long.
class BatchEnds {
public:
  static constexpr std::size_t most = 64;

  explicit BatchEnds(std::size_t sums) : sums_(sums), times_(most), rows_(most * sums) {}

  /// Whether a batch is to end; the first record may stand for no time.
  [[nodiscard]] bool due(double elapsed) const { return elapsed >= next_ && elapsed > 0.0; }
  /// Ends a batch where it is time for it. A record longer than a batch is a batch of its own.
  /// @param elapsed  s, since the window began, growing   @param fill  writes the sums so far to the row it is given
  template <class Fill> void watch(double elapsed, Fill fill) {
    if (!due(elapsed))
      return;
    fill(rows_.data() + count_ * sums_);
    times_[count_++] = elapsed;
    if (count_ == 1)
      length_ = elapsed;
    if (count_ == most)
      join_pairs();
    next_ = elapsed + length_ * (1.0 - round_off);
  }

  void visit(core::StateArchive& state) { state(count_, length_, next_, times_, rows_); }

  /// The batches of the window: those that have ended, and the rest.
  /// @param elapsed  s, length of the window   @param fill  as for `watch`
  template <class Fill> [[nodiscard]] BatchSums batches(double elapsed, Fill fill) const {
    std::vector<double> row(sums_);
    fill(row.data());
    return batches_with_rest(elapsed, row);
  }

  /// Batches that have ended.
  [[nodiscard]] std::size_t size() const { return count_; }
  /// End of a batch, s since the window began.
  [[nodiscard]] double time(std::size_t batch) const { return times_[batch]; }
  /// A sum at the end of a batch, since the window began.
  [[nodiscard]] double sum(std::size_t batch, std::size_t which) const {
    return rows_[batch * sums_ + which];
  }

private:
  /// Of a batch: sums of steps do not meet its end to the last digit.
  static constexpr double round_off = 1e-6;

  void join_pairs();
  [[nodiscard]] BatchSums batches_with_rest(double elapsed, std::span<const double> row) const;

  std::size_t sums_, count_ = 0;
  double length_ = 0.0, next_ = 0.0; ///< s
  std::vector<double> times_, rows_;
};

} // namespace fretwork::post
