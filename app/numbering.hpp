// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where the supports of a group are, which are named by numbers.
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_flow.hpp"

namespace fretwork::app {

/// The first and the last support of each group of several nodes, by the abscissa of a flow where one is along both, else by coordinates; empty
/// where there is no such group.
[[nodiscard]] std::string numbering_text(const study::Study& study, const fem::Model& model,
                                         const std::vector<PlacedContact>& placed,
                                         const std::vector<PlacedFlow>& flows);

} // namespace fretwork::app
