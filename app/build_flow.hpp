// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The flows of a study placed on the model: each tube as a chain of beams, with the profile of its fluid.
#pragma once
#include "flow/element_fluid.hpp"
#include "mesh/line_mesh.hpp"
#include "study/study.hpp"
#include <optional>

namespace fretwork::app {

struct PlacedFlow {
  std::size_t entry; ///< in study.flows
  std::vector<core::Index> beams;
  core::Index start; ///< node of the model at s = 0
  double length;     ///< m
  flow::Profile profile;
};

/// Gives the beams of each tube its fluid, a property of their own where it differs: contacts must have been placed
/// before, which find their `[[beams]]` by the numbers of properties.
/// @param notes  takes what leaves the ranges of correlations
/// @throws core::Error for groups that do not exist or do not form a tube, beams of two flows, fluids that `[[beams]]`
///         give too, a `from` without one end of the tube, and what flow::Profile throws
[[nodiscard]] std::vector<PlacedFlow> place_flows(const study::Study& study, const mesh::LineMesh& mesh,
                                                  fem::Model& model, std::vector<std::string>& notes);

/// The tube as it is in the model: once its beams have their fluid, with all mass.
[[nodiscard]] flow::Tube tube_of(const study::Study& study, const PlacedFlow& placed,
                                 const fem::Model& model);

/// The force of the fluid on a tube at rest, q D (CD, CL) by its law, each beam at its middle: consistent nodal forces, N and N m. Nothing
/// where the law has none.
[[nodiscard]] std::optional<Eigen::VectorXd> steady_force(const study::Study& study, const PlacedFlow& placed,
                                                          const fem::Model& model);

/// `flow "T1"`: for messages.
[[nodiscard]] std::string name_of(const study::Flow& flow);

/// Limits in words, one line for each kind and zone. @param what  the tube, or tube and assessment
[[nodiscard]] std::vector<std::string> limit_notes(const std::string& what, const flow::Limits& limits,
                                                   const flow::Profile& profile);

} // namespace fretwork::app
