// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/fluidelastic.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include <cmath>

namespace fretwork::flow {
namespace {

using Eigen::MatrixXd;

constexpr double equal_rates = 1e-9; // relative
constexpr double unseen = 1e-12;     // of the largest eigenvalue

/// Stations of equal V/D.
struct Group {
  double rate; ///< 1/s
  std::vector<MatrixXd> shapes;
  std::vector<double> weights; ///< Pa m, q w
};

/// Directions of the modes that a lag of the group sees, n x r.
MatrixXd seen(const Group& group, const Eigen::Matrix2cd& force, Eigen::Index modes) {
  MatrixXd gram = MatrixXd::Zero(modes, modes);
  const Eigen::Matrix2d square = (force.adjoint() * force).real();
  for (std::size_t i = 0; i < group.shapes.size(); ++i)
    gram += group.weights[i] * group.shapes[i].transpose() * square * group.shapes[i];
  const core::Eigenpairs pairs = core::symmetric_eigenpairs(gram);
  Eigen::Index count = 0;
  while (count < modes && pairs.values(modes - 1 - count) > unseen * pairs.values(modes - 1))
    ++count;
  return pairs.vectors.rightCols(count);
}

class States {
public:
  explicit States(core::MotionForces& forces, Eigen::Index modes) : forces_(forces), modes_(modes) {}

  /// A lag of a group: y' = -d (V/D) y + S^T a' for the directions S, as real and imaginary part where d is complex.
  void add(const Group& group, const FluidelasticLaw::Lag& lag) {
    const MatrixXd directions = seen(group, lag.force, modes_);
    const Eigen::Index r = directions.cols(), first = forces_.states(), n = forces_.stiffness.rows();
    const bool pair = lag.rate.imag() != 0.0;
    const Eigen::Index more = pair ? 2 * r : r, all = first + more;
    forces_.rates.conservativeResizeLike(MatrixXd::Zero(all, all));
    forces_.output.conservativeResizeLike(MatrixXd::Zero(all, n));
    forces_.input.conservativeResizeLike(MatrixXd::Zero(n, all));
    const MatrixXd unit = MatrixXd::Identity(r, r);
    forces_.rates.block(first, first, r, r) = -group.rate * lag.rate.real() * unit;
    forces_.output.block(first, 0, r, modes_) = directions.transpose();
    forces_.input.block(0, first, modes_, r) = input(group, lag.force.real()) * directions;
    if (!pair)
      return;
    forces_.rates.block(first + r, first + r, r, r) = -group.rate * lag.rate.real() * unit;
    forces_.rates.block(first, first + r, r, r) = group.rate * lag.rate.imag() * unit;
    forces_.rates.block(first + r, first, r, r) = -group.rate * lag.rate.imag() * unit;
    forces_.input.block(0, first + r, modes_, r) = -input(group, lag.force.imag()) * directions;
  }

private:
  [[nodiscard]] MatrixXd input(const Group& group, const Eigen::Matrix2d& force) const {
    MatrixXd out = MatrixXd::Zero(modes_, modes_);
    for (std::size_t i = 0; i < group.shapes.size(); ++i)
      out += group.weights[i] * group.shapes[i].transpose() * force * group.shapes[i];
    return out;
  }
  core::MotionForces& forces_;
  Eigen::Index modes_;
};

} // namespace

core::MotionForces motion_forces(const Sampling& sampling, const FluidelasticLaw& law, Eigen::Index modes,
                                 double factor) {
  const Eigen::Index m = sampling.modes();
  core::MotionForces out;
  out.stiffness = out.damping = MatrixXd::Zero(modes, modes);
  out.input = MatrixXd::Zero(modes, 0);
  out.output = MatrixXd::Zero(0, modes);
  std::vector<Group> groups;
  for (const Station& station : sampling.stations) {
    const double v = factor * station.flow.velocity;
    if (v == 0.0)
      continue;
    if (station.flow.drag.isZero(0.0))
      throw core::Error("the zone has no direction, which fluidelastic forces need; give direction, or the "
                        "velocity as a vector");
    MatrixXd shapes(2, m);
    shapes << station.flow.drag.transpose() * station.shapes, station.flow.lift.transpose() * station.shapes;
    const double d = station.tube.outer_diameter, rate = v / d,
                 weight = 0.5 * station.flow.density * v * v * station.weight;
    out.stiffness.topLeftCorner(m, m) += weight * shapes.transpose() * law.stiffness * shapes;
    out.damping.topLeftCorner(m, m) += weight / rate * shapes.transpose() * law.damping * shapes;
    std::size_t g = 0;
    while (g < groups.size() && std::abs(groups[g].rate - rate) > equal_rates * rate)
      ++g;
    if (g == groups.size())
      groups.push_back({rate, {}, {}});
    groups[g].shapes.push_back(std::move(shapes));
    groups[g].weights.push_back(weight);
  }
  States states(out, m);
  for (const Group& group : groups)
    for (const FluidelasticLaw::Lag& lag : law.lags)
      states.add(group, lag);
  return out;
}

MatrixXd state_matrix(const Eigen::VectorXd& k, const Eigen::VectorXd& c, const core::MotionForces& forces) {
  const Eigen::Index n = k.size(), r = forces.states();
  MatrixXd a = MatrixXd::Zero(2 * n + r, 2 * n + r);
  a.block(0, n, n, n).setIdentity();
  a.block(n, 0, n, n) = forces.stiffness - MatrixXd(k.asDiagonal());
  a.block(n, n, n, n) = forces.damping - MatrixXd(c.asDiagonal());
  a.block(n, 2 * n, n, r) = forces.input;
  a.block(2 * n, n, r, n) = forces.output;
  a.block(2 * n, 2 * n, r, r) = forces.rates;
  return a;
}

} // namespace fretwork::flow
