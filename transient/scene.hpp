// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All that a transient needs, in modal coordinates: q_i'' + c_i q_i' + k_i q_i = sum of loads + sum over
/// contacts of (B^T f)_i.
#pragma once
#include "contact/support.hpp"
#include "core/types.hpp"
#include "transient/time_function.hpp"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace fretwork::transient {

/// Modes of unit modal mass.
struct System {
  Eigen::VectorXd stiffness;      ///< n, omega^2, 1/s2, >= 0
  Eigen::VectorXd damping;        ///< n, 2 zeta omega, 1/s, >= 0
  Eigen::MatrixXd damping_matrix; ///< n x n, 1/s, replaces `damping` where it is not empty
  [[nodiscard]] Eigen::Index size() const { return stiffness.size(); }
};

struct Load {
  TimeFunction function;
  Eigen::VectorXd modal_force; ///< n: the load is modal_force * function(t)
};

/// A contact: a support and how the modes move its node. Displacement in local axes: u = b q.
struct ContactPoint {
  std::string name;
  contact::Support support;
  core::Vec3 rest = core::Vec3::Zero(); ///< m: the node at q = 0, local axes, from the obstacle's centre
  Eigen::MatrixXd b;                    ///< 3 x n, rows x_loc y_loc z_loc
};

struct Scene {
  System system;
  std::vector<Load> loads;
  std::vector<ContactPoint> contacts;
  Eigen::VectorXd q0, v0; ///< initial state, n
  double duration = 0.0;  ///< s, > 0
};

} // namespace fretwork::transient
