// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Statistics of a run against those of the same run at half the step (half the tolerance). Impacts with friction are chaotic: the two
/// motions part, their statistics scatter. The run at half the step has an error too: of order p,
///     a = x + C h^p,   b = x + C (h/2)^p,   a - b = (1 - 2^-p) (a - x),
/// so that the difference shows a share of the run's own error (L. F. Richardson, Phil. Trans. R. Soc. A 210 (1911) 307). Which p a figure of a
/// chaotic motion has at a given step cannot be told from its scatter, but p >= 1 for every scheme: the error is at most twice the difference.
/// The accuracy is asked of that bound: a figure agrees where
///     |a - b| <= k sqrt(s_a^2 + s_b^2) + accuracy/2 max(|a|, |b|)
/// with the standard errors s of batch_means.hpp. k = 2 for the sums over contacts, which chance alone exceeds with p = 0.0455. For the N figures
/// of single contacts k is such that any of them exceeds it with that p at most (Bonferroni: p/N each), so that many contacts are no reason to warn.
/// The largest force, whose difference has a logistic distribution (batch_maxima.hpp), has the k of the same p there.
/// Without standard errors (a window too short) s = 0: a single event is compared as it is.
#pragma once
#include "post/contact_statistics.hpp"
#include <string>

namespace fretwork::post {

struct ComparedFigure {
  std::string name;     ///< as in summary.json
  double value = 0.0;   ///< of the run
  double at_half = 0.0; ///< at half the step
  double error = 0.0;   ///< standard error of the difference; not a number: there is none
  bool agrees = true;
  [[nodiscard]] double difference() const { return value - at_half; }
};

constexpr std::size_t compared_of_a_contact = 9; ///< figures, as below
constexpr double factor_of_sums = 2.0;

/// k for so many figures, at least 1.
[[nodiscard]] double critical_factor(std::size_t figures);
/// Standard errors that the difference of two largest values exceeds with the same chance as a normal variable exceeds k.
[[nodiscard]] double factor_of_largest(double k);

constexpr double least_share_shown = 0.5; ///< of the run's error, by the difference from half the step: p = 1

/// What agreement is measured by.
struct Criterion {
  double accuracy; ///< of a figure, relative
  double factor = factor_of_sums;
};

/// work_rate, friction_power, impacts_per_second, contact_time_ratio, normal_force.mean, normal_force.rms, normal_force.max, displacement.y.std
/// and displacement.z.std of a contact.
[[nodiscard]] std::vector<ComparedFigure> compare(const ContactSummary& run, const ContactSummary& half,
                                                  const Criterion& criterion);

/// work_rate, friction_power and impacts_per_second of the sums over all contacts.
/// @param criterion  its factor is factor_of_sums
[[nodiscard]] std::vector<ComparedFigure> compare_sums(const std::vector<ContactSummary>& run,
                                                       const StandardErrors& run_errors,
                                                       const std::vector<ContactSummary>& half,
                                                       const StandardErrors& half_errors,
                                                       const Criterion& criterion);

} // namespace fretwork::post
