// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The energy that is least in static equilibrium (static_start.hpp), its gradient and its second derivative, in the
/// coordinates x = D^(1/2) q: D the stiffness of an elastic mode, for a rigid one the sum of K_N b_c^2 over its contacts.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

/// A contact at a state.
struct Touch {
  double gap = 0.0;
  double force = 0.0; ///< F_N
  double ny = 0.0, nz = 0.0;
  double along_n = 0.0, along_t = 0.0; ///< N/m: K_N and -kappa F_N
  double energy = 0.0;
  double position = 0.0; ///< m, from the obstacle's centre
};

/// The energy of static_start.hpp and its derivatives in the coordinates x = D^(1/2) q.
class StaticEnergy {
public:
  explicit StaticEnergy(const Scene& scene);

  [[nodiscard]] Eigen::Index size() const { return spring_.size(); }
  [[nodiscard]] Eigen::VectorXd modal(const Eigen::VectorXd& x) const { return root_.cwiseProduct(x); }
  /// Part of a vector along motions that something holds.
  [[nodiscard]] Eigen::VectorXd held(const Eigen::VectorXd& x) const {
    return unseen_.cols() > 0 ? Eigen::VectorXd(x - unseen_ * (unseen_.transpose() * x)) : x;
  }
  /// The part of the loads that nothing answers; empty where there is none.
  [[nodiscard]] Eigen::VectorXd unanswered() const;

  [[nodiscard]] std::vector<Touch> touch(const Eigen::VectorXd& x) const;
  [[nodiscard]] double value(const Eigen::VectorXd& x, const std::vector<Touch>& touches) const;
  /// What the value is a sum of, without signs.
  [[nodiscard]] double magnitude(const Eigen::VectorXd& x, const std::vector<Touch>& touches) const;
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& x, const std::vector<Touch>& touches) const;
  /// Lower half of E''.
  [[nodiscard]] Eigen::MatrixXd hessian(const std::vector<Touch>& touches) const;
  /// The size of the forces that the gradient is the sum of, and of their round-off.
  struct Forces {
    double size, round_off;
  };
  [[nodiscard]] Forces forces(const Eigen::VectorXd& x, const std::vector<Touch>& touches) const;
  /// How many times `step` may be gone so that no contact crosses a good part of an obstacle that is not convex.
  [[nodiscard]] double room_along(const Eigen::VectorXd& step, const std::vector<Touch>& touches) const;
  [[nodiscard]] bool is_carried_away(const Eigen::VectorXd& x) const;
  [[nodiscard]] bool is_convex_at(const std::vector<Touch>& touches) const;

private:
  void find_unseen();
  [[nodiscard]] Eigen::VectorXd normal_row(Eigen::Index c, const Touch& t) const {
    return t.ny * rows_.row(2 * c) + t.nz * rows_.row(2 * c + 1);
  }

  const Scene& scene_;
  Eigen::VectorXd spring_; ///< 1, for rigid modes 0
  Eigen::VectorXd root_;   ///< D^(-1/2)
  Eigen::VectorXd load_;
  Eigen::MatrixXd rows_;   ///< y and z of every contact
  Eigen::MatrixXd unseen_; ///< orthonormal rigid motions that meet no contact
  double length_ = 0.0;
};

} // namespace fretwork::transient
