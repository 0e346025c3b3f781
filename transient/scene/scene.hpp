// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All that a transient needs, in modal coordinates: q_i'' + c_i q_i' + k_i q_i = sum of loads + sum over
/// contacts of (B^T f)_i.
#pragma once
#include "contact/support.hpp"
#include "core/types.hpp"
#include "signals/prescribed_motion.hpp"
#include "vibration/system.hpp"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace fretwork::transient {

/// A contact: a support and how the modes move its node. Displacement from the obstacle in local axes: u = b q + imposed s(t).
struct ContactPoint {
  std::string name;
  contact::Support support;
  core::Vec3 rest = core::Vec3::Zero(); ///< m: the node at q = 0, local axes, from the obstacle's centre
  Eigen::MatrixXd b;                    ///< 3 x modes, rows x_loc y_loc z_loc
  Eigen::MatrixXd imposed = {}; ///< 3 x motions of the scene: of the node less the obstacle; empty: none
  /// Modes of the columns of b: those of one structure, or of the two between which it is, ascending and apart; empty: all of the scene.
  std::vector<vibration::ModeRange> modes = {};

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
    for (const vibration::ModeRange& range : modes) {
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

/// A modal system under loads, with contacts.
struct Scene : vibration::ForcedSystem {
  std::vector<ContactPoint> contacts;
  std::vector<signals::PrescribedMotion>
      motions; ///< that carry contacts; the forces they cause on the modes are among the loads

  /// Where a contact's node stands at t = 0 for q = 0, from the obstacle's centre, m.
  [[nodiscard]] core::Vec3 place_at_start(const ContactPoint& point) const {
    core::Vec3 place = point.rest;
    for (Eigen::Index k = 0; k < point.imposed.cols(); ++k)
      place += motions[static_cast<std::size_t>(k)].displacement0 * point.imposed.col(k);
    return place;
  }
  /// Of its obstacle at t = 0 for q = 0: gap and normal.
  [[nodiscard]] contact::Location location_undeformed(const ContactPoint& point) const {
    const core::Vec3 place = place_at_start(point);
    return contact::locate(point.support.obstacle, place.y(), place.z());
  }
  /// Of its obstacle at t = 0, q = q0.
  [[nodiscard]] contact::Location location_at_start(const ContactPoint& point) const {
    const core::Vec3 place = place_at_start(point) + point.moved_by(q0);
    return contact::locate(point.support.obstacle, place.y(), place.z());
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
