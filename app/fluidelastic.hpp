// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fluidelastic forces of the flows with a law: on the modes of structures, and what they make of frequencies and damping.
#pragma once
#include "app/build_scene.hpp"
#include "app/flow_damping.hpp"
#include "core/motion_forces.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// By structures; nothing where no flow has a law.
/// @throws core::Error what flow::motion_forces throws, named by the flow
[[nodiscard]] std::vector<core::MotionForces> fluidelastic_forces(const TubesInFlow& tubes,
                                                                  const std::vector<modal::Basis>& bases);

/// The stability diagram of a tube whose flow has a law, on the modes of an assessment; none without law or velocity.
/// @param damping  ratios of the modes of `sampling`
/// @throws core::Error where modes and lags are too many
[[nodiscard]] std::optional<results::LawStability> law_stability(const study::Flow& flow,
                                                                 const flow::Sampling& sampling,
                                                                 const Eigen::VectorXd& damping,
                                                                 const study::Stability& assessment);

/// Of the modes without contacts: a note, or where the tube is unstable a warning, for each flow with a law: the root of largest growth at
/// the working point with its reduced velocity, and the factor of all velocities at which the tube becomes unstable first.
void judge_fluidelastic(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                        results::RunResults& out);

/// After a run: a warning for each flow with a law beyond whose range of amplitudes contacts or observed nodes of its tube moved. The laws are
/// linear in the displacement: good to some 0.1 of the diameter.
/// @param placed, nodes  those of `out`
void judge_amplitudes(const TubesInFlow& tubes, const std::vector<PlacedContact>& placed,
                      const std::vector<NamedNode>& nodes, results::RunResults& out);

/// Appends the forces on the modes of some structures, which follow each other in the system.
void add_motion_forces(const std::vector<core::MotionForces>& by_structure,
                       const std::vector<std::size_t>& structures, const std::vector<modal::Basis>& bases,
                       transient::System& system);

/// @throws core::Error where a flow has a law
void refuse_fluidelastic_sweep(const study::Study& study);

} // namespace fretwork::app
