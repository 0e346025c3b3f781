// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Time series at the output instants.
#pragma once
#include "post/force_statistics.hpp"
#include "signals/prescribed_motion.hpp"
#include "transient/run.hpp"
#include <string>
#include <vector>

namespace fretwork::post {

/// What a contact does at an output instant. One without friction slides whenever it is closed.
enum ContactMode : std::uint8_t { open = 0, sticks = 1, slides = 2 };

/// Local axes of the contact; the motion is that of the node from the obstacle.
struct ContactSeries {
  std::string name;
  Eigen::MatrixXd displacement, velocity; ///< nt x 3, m and m/s
  Eigen::VectorXd gap;                    ///< nt, m
  Eigen::VectorXd normal_force;           ///< nt, N
  Eigen::MatrixXd tangential_force;       ///< nt x 2, N: along x_loc, along n x x_loc
  std::vector<std::uint8_t> state;        ///< nt, ContactMode; open where the normal force is 0
  Eigen::MatrixXd
      normal; ///< nt x 2, unit normal along y_loc, z_loc: of the forces, where there are none of the place

  /// N, on the node along x_loc y_loc z_loc.
  [[nodiscard]] core::Vec3 force(Eigen::Index index) const;
};

/// Global axes.
struct NodeSeries {
  std::string name;
  Eigen::MatrixXd displacement, velocity, acceleration; ///< nt x 3
};

/// Of a restraint, on the structure.
struct ReactionSeries {
  std::string name;
  Eigen::MatrixXd force; ///< nt x 6, N and N m, global axes
};

struct TimeSeries {
  Eigen::VectorXd time; ///< nt, s
  std::vector<ContactSeries> contacts;
  std::vector<NodeSeries> nodes;
  std::vector<ReactionSeries> reactions;
  Eigen::MatrixXd modal_displacement, modal_velocity; ///< n x nt (one output a column)
};

/// A node whose motion is wanted.
struct ObservedNode {
  std::string name;
  Eigen::MatrixXd rows; ///< 3 x n, global axes
  Eigen::MatrixXd imposed =
      {}; ///< 3 x motions of the scene, global axes: u = rows q + imposed s; empty: none
};

class Recorder final : public transient::Sampler {
public:
  /// @param masses  n, modal masses of the run (transient/modes/mass_scaling.hpp); empty: all 1
  Recorder(const transient::Scene& scene, std::vector<ObservedNode> nodes, const transient::OutputGrid& grid,
           Eigen::VectorXd masses = {});
  /// Those of `forces` that are no sections get a series.
  void add_reactions(const std::vector<FollowedForce>& forces);
  void state(std::int64_t index, double time, const double* q, const double* v) override;
  void forces(std::int64_t index, double time, const double* load,
              std::span<const transient::ContactForce> contacts) override;
  /// The outputs served so far.
  void visit(core::StateArchive& state) override;

  /// The series of the outputs served so far, displacements and velocities made from the modes.
  [[nodiscard]] TimeSeries series() &&;

private:
  void add_motions();
  void set_reactions();
  void add_loads_to_reactions();
  [[nodiscard]] core::Vec3 place(std::size_t contact, std::int64_t index, double time) const;
  void set_gap(std::size_t contact, std::int64_t index, const core::Vec3& place);

  const transient::Scene& scene_;
  std::vector<ObservedNode> nodes_;
  std::vector<FollowedForce> reactions_;
  TimeSeries out_;
  std::vector<signals::MotionSignal> motions_; ///< that carry contacts and nodes
  Eigen::VectorXd masses_;                     ///< modal, empty: all 1
  Eigen::VectorXd acceleration_;               ///< modal
  std::int64_t served_ = 0;
};

} // namespace fretwork::post
