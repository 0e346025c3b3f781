// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fluidelastic forces of the flows with a law: on the modes of structures, and what they make of frequencies and damping.
#pragma once
#include "app/build_scene.hpp"
#include "app/flow_damping.hpp"
#include "core/motion_forces.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// By laws and, where a law is of one tube, by tubes; nothing where no flow has a law.
/// @throws core::Error what flow::motion_forces throws, named by the flow; for two laws on one structure
[[nodiscard]] std::vector<FluidForces> fluidelastic_forces(const TubesInFlow& tubes,
                                                           const std::vector<modal::Basis>& bases);

/// Stability diagrams of the tubes with a law, on the modes of an assessment; of several tubes of a law with the first of them.
/// @param bases  of the model that the assessment pins
/// @param found  the assessments of all tubes, with damping and Connors' ratios   @param ratios  damping of the modes, by tubes
/// @throws core::Error where modes and lags are too many
void assess_laws(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                 const study::Stability& assessment, const std::vector<Eigen::VectorXd>& ratios,
                 std::vector<results::StabilityAssessment>& found);

/// Adds the forces on the modes of some structures, which follow each other in the system.
void add_motion_forces(const std::vector<FluidForces>& by_laws, const std::vector<std::size_t>& structures,
                       const std::vector<modal::Basis>& bases, vibration::System& system);

} // namespace fretwork::app
