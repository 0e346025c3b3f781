// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Added mass of a tube among others, and the velocities of a bundle.
///
///     m_a = C_m rho pi D^2/4,   C_m = (q^2 + 1)/(q^2 - 1),   q = De/D
/// C_m is that of potential flow between the tube and a circle of diameter De about it. De stands for the bundle:
///     triangles (30 and 60 degrees): q = (0.96 + 0.50 P/D) P/D
///     squares (45 and 90 degrees):   q = (1.07 + 0.56 P/D) P/D
///     a single tube:                 q infinite, C_m = 1
/// Source: R. Rogers, C. Taylor, M. Pettigrew, Fluid effects on multi-span heat-exchanger tube vibration, ASME PVP
/// Conference, 1984; M. Pettigrew, C. Taylor, Vibration analysis of shell-and-tube heat exchangers, part 1, Journal
/// of Fluids and Structures 18 (2003) 469.
/// Range: 1.2 <= P/D <= 2. Refused: P/D <= 1.05, where tubes nearly touch and C_m grows without bound.
#pragma once
#include <string>

namespace fretwork::flow {

/// Of the tubes, by the direction of the flow: triangle 30, rotated_triangle 60, square 90, rotated_square 45 degrees.
enum class Arrangement { single, triangle, rotated_triangle, square, rotated_square };

struct Bundle {
  Arrangement arrangement = Arrangement::single;
  double pitch = 0.0; ///< m, P, between centres of neighbours; of no meaning for a single tube
  bool operator==(const Bundle&) const = default;
};

inline constexpr double least_pitch_ratio = 1.05; ///< P/D: at or below it refused
inline constexpr double correlated_pitch_ratio_from = 1.2, correlated_pitch_ratio_to = 2.0; ///< of q
/// q above which the confinement of viscous damping holds (damping_terms.hpp).
inline constexpr double correlated_confinement = 2.0;

[[nodiscard]] bool is_single(const Bundle& bundle);

/// P/D.
/// @param diameter  m, D > 0
/// @throws core::Error for P/D <= 1.05, and for a single tube
[[nodiscard]] double pitch_ratio(const Bundle& bundle, double diameter);

/// q = De/D; infinite for a single tube.
/// @throws core::Error for P/D <= 1.05
[[nodiscard]] double confinement_ratio(const Bundle& bundle, double diameter);

/// C_m of a tube in the middle of a circle, q > 1 (infinite: 1).
[[nodiscard]] double added_mass_coefficient(double confinement_ratio);

} // namespace fretwork::flow
