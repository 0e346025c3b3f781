// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Stability diagram of modes under fluidelastic forces: the roots of x' = A x, x = (a, a', z) (fluidelastic.hpp), over a factor of all velocities.
///
/// Roots are followed by the shares P_jk = (V_2^-1 V_1)_jk (V_1^-1 V_2)_kj of their left and right eigenvectors V at neighbouring factors,
/// whatever the scale of the unknowns; a step in which a mode keeps less than half of its share is halved, three times at most. At the smallest factor a mode has the pair of roots
/// in which it takes part most. A crossing, real part 0, is found along its root by the secant rule of Illinois. All roots are followed, those of
/// lags too, so that windows of instability wider than a step of the factor are found whole. A root that crosses at 0 is divergence:
/// det(omega^2 - K_x) = 0.
/// Source: left and right vectors: M. Eldred, V. Venkayya, W. Anderson, AIAA J. 33 (1995) 1292; participation of modes in roots: I. Perez-Arriaga,
/// G. Verghese, F. Schweppe, IEEE Trans. PAS-101 (1982) 3117.
#pragma once
#include "flow/fluidelastic.hpp"
#include <complex>
#include <vector>

namespace fretwork::flow {

struct Crossing {
  double factor = 0.0;       ///< of all velocities; 0: unstable however slow the flow
  std::complex<double> root; ///< 1/s, real part 0, imaginary part >= 0; 0: divergence
  Eigen::Index mode = -1;    ///< -1: a root of the lags
  bool to_unstable = false;  ///< as the factor rises
};

struct StabilityDiagram {
  std::vector<double> factors; ///< ascending, >= 0
  Eigen::MatrixXcd
      roots; ///< 1/s, rows by factors, columns by modes; of a pair that of positive imaginary part
  std::vector<Crossing> crossings; ///< by ascending factor, from 0 to the last one

  /// Where the first root becomes unstable; none: nowhere.
  [[nodiscard]] const Crossing* critical() const;
};

/// Hz, |s|/(2 pi), and the ratio -Re s/|s|, 0 of a root of 0.
[[nodiscard]] double frequency_of(std::complex<double> root);
[[nodiscard]] double damping_of(std::complex<double> root);

/// @param k, c     1/s2 and 1/s, n stiffnesses and dampings of the modes of unit mass
/// @param forces   over the factor
/// @param factors  ascending, >= 0, the last > 0
/// @throws core::ComputationError where eigenvalues do not converge
[[nodiscard]] StabilityDiagram stability_diagram(const Eigen::VectorXd& k, const Eigen::VectorXd& c,
                                                 const ForcesOverFactor& forces, std::vector<double> factors);

} // namespace fretwork::flow
