// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of modes under forces that depend on their motion (core/motion_forces.hpp), with a load that is linear in time:
///     q'' + C q' + k q = K_x q + C_x q' + G z + f_0 + s t,   z' = R z + E q'
/// of a block of modes and states that nothing couples to others (feedback_flow.hpp). With x = (q, v, z, f, s) its motion is x' = A x, over a step
///     x(h) = e^(A h) x(0),   int_0^h q dt = J x(0),   int_0^h v^T C v dt = x(0)^T P x(0)
/// all three by a Taylor series (P by Gauss quadrature with 8 points, exact to round-off there) over h/2^L with rate h/2^L <= 1/2 and
/// L doublings, P(2t) = P + e^(At)^T P e^(At) (C. Van Loan, IEEE Trans. Automatic Control 23 (1978) 395). Growth and decay are no special
/// cases: the step has no limit from the flow.
///
/// Works over a step are exact: those of the loads by J, the dissipation of the structure by P; the work of the forces of motion is the
/// difference to the change of kinetic and strain energy.
/// A step of m modes and r states costs (4m + r)(7m + 2r) multiplications.
#pragma once
#include "transient/scene/scene.hpp"
#include <vector>

namespace fretwork::transient {

class FeedbackBlock {
public:
  /// @param modes, states  of the block, ascending
  FeedbackBlock(const System& system, double step, std::vector<Eigen::Index> modes,
                std::vector<Eigen::Index> states);

  struct Works {
    double load = 0.0, contact = 0.0; ///< J, of both loads over the step
    double motion = 0.0;              ///< J, of the forces of motion
  };
  /// Motion of the block over the step under a load from load0 to load1 and a force from mean - slope to mean + slope.
  /// Arrays hold all modes, z all states. No allocation.
  Works advance(double* q, double* v, double* z, const double* load0, const double* load1, const double* mean,
                const double* slope);
  /// Motion a time 0 <= t <= step after q, v, z under the load f0 + t slope. No allocation.
  void inside(double t, const double* q, const double* v, const double* z, const double* f0,
              const double* slope, double* q_at, double* v_at);
  /// Adds the forces of motion where `inside` was last. No allocation.
  void add_forces(double* force) const;

private:
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(modes_.size()); }
  void start(const double* q, const double* v, const double* z);
  [[nodiscard]] double energy() const; ///< of the first 2 m values of `moved_`, J
  void make_flows(double rate);

  double step_;
  std::vector<Eigen::Index> modes_, states_;
  Eigen::Index r_;
  Eigen::VectorXd k_;
  Eigen::MatrixXd c_, a_;
  Eigen::MatrixXd forces_;              ///< m by 2m + r: [K_x C_x G]
  std::vector<Eigen::MatrixXd> halves_; ///< e^(A h/2^l), l = 0, 1 .. L
  Eigen::MatrixXd whole_;               ///< 7m + 2r by 4m + r: q, v, z at the end, J, P
  Eigen::VectorXd x_, moved_, term_, next_;
};

} // namespace fretwork::transient
