// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Standard error of the largest value of a window, from the largest values of its batches (batch_means.hpp).
///
/// Largest values of long batches have the distribution of E. J. Gumbel (Statistics of Extremes, 1958, chapter 5),
///     P(M < x) = exp(-exp(-(x - m)/b)),   standard deviation pi b/sqrt(6),
/// where the tail of what is watched falls as an exponential or faster without end. The largest of n batches then has the same distribution,
/// with m + b ln n: the standard error of the largest value of the window is the standard deviation of those of the batches.
/// Limits: it is too large for a bounded motion and for one that is not stationary. It is too small for tails that fall as a power.
///
/// The difference D of two such values has a logistic distribution: P(|D| > k s) = 2/(1 + exp(pi k/sqrt(3))), s its standard deviation.
#pragma once
#include "post/batch_means.hpp"
#include <span>
#include <vector>

namespace fretwork::post {

/// Standard error by the largest values of batches; not a number where there are fewer than 8. Of more than 31, pairs are joined.
[[nodiscard]] double error_of_largest(std::span<const double> maxima);

/// Largest values, >= 0, of the batches of a window, which BatchEnds ends. No allocation after construction.
class BatchMaxima {
public:
  /// @param values  that are watched
  explicit BatchMaxima(std::size_t values) : current_(values, 0.0), rows_(BatchEnds::most * values) {}

  void watch(std::size_t which, double value) {
    current_[which] = value > current_[which] ? value : current_[which];
  }
  /// Ends the batch under way.
  void end_batch();
  void visit(core::StateArchive& state) { state(count_, current_, rows_); }

  /// Of the batches that have ended.
  [[nodiscard]] double error(std::size_t which) const;

private:
  std::size_t count_ = 0;
  std::vector<double> current_, rows_; ///< of the batch under way; batch after batch
};

} // namespace fretwork::post
