// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Statistics of forces that follow from the modes, those of sections of beams and of restraints, over every step of a window, each
/// weighted by its length. A force has six components, F = rows q + by_contacts f + by_loads g + imposed s, with f the contact forces on the nodes, g
/// the amplitudes of loads and s imposed motions; of a section they are N Vy Vz T My Mz. Dampers add by_velocity q' + imposed_velocity s'. Records have no
/// velocities: a force with dampers is that of the middle of a step,
///     (F_k + F_{k-1})/2 + (D_k - D_{k-1})/(t_k - t_{k-1}),   D = by_velocity q + imposed_velocity s,
/// whose error is of order 2 in the step; of the first record without dampers.
///
/// The normal stress of a section is the largest |N/A + a My e_z + b Mz e_y| on its outline,
///   of a pipe or circle  a = cos p, b = sin p,  e_z = R/Iy,        e_y = R/Iz,
///   of a rectangle       a, b = +-1,            e_z = h_z/(2 Iy),  e_y = h_y/(2 Iz);
/// its standard deviation is that of the fibre (a, b) where it is largest.
#pragma once
#include "kernels/kernels.hpp"
#include "post/batch_means.hpp"
#include "post/moments.hpp"
#include "signals/prescribed_motion.hpp"
#include "transient/run.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::post {

constexpr std::size_t force_components = 6;

/// What makes a normal stress of N, My and Mz.
struct OuterFibre {
  bool round;      ///< a pipe or circle, not a rectangle
  double area;     ///< m2
  double e_z, e_y; ///< 1/m3
};

/// A force that a run follows.
struct FollowedForce {
  std::string name;
  Eigen::MatrixXd rows; ///< 6 x n
  Eigen::MatrixXd by_contacts =
      {};                        ///< 6 x 3 contacts of the scene, over their x_loc y_loc z_loc; empty: none
  Eigen::MatrixXd by_loads = {}; ///< 6 x loads of the scene; empty: none
  Eigen::MatrixXd imposed = {};  ///< 6 x motions of the scene; empty: none
  /// Of a section: force and moment are those across it, (Vy, Vz) and (My, Mz). Else both have three components.
  bool section = true;
  std::optional<OuterFibre> fibre = std::nullopt; ///< of sections whose outline is known
  Eigen::MatrixXd by_velocity = {};               ///< of dampers, 6 x n, over q'; empty: none
  Eigen::MatrixXd imposed_velocity = {};          ///< of dampers, 6 x motions of the scene, over s'
};

struct ForceSummary {
  std::array<Moments, force_components> components; ///< N, N m
  std::array<double, force_components>
      std_error{};     ///< of each std, from batch means; not a number where the window is too short
  double force = 0.0;  ///< N, the largest magnitude
  double moment = 0.0; ///< N m, the largest magnitude
  double stress = 0.0, stress_time = 0.0; ///< Pa, the largest, and s, when; not a number without a fibre
  double stress_std = 0.0, stress_std_error = 0.0; ///< Pa, likewise
  double batches = 0.0;                            ///< the smallest effective number behind one of the errors
};

class ForceStatistics final : public transient::Observer {
public:
  /// @param from  start of the window, s
  ForceStatistics(const std::vector<FollowedForce>& forces, double from);
  /// What loads add besides the modes.
  void add_loads(const std::vector<FollowedForce>& forces, const std::vector<vibration::Load>& loads,
                 double duration);
  /// Imposed motions strain beams too.
  void add_imposed_motion(const std::vector<FollowedForce>& forces,
                          const std::vector<signals::PrescribedMotion>& motions, double duration);
  void step(const transient::Record& record) override;
  [[nodiscard]] transient::RecordParts parts_of(const transient::Record& record, double) const override {
    return {record.time >= from_ && !kinds_.empty(), false};
  }
  void visit(core::StateArchive& state) override {
    state(first_, sums_, squares_, products_, min_, max_, force_, moment_, stress_, stress_time_, time_,
          ends_, waiting_, inputs_, instants_, before_, time_before_);
  }
  [[nodiscard]] std::vector<ForceSummary> summaries();

private:
  struct Kind {
    bool section;
    std::optional<OuterFibre> fibre;
  };
  /// Of a record that waits.
  struct Instant {
    double time = 0.0, step = 0.0; ///< s
  };
  static constexpr int together = kernels::gathered_together;
  void look_at_waiting();
  void add(const Instant& instant, double* values);
  void add_dampers(double time, double* values);
  void add_magnitudes(double time, const double* values);
  void add_products(double weight, const double* values);
  void write_sums(double* row) const;
  void add_stress_deviation(const BatchSums& batches, std::size_t site, ForceSummary& out) const;

  double from_;
  std::vector<Kind> kinds_;
  std::vector<std::size_t>
      damped_;               ///< forces with dampers: D of the i-th is that of a force kinds_.size() + i
  std::vector<char> damps_;  ///< whether a damper acts in a component of each of these, 6 x damped_
  kernels::Array before_;    ///< F and D of each at the record before, 12 x damped_
  double time_before_ = 0.0; ///< s
  std::size_t
      width_; ///< forces, with those of dampers, padded; arrays of components are component after component
  kernels::GatherTable gather_;
  std::size_t modes_ = 0, inputs_of_record_ = 0; ///< padded
  int waiting_ = 0; ///< records whose forces are not made yet: together the table is read once
  std::array<Instant, together> instants_{};          ///< of them
  kernels::Array inputs_;                             ///< q and f of each, one record after the other
  kernels::Array values_;                             ///< 6 x width for each of them
  kernels::Array first_, sums_, squares_, min_, max_; ///< 6 x width; sums of w d and w d^2 from the first
  kernels::Array products_;                           ///< 3 x width: sums of w d_i d_j of N My, N Mz, My Mz
  kernels::Array force_, moment_;                     ///< width: squares of the largest magnitudes
  kernels::Array stress_, stress_time_;               ///< width
  double time_ = 0.0;                                 ///< length of the window so far, s
  BatchEnds ends_;
  std::vector<signals::Signal> loads_; ///< that add something
  kernels::Array of_loads_;            ///< 6 x width, load after load
  std::vector<signals::MotionSignal> motions_;
  kernels::Array imposed_; ///< 6 x width, motion after motion
};

} // namespace fretwork::post
