// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Anderson's mixing of a fixed-point iteration x <- g(x): the next x is the combination of the last iterations whose residuals g - x, were g linear, would
/// add up to least. Where sweeps converge slowly, or not at all, because few unknowns answer each other strongly, it takes about as many
/// iterations as there are of these.
/// Source: D. G. Anderson, J. ACM 12, 1965, p. 547; H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49, 2011, p. 1715.
#pragma once
#include <Eigen/Core>

namespace fretwork::transient {

class AndersonMixing {
public:
  /// @param most  unknowns at most
  explicit AndersonMixing(Eigen::Index most);

  /// Another iteration, of n unknowns.
  void restart(Eigen::Index n);
  /// Takes x and g(x), gives the next x. A residual that has grown is taken for a kink: what is known before it is forgotten. No allocation.
  void next(Eigen::VectorXd& x, const Eigen::VectorXd& g);

private:
  static constexpr Eigen::Index depth = 8; ///< iterations combined
  Eigen::Index n_ = 0;
  int known_ = 0, at_ = 0; ///< differences, and which is the next to be replaced
  double size_ = 0.0;      ///< of the last residual
  bool first_ = true;      ///< there is no iteration before
  Eigen::VectorXd last_g_, last_r_, r_;
  Eigen::MatrixXd dg_, dr_; ///< differences of g and of the residual from iteration to iteration
};

} // namespace fretwork::transient
