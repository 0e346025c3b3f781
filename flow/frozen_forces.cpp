// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/frozen_forces.hpp"
#include "core/bracketed_root.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fretwork::flow {
namespace {

using Eigen::MatrixXd;

constexpr double found_frequency = 1e-13; // width of a bracket of the square of the frequency

/// A mode by the squares of its shape at the places.
class FrozenMode {
public:
  /// @param combination  of the modes from `first` on
  FrozenMode(const std::vector<LawPlace>& places, const FrozenForce& law, const Eigen::VectorXd& combination,
             Eigen::Index first, double factor)
      : law_(law) {
    double largest = 0.0;
    for (const double c : law.stiffness.values)
      largest = std::max(largest, std::abs(c));
    for (const LawPlace& place : places) {
      if (place.rate == 0.0)
        continue;
      const Eigen::Vector2d n = place.shapes.middleCols(first, combination.size()) * combination;
      points_.push_back({factor * factor * place.pressure, factor * place.rate, n(0) * n(0), n(1) * n(1)});
      bound_ += largest * points_.back().pressure * points_.back().lift;
    }
  }

  /// K_nn, 1/s2. @param square  of the circular frequency
  [[nodiscard]] double stiffness(double square) const {
    double sum = 0.0;
    for (const Point& p : points_)
      sum += p.pressure * p.lift * law_.stiffness.at(reduced_velocity(p, square));
    return sum;
  }

  /// C_nn, 1/s.
  [[nodiscard]] double damping(double square) const {
    double sum = 0.0;
    for (const Point& p : points_) {
      const double vr = reduced_velocity(p, square);
      sum += p.pressure / p.rate * p.lift * law_.damping.at(vr);
      if (law_.connors > 0.0)
        sum += p.pressure / p.rate * (p.drag + p.lift) * law_.connors * vr;
    }
    return sum;
  }

  [[nodiscard]] bool is_moved() const {
    return std::any_of(points_.begin(), points_.end(),
                       [](const Point& p) { return p.drag > 0.0 || p.lift > 0.0; });
  }

  /// Under flow; 0 where it diverges. @param still  the square of the circular frequency without
  [[nodiscard]] double square_under_flow(double still) const {
    const auto off = [&](double square) { return square - still + stiffness(square); };
    const double at_still = off(still);
    if (at_still == 0.0)
      return still;
    const bool rises = at_still < 0.0;
    const double end = rises ? still + bound_ : std::max(0.0, still - bound_), at_end = off(end);
    if ((at_end > 0.0) != rises)
      return end; // a stiffness that is the bound everywhere, or divergence
    return rises ? core::bracketed_root(off, still, end, at_still, at_end, found_frequency)
                 : core::bracketed_root(off, end, still, at_end, at_still, found_frequency);
  }

private:
  struct Point {
    double pressure, rate, drag, lift;
  };
  static double reduced_velocity(const Point& p, double square) {
    return square > 0.0 ? 2.0 * std::numbers::pi * p.rate / std::sqrt(square)
                        : std::numeric_limits<double>::infinity();
  }

  const FrozenForce& law_;
  std::vector<Point> points_;
  double bound_ = 0.0; ///< 1/s2, of the size of K_nn
};

/// int q n_l^T n_l ds of some modes.
MatrixXd moved_along_lift(const std::vector<LawPlace>& places, Eigen::Index first, Eigen::Index count) {
  MatrixXd out = MatrixXd::Zero(count, count);
  for (const LawPlace& place : places) {
    const auto lift = place.shapes.row(1).segment(first, count);
    out += place.pressure * lift.transpose() * lift;
  }
  return out;
}

} // namespace

core::MotionForces frozen_forces(const std::vector<LawPlace>& places, const FrozenForce& law,
                                 const Eigen::VectorXd& frequency, Eigen::Index first, Eigen::Index modes,
                                 double factor) {
  core::MotionForces out;
  out.stiffness = out.damping = MatrixXd::Zero(modes, modes);
  out.input = MatrixXd::Zero(modes, 0);
  out.output = MatrixXd::Zero(0, modes);
  if (factor == 0.0)
    return out;
  Eigen::Index count = 1;
  for (Eigen::Index at = 0; at < frequency.size(); at += count) {
    for (count = 1; at + count < frequency.size() && frequency(at + count) == frequency(at);)
      ++count;
    const MatrixXd turned = count == 1
                                ? MatrixXd::Ones(1, 1)
                                : core::symmetric_eigenpairs(moved_along_lift(places, at, count)).vectors;
    const double w = 2.0 * std::numbers::pi * frequency(at);
    Eigen::VectorXd k(count), c(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const FrozenMode mode(places, law, turned.col(i), at, factor);
      if (law.connors > 0.0 && w == 0.0 && mode.is_moved())
        throw core::Error(
            "a motion without stiffness has no reduced velocity, which Connors' damping needs; restrain "
            "it, or give form = \"coupled\"");
      const double square = mode.square_under_flow(w * w);
      k(i) = mode.stiffness(square);
      c(i) = mode.damping(square);
    }
    out.stiffness.block(first + at, first + at, count, count) = turned * k.asDiagonal() * turned.transpose();
    out.damping.block(first + at, first + at, count, count) = turned * c.asDiagonal() * turned.transpose();
  }
  return out;
}

} // namespace fretwork::flow
