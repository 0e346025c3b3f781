// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All that a transient needs, in modal coordinates: q_i'' + c_i q_i' + k_i q_i = sum of loads + sum over
/// contacts of (B^T f)_i.
#pragma once
#include "contact/support.hpp"
#include "core/motion_forces.hpp"
#include "core/types.hpp"
#include "signals/prescribed_motion.hpp"
#include "signals/sampled_load.hpp"
#include "signals/time_function.hpp"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace fretwork::transient {

/// Modes of unit modal mass.
struct System {
  Eigen::VectorXd stiffness;      ///< n, omega^2, 1/s2, >= 0
  Eigen::VectorXd damping;        ///< n, 2 zeta omega, 1/s, >= 0
  Eigen::MatrixXd damping_matrix; ///< n x n, 1/s, replaces `damping` where it is not empty
  core::MotionForces motion = {}; ///< of the fluid; empty: none
  [[nodiscard]] Eigen::Index size() const { return stiffness.size(); }
  /// That of the modes one by one: none where the matrix has it.
  [[nodiscard]] Eigen::VectorXd lone_damping() const {
    return damping_matrix.size() == 0 ? damping : Eigen::VectorXd::Zero(size());
  }
};

struct Load {
  signals::TimeFunction function;
  Eigen::VectorXd modal_force; ///< n: the load is modal_force * function(t)
  /// -M a of a base or support that accelerates, or the force of dampers that a support's velocity stretches: no part of a static equilibrium
  bool inertial = false;
};

/// Modes that follow each other, such as those of a structure.
struct ModeRange {
  Eigen::Index first = 0, size = 0;
};

/// A contact: a support and how the modes move its node. Displacement from the obstacle in local axes: u = b q + imposed s(t).
struct ContactPoint {
  std::string name;
  contact::Support support;
  core::Vec3 rest = core::Vec3::Zero(); ///< m: the node at q = 0, local axes, from the obstacle's centre
  Eigen::MatrixXd b;                    ///< 3 x modes, rows x_loc y_loc z_loc
  Eigen::MatrixXd imposed = {}; ///< 3 x motions of the scene: of the node less the obstacle; empty: none
  /// Modes of the columns of b: those of one structure, or of the two between which it is, ascending and apart; empty: all of the scene.
  std::vector<ModeRange> modes = {};

  /// b q.   @param q  n
  template <class Vector> [[nodiscard]] core::Vec3 moved_by(const Vector& q) const {
    if (modes.empty())
      return b * q;
    core::Vec3 u = core::Vec3::Zero();
    for_ranges([&](Eigen::Index first, const auto& part) { u += part * q.segment(first, part.cols()); });
    return u;
  }
  /// Each range's columns of b, called with the range's first mode.
  template <class Visit> void for_ranges(const Visit& visit) const {
    if (modes.empty()) {
      visit(Eigen::Index{0}, b.leftCols(b.cols()));
      return;
    }
    Eigen::Index column = 0;
    for (const ModeRange& range : modes) {
      visit(range.first, b.middleCols(column, range.size));
      column += range.size;
    }
  }
  /// b over all modes.   @param n  modes of the scene
  [[nodiscard]] Eigen::MatrixXd over_all(Eigen::Index n) const {
    if (modes.empty())
      return b;
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3, n);
    for_ranges([&](Eigen::Index first, const auto& part) { out.middleCols(first, part.cols()) = part; });
    return out;
  }
};

struct Scene {
  System system;
  std::vector<Load> loads;
  std::vector<signals::SampledLoad> sampled_loads; ///< random, of zero mean
  std::vector<ContactPoint> contacts;
  std::vector<signals::PrescribedMotion>
      motions;            ///< that carry contacts; the forces they cause on the modes are among the loads
  Eigen::VectorXd q0, v0; ///< initial state, n
  double duration = 0.0;  ///< s, > 0

  /// Where a contact's node stands at t = 0 for q = 0, from the obstacle's centre, m.
  [[nodiscard]] core::Vec3 place_at_start(const ContactPoint& point) const {
    core::Vec3 place = point.rest;
    for (Eigen::Index k = 0; k < point.imposed.cols(); ++k)
      place += motions[static_cast<std::size_t>(k)].displacement0 * point.imposed.col(k);
    return place;
  }
};

/// The same scene, its contacts over all modes.
[[nodiscard]] inline Scene over_all_modes(Scene scene) {
  for (ContactPoint& point : scene.contacts) {
    point.b = point.over_all(scene.system.size());
    point.modes.clear();
  }
  return scene;
}

} // namespace fretwork::transient
