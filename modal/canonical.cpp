// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/canonical.hpp"
#include <array>
#include <cassert>
#include <cmath>

namespace fretwork::modal {
namespace {

using core::Vec3;

constexpr std::array<double, 3> direction_weight{1.0, 0.9, 0.8};
/// Slopes of w over the bounding box: small, different, without a rational relation.
const Vec3 position_slope(0.1, 0.1 * 0.6180339887, 0.1 * 0.4142135624);
/// Translations below this share of (rotation times size of the structure) are round-off.
constexpr double no_translation = 1e-6;

struct Box {
  explicit Box(const std::vector<Vec3>& nodes) : low(nodes.front()), high(nodes.front()) {
    for (const Vec3& node : nodes) {
      low = low.cwiseMin(node);
      high = high.cwiseMax(node);
    }
    size = (high - low).norm() > 0.0 ? (high - low).norm() : 1.0;
  }
  [[nodiscard]] double weight(const Vec3& node) const { return 1.0 + position_slope.dot(node - low) / size; }
  Vec3 low, high;
  double size = 1.0;
};

struct Pick {
  Eigen::Index row = 0;
  double score = -1.0;
};

/// Best row among the translations (first = 0) or rotations (first = 3) of the columns from `column` on.
Pick best_row(const Eigen::Ref<const Eigen::MatrixXd>& shapes, Eigen::Index column,
              const std::vector<Vec3>& nodes, const Box& box, Eigen::Index first) {
  const Eigen::VectorXd squares = shapes.rightCols(shapes.cols() - column).rowwise().squaredNorm();
  Pick best;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      const Eigen::Index row = static_cast<Eigen::Index>(6 * i + d) + first;
      const double score = direction_weight[d] * box.weight(nodes[i]) * squares[row];
      if (score > best.score)
        best = {row, score};
    }
  return best;
}

/// Householder reflection of the columns from `column` on that makes `row` (r, 0 ... 0), then r > 0.
void align(Eigen::Ref<Eigen::MatrixXd> shapes, Eigen::Index column, Eigen::Index row) {
  auto left = shapes.rightCols(shapes.cols() - column);
  Eigen::VectorXd v = left.row(row).transpose();
  const double r = v.norm();
  if (left.cols() > 1 && v.tail(v.size() - 1).norm() > 0.0) {
    v[0] += std::copysign(r, v[0]); // away from cancellation
    const Eigen::VectorXd projection = left * v;
    left.noalias() -= (2.0 / v.squaredNorm()) * projection * v.transpose();
    left.row(row).tail(left.cols() - 1).setZero();
  }
  if (left(row, 0) < 0.0)
    left.col(0) *= -1.0;
}

} // namespace

std::vector<Eigen::Index> cluster_ends(const Eigen::VectorXd& lambda, Eigen::Index rigid) {
  std::vector<Eigen::Index> ends;
  if (rigid > 0)
    ends.push_back(rigid);
  for (Eigen::Index i = rigid; i < lambda.size(); ++i)
    if (i + 1 == lambda.size() || lambda[i + 1] - lambda[i] > cluster_gap * lambda[i + 1])
      ends.push_back(i + 1);
  return ends;
}

void canonicalise(Eigen::Ref<Eigen::MatrixXd> shapes, const std::vector<Vec3>& nodes) {
  assert(shapes.rows() == static_cast<Eigen::Index>(nodes.size()) * core::dofs_per_node);
  const Box box(nodes);
  for (Eigen::Index column = 0; column < shapes.cols(); ++column) {
    Pick pick = best_row(shapes, column, nodes, box, 0);
    const Pick rotation = best_row(shapes, column, nodes, box, 3);
    if (pick.score <= no_translation * no_translation * box.size * box.size * rotation.score)
      pick = rotation;
    align(shapes, column, pick.row);
  }
}

void canonicalise_clusters(Eigen::MatrixXd& shapes, Eigen::VectorXd& lambda, Eigen::Index rigid,
                           const std::vector<Vec3>& nodes) {
  Eigen::Index begin = 0;
  for (const Eigen::Index end : cluster_ends(lambda, rigid)) {
    canonicalise(shapes.middleCols(begin, end - begin), nodes);
    lambda.segment(begin, end - begin).setConstant(lambda.segment(begin, end - begin).mean());
    begin = end;
  }
}

} // namespace fretwork::modal
