// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What limits the automatic step (step_rule.hpp): shares of the rates of a scene that each scheme has to resolve.
#pragma once
#include "transient/step_rule.hpp"

namespace fretwork::transient {

/// A limit of the step and where it comes from.
struct StepLimit {
  double limit; ///< s
  std::string reason;
  std::string cure = {}; ///< what makes the step longer, after "resolved for an accuracy of 0.01"
};

/// What limits the step, the highest mode where contacts meet exact flows apart.
/// @param choice  with its rates and scheme   @param fineness  1 at an accuracy of 0.01, as its square root
[[nodiscard]] std::vector<StepLimit> step_limits(const StepChoice& choice, const Scene& scene,
                                                 double fineness);
/// What the highest mode asks of the step.
[[nodiscard]] StepLimit mode_limit(const StepChoice& choice, bool contacts, double fineness);
/// w h of modes that splitting follows in a step: fewer where tangential dampers stop contacts within it, as (S1) then overestimates their velocity and
/// contacts that stick are unstable (doc/schemes.md, Limits).
[[nodiscard]] double followed_modes(const StepChoice& choice, double step);

/// The modes move exactly between the contact impulses.
[[nodiscard]] bool moves_exactly(SchemeKind scheme);
/// Points in a period of the excitation at an accuracy of 0.01, with contacts: loads linear between them lose (2 pi/30)^2/12 = 0.4 % of it.
constexpr double points_per_period = 30.0;
/// The same of single steps of splitting under loads whose polygons have the corners that give what lines take off (vibration/load_sum.hpp): harmonic loads lose
/// nothing, random ones (2 pi/10)^4/240 = 0.07 % at the highest frequency. And the fewest, whatever the accuracy.
constexpr double corrected_points_per_period = 10.0, fewest_points_per_period = 10.0;

/// Largest w_c h and w_t h without a warning: above it an impact changes the energy by more than 1 % or the statistics are wrong, however
/// stable the run (doc/schemes.md, Stability map).
[[nodiscard]] double most_resolved(SchemeKind scheme);
/// Largest r_t h where dampers are implicit, with splitting r_t dt of its intervals: above it sticking contacts ring.
[[nodiscard]] double most_implicit(SchemeKind scheme);
/// Intervals that a step of splitting has at most.
constexpr double most_intervals = 64.0;
/// What r_t h, with splitting r_t dt of its intervals, is to be at most. Where dampers are implicit, above 2 the speed of a sticking contact
/// turns round, 0.52 of it at 6.3. @param fineness  1 at an accuracy of 0.01, as its square root
[[nodiscard]] double damper_share(SchemeKind scheme, double fineness);
/// r_n dt of the intervals of splitting: the force of an impact then falls within one as a parabola (contact/normal_interval.cpp) that has its
/// largest value; above 1.9 only its mean is right.
constexpr double normal_damper_share = 1.8;
/// Largest r_n h of schemes that take normal dampers implicitly: of splitting in all intervals of a step; with collocation a tenth of the speed of a
/// mass is left at 4, where 0.02 is right.
[[nodiscard]] double most_normally_damped(SchemeKind scheme);
/// Of a damper's rate times the step of devogelaere, whose limit is 0.59.
constexpr double most_damped = 0.5;

} // namespace fretwork::transient
