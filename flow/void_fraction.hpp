// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Void fraction alpha of a two-phase flow across a bundle, from its steam quality x.
///
///     alpha = 1/(1 + S (rho_g/rho_l)(1 - x)/x)
/// homogeneous: S = 1, both phases at one velocity.
/// Feenstra: S = 1 + 25.7 sqrt(Ri Ca) D/P, the velocity ratio of the phases,
///     Ri = (rho_l - rho_g)^2 g (P - D)/G_p^2,   Ca = mu_l x G_p/(alpha rho_g sigma)
/// S depends on alpha: alpha = F(alpha) is solved by bracketing. F grows as sqrt(alpha) from the spurious root 0, and
/// F(1) < 1, so that one root lies above.
///     rho = alpha rho_g + (1 - alpha) rho_l,   nu = nu_l/(1 + alpha (nu_l/nu_g - 1))
/// Source: P. Feenstra, D. Weaver, R. Judd, An improved void fraction model for two-phase cross-flow in horizontal tube
/// bundles, International Journal of Multiphase Flow 26 (2000) 1851; viscosity: M. Pettigrew, R. Rogers, F. Axisa,
/// Journal of Pressure Vessel Technology 133 (2011) 014002.
/// Range: 0 < x < 1; at x = 0 and 1 the limits alpha = 0 and 1 are returned.
#pragma once

namespace fretwork::flow {

/// Of both phases, SI.
struct Phases {
  double liquid_density = 0.0, gas_density = 0.0;     ///< kg/m3, rho_l > rho_g > 0
  double liquid_viscosity = 0.0, gas_viscosity = 0.0; ///< m2/s, kinematic, nu_l and nu_g > 0
  double surface_tension = 0.0;                       ///< N/m, sigma; Feenstra only
  double gravity = 9.81;                              ///< m/s2, g; Feenstra only
};

[[nodiscard]] double homogeneous_void_fraction(double quality, double liquid_density, double gas_density);

/// What Feenstra's velocity ratio needs.
struct CrossFlow {
  double mass_flux; ///< kg/m2/s, G_p > 0, through the gaps (pitch mass flux)
  double diameter;  ///< m, D > 0
  double pitch;     ///< m, P > D
};
struct VoidFraction {
  double alpha;
  double velocity_ratio; ///< S
};
/// @throws core::Error for a quality outside [0, 1] or data that are not positive; core::ComputationError where the
///         iteration does not converge
[[nodiscard]] VoidFraction feenstra_void_fraction(double quality, const Phases& phases,
                                                  const CrossFlow& flow);

/// kg/m3, of the homogeneous mixture.
[[nodiscard]] double mixture_density(double void_fraction, const Phases& phases);
/// m2/s, kinematic.
[[nodiscard]] double mixture_viscosity(double void_fraction, const Phases& phases);

} // namespace fretwork::flow
