// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fluid-elastic stability of a tube by Connors' formula, weighted by the mode shapes.
///
/// Uniform flow over the whole tube: unstable above V_c = K f D sqrt(m delta/(rho D^2)), delta = 2 pi xi/sqrt(1 - xi^2).
/// Any profile, mode i, zones z with constants K_z:
///     E_iz = int_zone rho V^2 |phi_n|^2 ds,   R_i = sqrt( sum_z E_iz/K_z^2 / (f_i^2 delta_i M_i) )
/// unstable for R_i >= 1. R is linear in the velocities: the whole profile times 1/R_i is critical, the margin is 1 - R_i.
///     V_eff,i = sqrt( sum_z E_iz / int rho |phi_n|^2 ds ),   V_c,i = V_eff,i/R_i
/// f_i, xi_i in the fluid; neither changes with V.
/// `component` replaces |phi_n|^2 by the square of one component of phi_n: along drag e_D, lift e_L or a given axis.
/// Where the flow has no direction across the tube, drag and lift are 0.
///
/// Source: H. Connors, Fluidelastic vibration of tube arrays excited by cross flow, ASME 1970; weighting by modes: energy
/// of one period, e.g. Au-Yang, Flow-Induced Vibration of Power and Process Plant Components, chapter 7.
/// Limits: an envelope of measurements, not a law of motion; beyond R = 1 the amplitude is not given.
#pragma once
#include "flow/connors_constant.hpp"
#include "flow/sampling.hpp"
#include <optional>

namespace fretwork::flow {

struct Component {
  enum class Kind { normal, drag, lift, axis };
  Kind kind = Kind::normal;
  Vec3 axis = Vec3::Zero(); ///< of Kind::axis, any length but 0, global axes
};

/// What a mode brings into every case.
struct ModeInFlow {
  double frequency = 0.0;          ///< Hz
  double damping = 0.0;            ///< ratio, xi_i
  double decrement = 0.0;          ///< delta_i
  double effective_velocity = 0.0; ///< m/s, V_eff,i
  std::vector<double> energies;    ///< E_iz by zones, in the unit of the shape squared times Pa m
};

/// One combination of constants.
struct StabilityCase {
  std::vector<double> constants; ///< K_z by zones; 0 of a zone without velocity, which needs none
  Eigen::VectorXd ratio; ///< R_i; 0 where the flow does not meet the mode, infinite of a rigid-body mode
  Eigen::VectorXd critical_velocity; ///< m/s, V_c,i; 0 where R_i = 0
  Eigen::Index critical_mode =
      -1; ///< of the largest R_i; -1 where no mode moves in a velocity across the tube

  /// 1/R of the critical mode: the factor of all velocities at which the tube becomes unstable; infinite where R = 0.
  [[nodiscard]] double critical_scale() const;
  /// 1 - R of the critical mode; none where no mode moves in a velocity across the tube: nothing is assessed.
  [[nodiscard]] std::optional<double> margin() const;
};

struct Stability {
  std::vector<ModeInFlow> modes;
  std::vector<StabilityCase> cases; ///< all combinations, the last zone's constants change fastest
};

/// Combinations of constants that are tabulated at most.
inline constexpr std::size_t most_stability_cases = 1000;

/// @param damping  xi_i, one for each mode, in (0, 1) where the flow meets the mode: Damping::stability() or the user's own
/// @throws core::Error for ratios of wrong number or range, a zone with velocity and no K, more than 1000 combinations,
///         an axis of no length, and drag or lift where a zone names no direction
[[nodiscard]] Stability stability(const Profile& profile, const Sampling& sampling,
                                  const Eigen::VectorXd& damping, const Component& component = {});

/// R_i of a case with all velocities times each factor: rows by factors, columns by modes.
/// @param factors  >= 0
/// @throws core::Error for a factor that is negative or not finite
[[nodiscard]] Eigen::MatrixXd velocity_sweep(const StabilityCase& of, std::span<const double> factors);

} // namespace fretwork::flow
