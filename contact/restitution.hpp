// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Contact constants from what a user knows: the loss of an impact, the wall of a tube.
///
/// A free mass m that meets the law of the reference at any speed v leaves at e v, where its force is zero
/// (R5.06.03 eq. 3.1-4, the positive part included); with xi = C_N/(2 sqrt(K_N m)),
///     e = exp(-2 xi acos(xi)/sqrt(1 - xi^2))   xi < 1        e = exp(-2)   xi = 1
///     e = exp(-2 xi acosh(xi)/sqrt(xi^2 - 1))  xi > 1
/// e falls from 1 (xi = 0) to 0 as xi grows: the inverse is unique.
/// With Hunt and Crossley's damper, neither K_N nor m counts: with x = d v,
///     x (1 + e) = ln((1 + x)/(1 - e x)),  so that e depends on the speed of impact.
#pragma once

namespace fretwork::contact {

/// xi of 0 < e <= 1, exact to round-off. @throws core::Error for e outside
[[nodiscard]] double ratio_of_restitution(double e);
/// C_N, N s/m, of a mass m (kg) on K_N (N/m) that comes back with e. @throws core::Error for e, K_N or m
/// outside
[[nodiscard]] double damping_of_restitution(double e, double stiffness, double mass);

/// e of Hunt and Crossley's law for x = d v >= 0.
[[nodiscard]] double restitution_of_dissipation(double x);
/// d, s/m, that gives e (0 < e <= 1) at the speed v (m/s, > 0). @throws core::Error for e or v outside
[[nodiscard]] double dissipation_of_restitution(double e, double speed);

/// Stiffness of a tube's wall under a local radial load, by ovalisation, N/m:
///     K = 1.9 (E t^2/D) sqrt(t/D),  E Young's modulus (Pa), t wall thickness (m), D outer diameter (m).
/// As used for steam generator tubes by Axisa, Antunes and Villard (J. Pressure Vessel Technol. 110, 1988).
/// @throws core::Error for a size or modulus that is not > 0, or a wall of half the diameter or more
[[nodiscard]] double wall_stiffness(double young_modulus, double outer_diameter, double thickness);

} // namespace fretwork::contact
