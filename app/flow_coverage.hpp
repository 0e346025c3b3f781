// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Parts of tubes in flow that are left without fluid: between and beyond the zones of a flow, and beams that go on beyond its group. They
/// are legal, and without the mass and damping of a fluid.
#pragma once
#include "app/build_flow.hpp"

namespace fretwork::app {

/// A warning for each flow whose zones leave out more than 0.5 % of its tube, with the abscissae; and for each flow beside whose tube beams
/// go on that are in no flow and have neither fluid nor added mass.
[[nodiscard]] std::vector<std::string> parts_without_fluid(const study::Study& study, const fem::Model& model,
                                                           const std::vector<PlacedFlow>& flows);

} // namespace fretwork::app
