// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The motions of a structure that strain nothing.
///
/// K u = 0 where every part connected by beams moves rigidly, no restrained dof moves, no spring is
/// stretched and every tie is kept. Each part has six columns (translations; rotations about its centre, scaled by its size), each
/// restraint, spring and tie a row of pure geometry (axial forces of beams, which resist turning, rows of their shares of
/// the largest): the null space (singular values below a tolerance) holds
/// rigid-body motions and mechanisms alike (a hinged beam, a pinned tube that spins, a chain of masses),
/// whatever the size of the stiffnesses.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

/// An orthonormal basis (in M) of the motions without strain.
/// @return 6 * structure.nodes.size() rows, a column each (0 columns: the structure is held); exactly 0 at
/// restrained dofs
/// @throws core::Error where such a motion moves no mass either
[[nodiscard]] Eigen::MatrixXd rigid_motions(const Model& model, const Structure& structure);

} // namespace fretwork::fem
