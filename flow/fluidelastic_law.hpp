// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fluidelastic force on a length of tube that moves by u = (drag, lift) in a cross flow of gap velocity V, N/m:
///     f = q [ K u + (D/V) C u' + sum_i Re(B_i z_i) ],   z_i' = -d_i (V/D) z_i + u',   q = rho V^2/2,  z_i(0) = 0
/// K, C, B_i, d_i without dimension, Re d_i > 0. With p = s D/V, s the Laplace variable: f/u = q (K + p C + sum B_i p/(p + d_i)), the form
/// of Roger (AGARD CP-228, 1977) without p^2: added mass is in the modes. C > 0 feeds energy in.
/// Of N tubes: u = (drag, lift of the first, of the second, ...), matrices 2N x 2N; q and V/D in a row are those of its tube.
///
/// For u = e^(iwt), kr = w D/V = 2 pi/Vr, Vr = V/(f D):  f = q (c_k u + (D/V) c_d u'),  c_k = K + sum Re B_i kr^2/(kr^2 + d_i^2),
/// c_d = C + sum B_i d_i/(kr^2 + d_i^2) for real d_i.
///
/// Quasi-steady: K from the gradients of the coefficients, C = [[-2 CD, CL], [-2 CL, -CD]], K delayed by mu D/V; e^(-mu p) is the Pade
/// approximant (3, 3) = 1 - sum alpha_i p/(p + d_i). S. Price, M. Paidoussis, J. Sound and Vibration 97 (1984) 615.
/// Quasi-unsteady: K acts by h(tau) = 1 - sum alpha_i e^(-d_i tau), tau = t V/D: B_i = -alpha_i K. S. Granger, M. Paidoussis,
/// J. Fluid Mechanics 320 (1996) 163.
/// Connors' coupling: K = kappa [[0, 1], [-1, 0]], kappa = 8 pi/K^2. Two directions of equal frequency f and decrement delta become unstable at
/// V_c/(f D) = K (m delta/(rho D^2))^(1/2), whatever the frequency: the energy of a circular orbit, with K of H. Connors (ASME 1970).
/// Table: measured c_k, c_d of lift over Vr, as the law of the form above with the least squares of its differences, c_d counted ten times.
/// Frozen at the frequency of each mode (frozen_forces.hpp): c_k and c_d of a table at the mode's own Vr under flow, no lags; or Connors' threshold as a
/// damping, c_k = 0, c_d = (4/K^2) Vr along drag and lift: zeta(V) = zeta_0 (1 - (V/V_c)^2) with the V_c above. Right at the threshold, and wrong
/// as soon as contacts change the frequency.
/// Limits: linear in u, below some 0.1 D; a tube that touches a support has the same law.
#pragma once
#include "flow/table.hpp"
#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <vector>

namespace fretwork::flow {

/// Coefficients of harmonic motion, each mode at its own reduced velocity.
struct FrozenForce {
  Table<double> stiffness = Table<double>::constant(0.0),
                damping = Table<double>::constant(0.0); ///< c_k, c_d of lift over Vr
  double connors = 0.0;                                 ///< 4/K^2: c_d/Vr along drag and lift besides
};

struct FluidelasticLaw {
  struct Lag {
    std::complex<double>
        rate;               ///< d_i; not real: z_i is complex and B_i twice what stands in f/u, for the pair
    Eigen::MatrixXcd force; ///< B_i
  };
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2, 2); ///< K, rows and columns drag, lift of each tube
  Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(2, 2);   ///< C
  std::vector<Lag> lags;
  std::optional<FrozenForce> frozen = std::nullopt;          ///< in the place of all these, of one tube
  std::optional<std::array<double, 2>> range = std::nullopt; ///< of Vr in which it was measured
  /// CD, CL of the force at rest q D (CD, CL) on each tube; none: it is left out.
  std::optional<std::array<double, 2>> steady = std::nullopt;

  [[nodiscard]] Eigen::Index tubes() const { return stiffness.rows() / 2; }
};

/// The same for each of some tubes by itself. @param one  a matrix of one tube
template <class Matrix> [[nodiscard]] Matrix for_each_tube(const Matrix& one, Eigen::Index tubes) {
  Matrix out = Matrix::Zero(one.rows() * tubes, one.cols() * tubes);
  for (Eigen::Index i = 0; i < tubes; ++i)
    out.block(i * one.rows(), i * one.cols(), one.rows(), one.cols()) = one;
  return out;
}

/// @param drag, lift  CD, CL of the steady force q D (CD, CL) on each tube   @param gradients  by u/D, [[CD_x, CD_y], [CL_x, CL_y]], of several
///     tubes by the motion of each
/// @param delay  mu >= 0
[[nodiscard]] FluidelasticLaw quasi_steady_law(double drag, double lift, const Eigen::MatrixXd& gradients,
                                               double delay);

struct Memory {
  double share; ///< alpha
  double rate;  ///< d > 0
};
[[nodiscard]] FluidelasticLaw quasi_unsteady_law(double drag, double lift, const Eigen::MatrixXd& gradients,
                                                 const std::vector<Memory>& memory);

/// @param constant  K > 0
[[nodiscard]] FluidelasticLaw connors_law(double constant);
/// The same threshold as a damping.
[[nodiscard]] FluidelasticLaw connors_damping_law(double constant);

struct MeasuredForce {
  double reduced_velocity;   ///< Vr > 0
  double stiffness, damping; ///< c_k, c_d
};
/// A table frozen at the frequency of each mode: linear between its rows, constant beyond.
/// @param rows  of different Vr, at least one
[[nodiscard]] FluidelasticLaw frozen_law(std::vector<MeasuredForce> rows);

/// A table as lags, and how far it is from its rows.
struct FittedLaw {
  FluidelasticLaw law;          ///< of lift; its range is that of the rows
  double stiffness_error = 0.0; ///< largest difference of c_k
  double damping_error = 0.0;   ///< and of c_d
};
/// @param rows  of different Vr, at least lags + 1
/// @param lags  1 to 3: their rates are those of 16 values between a fifth of the least kr and the largest that fit best
[[nodiscard]] FittedLaw fitted_law(const std::vector<MeasuredForce>& rows, int lags);

} // namespace fretwork::flow
