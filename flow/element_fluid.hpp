// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the beams of a tube get from the fluid, each at its middle: before the modes are computed.
///     m_i = rho_i pi di^2/4,   m_a = C_m rho pi D^2/4      inertia across the tube only
///     weight less buoyancy = g (m_t + m_i - rho pi D^2/4)  in still fluid, m_t of the tube alone
/// Constant along an element: a zone wants 10 elements or more.
#pragma once
#include "flow/limit.hpp"
#include "flow/profile.hpp"

namespace fretwork::flow {

inline constexpr int least_elements_of_zone = 10;

struct ElementFluid {
  Index beam;            ///< of the model
  double s;              ///< m, its middle
  fem::Fluid fluid;      ///< rho_i, rho and C_m: as the fluid of a property gives the beam m_i + m_a
  double added_mass;     ///< kg/m, m_a
  double inner_mass;     ///< kg/m, m_i
  double submerged_mass; ///< kg/m: times the acceleration of gravity, weight less buoyancy per length
};

struct TubeFluid {
  std::vector<ElementFluid> elements; ///< in the order of the tube
  Limits limits;                      ///< zones of few elements, P/D outside the range of q
};

/// @throws core::Error what Profile::at throws
[[nodiscard]] TubeFluid fluid_of_elements(const Tube& tube, const Profile& profile);

} // namespace fretwork::flow
