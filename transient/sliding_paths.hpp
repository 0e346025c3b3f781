// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The path of sliding contacts in a scheme whose contact forces act at instants.
///
/// At an instant t_k the velocity jumps by h W f, and a sliding contact is moved by h w, w the mean of its velocities before and after.
/// Such a scheme does not keep H = v.v/2 + V(u) but, up to h^4 (Hairer, Lubich, Wanner, Geometric Numerical Integration, IX.3),
///     H + (h^2/12) w.V''w - (h^2/24) V'.W.V',
/// from which a friction F takes h F.(w + (h^2/6) W V''w): the slider's true path. -V''w is the rate of the normal force F_N n, which
/// turns with the contact point. Without it a tube that rocks in its hole slides too little, by (h^2/6) W_tt F_N/r at a curvature 1/r:
/// work rates were 2 % low at w_c h = 0.5 (doc/benchmarks.md). The rate is the change since the last step; of W the block of the contact
/// itself. A contact that has only closed keeps the path of w.
#pragma once
#include "transient/contact_trial.hpp"

namespace fretwork::transient {

class SlidingPaths {
public:
  /// @param contacts  must live longer   @param step  s
  SlidingPaths(const PackedContacts& contacts, double step);
  /// Corrects the displacements of the contacts that slide, m; once for every step that is accepted, before its commit. No allocation.
  void correct(ContactTrial& trial);
  void visit(core::StateArchive& state) { state(push_, pushed_); }

private:
  struct Push {
    double y = 0.0, z = 0.0; ///< N, F_N n
  };
  const PackedContacts& contacts_;
  double scale_;            ///< h^2/6
  std::vector<Push> push_;  ///< at the last step
  std::vector<int> pushed_; ///< contacts where it is not 0
};

} // namespace fretwork::transient
