// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Damping of tubes in still or flowing fluid: the correlations, one by one, as ratios to critical damping.
///
/// N spans, L_s length of a support along the tube, l_m mean of the three longest spans, m mass per length with all
/// fluid, f Hz in the fluid; support factor c = (N - 1)/N sqrt(L_s/l_m).
///     gas, supports        xi = 0.050 c                                               (1), replaces all others in gas
///     viscous              xi_V = (pi/sqrt 8)(rho D^2/m) sqrt(2 nu/(pi f D^2)) B      (2)
///                          B = (1 + q^-3)/(1 - q^-2)^2, q = De/D; pi f D^2/(2 nu) > 3300, q > 2
///     squeeze film         xi_SF = c (14.60 Hz/f)(rho D^2/m)                          (3)
///     friction in liquid   xi_F = 0.005 c                                             (4)
///     two-phase            xi_TP = 0.040 (rho_l D^2/m) h(alpha) B                     (5)
///                          h = alpha/0.4 below 0.4, 1 up to 0.7, (1 - alpha)/0.3 above
/// In two-phase flow rho and nu of (2) and (3) are those of the mixture. The total in liquid and two-phase flow is at
/// least 0.006 and at most 0.05; in gas there is no floor.
///
/// Sources: (1) M. Pettigrew, H. Goyder, Z. Qiao, F. Axisa, Damping of multispan heat exchanger tubes, ASME PVP 104
/// (1986) 81; equals the decrement 0.314 of TEMA. (2) with B = 1 is Stokes' oscillating boundary layer; B, (3), (4) and
/// the viscosity of mixtures: M. Pettigrew, R. Rogers, F. Axisa, Damping of heat exchanger tubes in liquids, Journal of
/// Pressure Vessel Technology 133 (2011) 014002. (5): M. Pettigrew, C. Taylor, Damping of heat exchanger tubes in
/// two-phase flow, Journal of Pressure Vessel Technology 126 (2004) 523. Floor and ceiling: M. Pettigrew, C. Taylor,
/// N. Fisher, Flow-Induced Vibration Handbook for Nuclear and Process Equipment (2021), at eq. 2-18.
#pragma once
#include <vector>

namespace fretwork::flow {

inline constexpr double gas_support_damping = 0.050;                ///< (1)
inline constexpr double squeeze_film_frequency = 14.60;             ///< Hz, (3)
inline constexpr double liquid_friction_damping = 0.005;            ///< (4)
inline constexpr double two_phase_damping_level = 0.040;            ///< (5)
inline constexpr double void_rise_end = 0.4, void_fall_begin = 0.7; ///< alpha between which h = 1, (5)
inline constexpr double least_total_damping = 0.006, greatest_total_damping = 0.05;
inline constexpr double least_stokes_number = 3300.0; ///< of pi f D^2/(2 nu), (2)

/// Supports between the ends of a tube. The ends, in tube sheets or pins, are no supports.
struct SpanLayout {
  int spans = 1;          ///< N
  double mean_span = 1.0; ///< m, l_m
};
/// Spans between the supports and the ends of the tube, N = supports + 1; l_m is the mean of the three longest, of all
/// where there are fewer.
/// @param supports  m, their middles, in any order
/// @throws core::Error for a support off the tube
[[nodiscard]] SpanLayout span_layout(std::vector<double> supports, double tube_length);

/// c.
/// @param support_length  m, L_s >= 0
[[nodiscard]] double support_factor(const SpanLayout& layout, double support_length);

/// B.
/// @param confinement_ratio  q > 1; infinite: 1
[[nodiscard]] double viscous_confinement(double confinement_ratio);

/// pi f D^2/(2 nu).
[[nodiscard]] double stokes_number(double frequency, double diameter, double viscosity);

/// @param mass_ratio  rho D^2/m   @param stokes  pi f D^2/(2 nu) > 0   @param confinement  B
[[nodiscard]] double viscous_damping(double mass_ratio, double stokes, double confinement);

/// @param support  c   @param frequency  Hz, > 0   @param mass_ratio  rho D^2/m
[[nodiscard]] double squeeze_film_damping(double support, double frequency, double mass_ratio);

/// h(alpha).
[[nodiscard]] double void_shape(double void_fraction);

/// @param liquid_mass_ratio  rho_l D^2/m   @param confinement  B
[[nodiscard]] double two_phase_damping(double liquid_mass_ratio, double void_fraction, double confinement);

} // namespace fretwork::flow
