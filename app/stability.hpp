// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fluid-elastic stability of the tubes of a study (flow/stability.hpp) on modes pinned at supports.
#pragma once
#include "app/pinned_modes.hpp"

namespace fretwork::app {

/// The assessments of a study: its `[[stability]]` entries. Where it has none, one of all active contacts; of flows with a law one without
/// contacts, and one with all closed, sticking, as stiff as they are.
[[nodiscard]] std::vector<study::Stability> assessments_of(const study::Study& study);

/// What an assessment pins the tubes at.
[[nodiscard]] PinsAsked pins_asked(const study::Stability& assessment);

/// What a study's [[stability]] gives of a case of a sweep.
struct ConnorsStability {
  std::vector<results::StabilityAssessment> assessments;
  std::vector<std::string> warnings; ///< of what is unstable
};

/// Collective. The entries of the study by Connors alone, of every tube.
[[nodiscard]] ConnorsStability connors_stability(MPI_Comm comm, const TubesInFlow& tubes,
                                                 const std::vector<PlacedContact>& contacts);

/// Collective. Every assessment of every tube, with as many modes as `[modes]` asks for; damping of the set `stability`
/// unless the study gives a ratio. Notes limits.
/// @param contacts  all of the study, inactive ones included
void assess_stability(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<PlacedContact>& contacts,
                      results::RunResults& out);

} // namespace fretwork::app
