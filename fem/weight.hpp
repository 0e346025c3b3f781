// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Weight of a model in still fluid. Hydrodynamic mass has inertia and no weight; per length of a beam
///     w = g (m_t + m_a + rho_i A_i - rho_e A_e)
/// with m_t the material, m_a the added mass that is given by itself, A_i the bore and A_e the displaced area
/// (fluid_mass.hpp). Lumped masses weigh as they are.
///
/// The fluids act in every direction, as they do in the equilibrium of the effective tension N + p_e A_e - p_i A_i of a
/// tube under hydrostatic pressure p, straight or bent: across the tube exact, along it the axial force is the
/// effective one. Added mass along a beam weighs only where it acts along it (AddedMass::all).
/// Consistent nodal forces: exact deflections at nodes of uniform beams.
/// Source: Sparks, The influence of tension, pressure and weight on pipe and riser deformations and stresses, Journal of
/// Energy Resources Technology 106 (1984) 46.
#pragma once
#include "fem/beam_element.hpp"
#include "fem/fields.hpp"

namespace fretwork::fem {

/// @param gravity  m/s2, acceleration, global axes
/// @return N and N m over the whole model, 6 values a node
[[nodiscard]] Eigen::VectorXd weight(const Model& model, const Vec3& gravity);
/// That of one beam. @return N and N m at its 12 dofs
[[nodiscard]] Vector12 weight(const Model& model, const Beam& beam, const Vec3& gravity);

} // namespace fretwork::fem
