// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the beams of /mesh/lines are made of, as results.h5 has it:
///     /mesh/beam_properties [m]: number of the property of each beam
///     /mesh/arc_middles [m, 3] m: a point of the arc between the ends, NaN of straight beams; only where there are arcs
///     /mesh/taper_shares [m, 2]: where the ends are on the way of a taper, 0 to 1; only where there are tapers
///     /mesh/properties/0, 1 ...: attributes young_modulus, poisson_ratio, density, axial_force, orientation (NaN: none); groups section
///     and, of a taper, far_section with the constants, shape and shear of a section
#pragma once
#include "results/hdf5.hpp"
#include "results/run_results.hpp"

namespace fretwork::results {

/// @param mesh  the group /mesh
void write_beams(const h5::Group& mesh, const RunResults& results);
/// After the nodes and lines. Nothing where the file has no beams.
/// @throws h5::Failure if something is missing or does not fit together
void read_beams(const h5::Group& mesh, RunResults& results);

} // namespace fretwork::results
