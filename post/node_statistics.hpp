// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Statistics of the displacement of observed nodes over every step of a window, each weighted by its length.
#pragma once
#include "kernels/kernels.hpp"
#include "post/batch_means.hpp"
#include "post/extremes.hpp"
#include "post/moments.hpp"
#include "signals/prescribed_motion.hpp"
#include "transient/run.hpp"
#include <array>
#include <vector>

namespace fretwork::post {

/// Displacement along the global axes, m.
struct NodeSummary {
  std::array<Moments, 3> displacement;
  std::array<double, 3>
      std_error{}; ///< m, standard error of each std, from batch means; not a number where the window is too short
  double batches = 0.0; ///< the smallest effective number behind one of them
};

class NodeStatistics final : public transient::Observer {
public:
  /// @param rows  for each node its 3 x n translations of the modes   @param from  start of the window, s
  NodeStatistics(const std::vector<Eigen::MatrixXd>& rows, double from);
  /// Imposed motions move the nodes too: u = rows q + imposed s, 3 x motions for each node, or empty.
  void add_imposed_motion(const std::vector<Eigen::MatrixXd>& imposed,
                          const std::vector<signals::PrescribedMotion>& motions, double duration);
  void step(const transient::Record& record) override;
  [[nodiscard]] transient::RecordParts parts_of(const transient::Record& record, double) const override {
    return {record.time >= from_ && !sums_.empty(), false};
  }
  void visit(core::StateArchive& state) override { state(sums_, extremes_, time_, ends_); }
  [[nodiscard]] std::vector<NodeSummary> summaries() const;

private:
  void write_sums(double* row) const;

  double from_;
  kernels::GatherTable gather_;
  kernels::Array u_;
  std::vector<std::array<Accumulator, 3>> sums_;
  Extremes extremes_; ///< of direction d of node i: 3 i + d
  double time_ = 0.0; ///< length of the window so far, s
  BatchEnds ends_;
  std::vector<signals::MotionSignal> motions_;
  kernels::Array imposed_; ///< in lanes, motion after motion
};

} // namespace fretwork::post
