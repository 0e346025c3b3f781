// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fluid-elastic stability of the tubes of a study (flow/stability.hpp) on modes pinned at supports.
#pragma once
#include "app/flow_damping.hpp"
#include <mpi.h>

namespace fretwork::app {

/// The assessments of a study: its `[[stability]]` entries, or one of all active contacts where it has none.
[[nodiscard]] std::vector<study::Stability> assessments_of(const study::Study& study);

/// The contacts at which an assessment pins the tubes.
/// @param contacts  all of the study, inactive ones included
/// @param notes     takes contacts between two moving nodes, which pin nothing
/// @throws core::Error where a contact that the study names cannot pin
[[nodiscard]] std::vector<PlacedContact> pins_of(const study::Stability& assessment,
                                                 const study::Study& study, const fem::Model& model,
                                                 const std::vector<PlacedContact>& contacts,
                                                 std::vector<std::string>& notes);

/// Collective. Every assessment of every tube, with as many modes as `[modes]` asks for; damping of the set `stability`
/// unless the study gives a ratio. Notes limits.
/// @param contacts  all of the study, inactive ones included
void assess_stability(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<PlacedContact>& contacts,
                      results::RunResults& out);

} // namespace fretwork::app
