// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Loads and initial state of a study as fields over the whole model.
#pragma once
#include "app/build_flow.hpp"
#include "app/support_motion.hpp"
#include "app/turbulent_loads.hpp"
#include "core/motion_forces.hpp"
#include "fem/beam_element.hpp"
#include "fem/model.hpp"
#include "mesh/line_mesh.hpp"
#include "signals/time_function.hpp"
#include "study/study.hpp"
#include <functional>

namespace fretwork::app {

/// Forces of a fluid on the modes of some structures, one after the other.
struct FluidForces {
  std::vector<std::size_t> structures; ///< numbers, ascending
  core::MotionForces forces;
};

/// Everything of a study over the whole model that does not depend on modes: nodal forces, initial fields (6
/// values a node).
struct Fields {
  struct Load {
    std::string name; ///< for messages
    signals::TimeFunction function;
    Eigen::VectorXd force;
    bool inertial = false;   ///< as vibration::Load
    bool of_support = false; ///< what a support motion does to the modes
    bool of_curve =
        false; ///< by the curve through a table of its displacement, whose acceleration may jump at the rows
    /// Its part that acts along a beam, N and N m at the dofs of its ends; none: it acts at nodes.
    std::function<fem::Vector12(const fem::Model& model, core::Index beam)> along_beam = {};
  };
  std::vector<Load> loads;
  std::vector<std::string> warnings, notes;
  std::vector<Eigen::VectorXd> supports; ///< shapes of the study's support motions (support_motion.hpp)
  std::vector<Eigen::VectorXd> grounds;  ///< of springs and dampers, moved by them
  std::vector<FluidForces> motion;       ///< by laws; empty: none
  bool moves_at_start = false;
  Eigen::VectorXd displacement, velocity;                   ///< where moves_at_start
  Eigen::VectorXd displacement_momentum, velocity_momentum; ///< M times them
};
/// What messages call a load, and a moved support. @param entry  from 0
[[nodiscard]] std::string name_of_load(const study::Load& load, std::size_t entry);
[[nodiscard]] std::string name_of_support_motion(const study::SupportMotion& motion, std::size_t entry);

/// @param supports  of the study's support motions; none where only the study is checked
[[nodiscard]] Fields build_fields(const study::Study& study, const mesh::LineMesh& mesh,
                                  const fem::Model& model, const std::vector<PlacedFlow>& flows,
                                  const std::vector<SupportFields>& supports);

} // namespace fretwork::app
