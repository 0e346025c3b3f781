// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Linear response of a study to turbulence by its spectra (flow/response.hpp), on modes pinned at supports.
#pragma once
#include "app/build_scene.hpp"
#include "app/pinned_modes.hpp"

namespace fretwork::app {

/// What a response pins the tubes at.
[[nodiscard]] PinsAsked pins_asked(const study::Response& response);

/// Collective. Every `[[response]]`, or one with all active contacts pinned: observed nodes along the global axes, and contact points that are
/// not pinned along y_loc and z_loc. Damping: the ratio of the response, else the set `stability` of the flow where modes.damping is "flow",
/// else modes.damping.
/// @param contacts  all of the study, inactive ones included
void linear_responses(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<TurbulentLoad>& loads,
                      const std::vector<PlacedContact>& contacts, const std::vector<NamedNode>& nodes,
                      results::RunResults& out);

} // namespace fretwork::app
