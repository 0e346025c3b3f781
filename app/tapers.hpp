// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where beams are on the way of what changes along their group.
#pragma once
#include "fem/model.hpp"
#include "mesh/line_mesh.hpp"
#include "study/study.hpp"

namespace fretwork::app {

/// Sets Beam::along of the beams (one a line of the mesh) of every [[beams]] entry that changes from one end of its group to
/// the other: the share of the length of the curve, from its node of `from` on. A group may have several curves, each
/// with one node of `from` at one of its ends.
/// @throws core::Error for a node of `from` that is no end, a curve without one, with two, or with branches
void place_tapers(const study::Study& study, const mesh::LineMesh& mesh, fem::Model& model);

} // namespace fretwork::app
