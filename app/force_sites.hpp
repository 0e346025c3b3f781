// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Forces of sections and restraints that a run follows (`[output] section_forces`, `reactions`), made from the modes.
///
/// A mode of frequency omega holds the nodes of a beam by f = (K - omega^2 M) u, as static modes and supports that move do by K u. The forces
/// of a section are those at the end of its beam (fem/beam_element.hpp); the reaction of a restraint, which acts on the structure, is the sum
/// of f over the beams of its node and the springs to other nodes, less what loads put on the node itself. Dampers to other nodes add theirs. At dofs that
/// are free the reaction is that of springs and dampers to the ground, -k u - c u'.
/// Modes converge slowly to the statics of shear forces: what they lack under a load, or a contact force, of amplitude g(t) follows it, F = rows q + rest g, with
///     rest = S(G l) - sum over elastic modes of S_i (phi_i . l)/omega_i^2,
/// S the forces of a static motion (K u, less what the load puts along the beam), G l the static deflection under the load l (modal/static_solvers.hpp): the method of mode
/// acceleration (Craig and Kurdila, Fundamentals of Structural Dynamics, 2nd ed. 2006, section 11.4). Turbulence has the modes
/// only.
#pragma once
#include "app/build_scene.hpp"

namespace fretwork::app {

/// @throws core::Error for a group without beams, and for a group of reactions with a node that nothing restrains
[[nodiscard]] std::vector<results::ForceSite>
force_sites(const study::Study& study, const mesh::LineMesh& mesh, const fem::Model& model);

/// What the modes lack of the static force at a site.
struct LackingForce {
  Eigen::MatrixXd of_loads;    ///< 6 x loads, under each at an amplitude of 1
  Eigen::MatrixXd of_contacts; ///< 6 x 3 placed contacts, under 1 N along their x_loc y_loc z_loc
};

/// A model and the modes of its structures.
struct ModelInModes {
  const fem::Model& model;
  const std::vector<fem::Structure>& structures; ///< that can move
  const std::vector<modal::Basis>& bases;        ///< of each
};

/// Of each site; zero, with a note, where a structure has no static solution.
/// A structure that is free to move accelerates as well: of modes of 0 Hz it has M phi_i (phi_i . l). Serial; needs PETSc where there are sites.
/// @throws core::Error for a site that belongs to no structure
[[nodiscard]] std::vector<LackingForce> lacking_forces(const std::vector<results::ForceSite>& sites,
                                                       const ModelInModes& of, const Fields& fields,
                                                       const std::vector<PlacedContact>& placed,
                                                       std::vector<std::string>& notes);

/// Gives a scene the forces at its structures. @param lacking  of lacking_forces()
void follow_forces(const std::vector<results::ForceSite>& sites, const std::vector<LackingForce>& lacking,
                   const fem::Model& model, const std::vector<modal::Basis>& bases, const Fields& fields,
                   BuiltScene& built);

} // namespace fretwork::app
