// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Tube, flow and mode shapes together at points along the tube: what damping, stability and excitation are computed from.
///
///     int g(s) ds ~ sum over stations of w g(s)
/// The stations are those of Gauss-Legendre quadrature with 8 points on every interval between nodes of the tube, ends
/// of zones and rows of tables, exact for polynomials of degree 15: rho V^2 |phi|^2 has degree 9 with linear rho and V and
/// cubic shapes. V = |U_n| in a bend and densities from steam quality are smooth within an interval.
///
/// Shapes are the part of phi_i normal to the tangent. They and M_i may have any scale: no result changes where a shape is
/// multiplied by c and its modal mass by c^2. A Basis has M_i = 1 in its own units.
#pragma once
#include "flow/profile.hpp"

namespace fretwork::flow {

struct Station {
  double weight = 0.0; ///< m, w
  TubePoint tube;
  FlowPoint flow;
  Eigen::Matrix3Xd shapes; ///< 3 x modes: phi_i less its part along the tangent, global axes
};

/// Modes of vibration (static modes of a basis are left out).
struct Sampling {
  Eigen::VectorXd frequency;     ///< Hz, f_i of the tube in its fluid; 0 of a rigid-body mode
  Eigen::VectorXd modal_mass;    ///< M_i, in kg times the square of the unit of the shape
  std::vector<Station> stations; ///< by ascending s
  std::size_t zones = 0;         ///< of the profile

  [[nodiscard]] Eigen::Index modes() const { return frequency.size(); }
};

/// @param basis  of the tube in its fluid, M-orthonormal
/// @throws core::Error where the basis is that of another structure; what Profile::at throws
[[nodiscard]] Sampling sample(const Tube& tube, const Profile& profile, const modal::Basis& basis);
/// @param modal_mass  M_i of shapes of any scale, one for each true mode, > 0
/// @throws core::Error also for modal masses of wrong number or not positive
[[nodiscard]] Sampling sample(const Tube& tube, const Profile& profile, const modal::Basis& basis,
                              const Eigen::VectorXd& modal_mass);

struct TubeToSample {
  const Tube& tube;
  const Profile& profile;
  const modal::Basis& basis;
};
/// Tubes beside each other: the k-th stations of all are at the same share of their lengths, with intervals between the nodes, ends and rows of all.
[[nodiscard]] std::vector<Sampling> sample_beside(std::span<const TubeToSample> tubes);

/// int m |phi_n|^2 ds over the tube, divided by M_i: the share of a mode that moves this tube across its axis. Near 0 for
/// torsion, motion along the axis, and modes of another tube.
[[nodiscard]] Eigen::VectorXd transverse_share(const Sampling& sampling);

/// transverse_share above which a mode is assessed: what round-off and Poisson-free coupling leave of modes along the
/// axis is some 1e-12, and a mode below carries no load of the flow that matters.
inline constexpr double least_transverse_share = 1e-6;

} // namespace fretwork::flow
