// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The scheme of Euler written again, plainly: dense matrices, no padding, no skipping, forces solved to
/// round-off.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::tests {

struct PlainState {
  Eigen::VectorXd q, v;
  double friction_work = 0.0;
  int closed = 0, slid = 0; ///< contact-steps
};

/// State after `steps` steps of Euler's scheme.
[[nodiscard]] PlainState plain_euler(const transient::Scene& scene, double h, int steps);

} // namespace fretwork::tests
