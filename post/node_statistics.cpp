// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/node_statistics.hpp"
#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace fretwork::post {
namespace {

/// Sums whose batches are kept, of each direction of each node.
enum Sum : std::size_t { first, squares, node_sums };

} // namespace

NodeStatistics::NodeStatistics(const std::vector<Eigen::MatrixXd>& rows, double from)
    : from_(from), sums_(rows.size()), extremes_(3 * rows.size()), ends_(3 * node_sums * rows.size()) {
  const auto width = static_cast<std::size_t>(kernels::padded(3 * static_cast<int>(rows.size())));
  std::vector<std::map<int, std::array<double, kernels::lanes>>> packs(width / kernels::lanes);
  u_.assign(width, 0.0);
  for (std::size_t lane = 0; lane < 3 * rows.size(); ++lane)
    for (int i = 0; i < rows[lane / 3].cols(); ++i)
      if (const double value = rows[lane / 3](static_cast<Eigen::Index>(lane % 3), i); value != 0.0)
        packs[lane / kernels::lanes][i][lane % kernels::lanes] = value;
  for (const auto& pack : packs)
    gather_.add_pack(pack);
}

void NodeStatistics::add_imposed_motion(const std::vector<Eigen::MatrixXd>& imposed,
                                        const std::vector<signals::PrescribedMotion>& motions,
                                        double duration) {
  const std::size_t width = u_.size();
  imposed_.assign(motions.size() * width, 0.0);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    motions_.emplace_back(motions[k], duration);
    for (std::size_t node = 0; node < imposed.size(); ++node)
      for (std::size_t d = 0; d < 3 && imposed[node].size() > 0; ++d)
        imposed_[k * width + 3 * node + d] =
            imposed[node](static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(k));
  }
}

void NodeStatistics::step(const transient::Record& record) {
  if (record.time < from_ || sums_.empty())
    return;
  kernels::gather(gather_, record.q, u_.data());
  const double* imposed = imposed_.data();
  for (const signals::MotionSignal& motion : motions_) {
    const double s = motion(record.time).displacement;
    for (double& u : u_)
      u += s * *imposed++;
  }
  for (std::size_t node = 0; node < sums_.size(); ++node)
    for (std::size_t d = 0; d < 3; ++d)
      sums_[node][d].add(u_[3 * node + d], record.step);
  extremes_.watch(u_.data(), record.time);
  time_ += record.step;
  ends_.watch(time_, [this](double* row) { write_sums(row); });
}

void NodeStatistics::write_sums(double* row) const {
  for (const auto& node : sums_)
    for (const Accumulator& signal : node) {
      row[first] = signal.sum();
      row[squares] = signal.sum_of_squares();
      row += node_sums;
    }
}

std::vector<NodeSummary> NodeStatistics::summaries() const {
  std::vector<NodeSummary> out(sums_.size());
  if (!(time_ > 0.0))
    return out;
  const BatchSums batches = ends_.batches(time_, [this](double* row) { write_sums(row); });
  for (std::size_t node = 0; node < out.size(); ++node) {
    NodeSummary& o = out[node];
    o.batches = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t direction = 3 * node + d;
      const auto* sums = batches.sums.data() + node_sums * direction;
      o.displacement[d] = {sums_[node][d].mean(), sums_[node][d].std(), extremes_.min(direction),
                           extremes_.max(direction)};
      const BatchEstimate estimate = batch_deviation(batches.lengths, sums[first], sums[squares],
                                                     sums_[node][d].sum() / time_, o.displacement[d].std);
      o.std_error[d] = estimate.error;
      o.batches = std::min(o.batches, estimate.batches);
    }
  }
  return out;
}

} // namespace fretwork::post
