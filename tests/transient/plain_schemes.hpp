// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The two schemes written again, plainly: dense matrices, no padding, no skipping, forces solved to
/// round-off.
#pragma once
#include "transient/scene.hpp"

namespace fretwork::tests {

struct PlainState {
  Eigen::VectorXd q, v;
  double friction_work = 0.0;
  int closed = 0, slid = 0; ///< contact-steps
};

/// State after `steps` actions of the splitting scheme, the last one included: at (steps - 1/2) h.
[[nodiscard]] PlainState plain_splitting(const transient::Scene& scene, double h, int steps);

/// State after `steps` steps of Euler's scheme.
[[nodiscard]] PlainState plain_euler(const transient::Scene& scene, double h, int steps);

} // namespace fretwork::tests
