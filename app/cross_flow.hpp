// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Zones of a flow whose velocity is one number, across the tube everywhere, and that reach from a bend far into a straight leg, along which
/// the flow mostly is.
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_flow.hpp"

namespace fretwork::app {

/// A note for each such zone, with the abscissae past the first contact beyond the bend. None for tables of velocities, or vectors.
[[nodiscard]] std::vector<std::string> cross_flow_in_legs(const study::Study& study, const fem::Model& model,
                                                          const std::vector<PlacedFlow>& flows,
                                                          const std::vector<PlacedContact>& contacts);

} // namespace fretwork::app
