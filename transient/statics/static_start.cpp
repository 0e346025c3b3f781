// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/statics/static_start.hpp"
#include "core/symmetric.hpp"
#include "transient/statics/static_energy.hpp"
#include <cmath>

namespace fretwork::transient {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Equilibrium is found where the residual is below this share of the forces: n eps with a margin.
constexpr double tolerance = 1e-12;
/// The least lambda: makes a motion without stiffness solvable, and is nothing beside any that has one.
constexpr double least_damping = 1e-12;
/// The first lambda after a refused step.
constexpr double first_damping = 1e-8;
/// Where the energy changes by less than this share it is round-off, and the gradient judges the step.
constexpr double energy_round_off = 1e-11;
/// A direction of E'' below this (in units of D) is one along which equilibrium is unstable.
constexpr double unstable = -1e-9;
/// Along a step: of the slope at its start, where the energy is as good as least; and how often it is looked for.
constexpr double flat_slope = 0.1;
constexpr int most_looks = 40;
/// Newton's steps on piecewise quadratic energies settle in a few times the changes of contact status.
constexpr int most_iterations = 1000;

/// Leaves a point of equilibrium along the most unstable direction, to lower energy. False where there is none.
bool leave_unstable(const StaticEnergy& energy, VectorXd& x, const std::vector<Touch>& touches) {
  if (energy.is_convex_at(touches))
    return false;
  const auto [values, vectors] = core::symmetric_eigenpairs(energy.hessian(touches));
  if (values(0) >= unstable)
    return false;
  VectorXd direction = vectors.col(0);
  Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction(largest) < 0.0) // both sides are as good: always the same
    direction = -direction;
  direction *= std::min(1.0, energy.room_along(direction, touches));
  const double here = energy.value(x, touches), slack = energy_round_off * energy.magnitude(x, touches);
  for (int halving = 0; halving < 60; ++halving, direction *= 0.5) {
    const VectorXd there = x + direction;
    if (energy.value(there, energy.touch(there)) < here - slack) {
      x = there;
      return true;
    }
  }
  return false;
}

/// Newton's steps with lambda, one after the other.
class Descent {
public:
  Descent(const StaticEnergy& energy, const VectorXd& x) : energy_(energy) { move_to(x); }
  void move_to(const VectorXd& x) {
    x_ = x;
    touches_ = energy_.touch(x_);
    gradient_ = energy_.gradient(x_, touches_);
    hessian_ = energy_.hessian(touches_);
  }
  [[nodiscard]] const VectorXd& x() const { return x_; }
  [[nodiscard]] const std::vector<Touch>& touches() const { return touches_; }
  [[nodiscard]] const VectorXd& gradient() const { return gradient_; }

  /// One trial. Returns whether it went to a better place.
  bool step() {
    MatrixXd matrix = hessian_;
    matrix.diagonal().array() += lambda_;
    const core::Cholesky factor(matrix);
    if (!factor.is_positive_definite())
      return refuse();
    VectorXd s = energy_.held(factor.solve(-gradient_));
    s *= std::min(1.0, energy_.room_along(s, touches_));
    s *= least_along(s);
    const VectorXd there = x_ + s;
    const std::vector<Touch> touches = energy_.touch(there);
    const double predicted = -gradient_.dot(s) - 0.5 * s.dot(hessian_.selfadjointView<Eigen::Lower>() * s);
    const double magnitude = energy_.magnitude(x_, touches_);
    if (std::abs(predicted) <= energy_round_off * magnitude) {
      if (!(energy_.gradient(there, touches).norm() < gradient_.norm()))
        return refuse();
    } else {
      const double ratio = (energy_.value(x_, touches_) - energy_.value(there, touches)) / predicted;
      if (!(predicted > 0.0 && ratio > 1e-4))
        return refuse();
      if (ratio > 0.5)
        lambda_ = lambda_ > first_damping ? 0.1 * lambda_ : least_damping;
    }
    move_to(there);
    return true;
  }

private:
  /// The share of a step where the energy is least along it, 1 unless it rises at the end. A step that passes a corner of an obstacle, round which the
  /// normal turns within a penetration, would see the faces on both sides of it and never what holds it there.
  [[nodiscard]] double least_along(const VectorXd& s) const {
    const auto slope = [&](double share) {
      const VectorXd x = x_ + share * s;
      return energy_.gradient(x, energy_.touch(x)).dot(s);
    };
    double low = 0.0, high = 1.0, at_low = gradient_.dot(s), at_high = slope(1.0);
    const double flat = flat_slope * std::abs(at_low);
    if (!(at_low < 0.0 && at_high > flat))
      return 1.0;
    double share = high;
    int side = 0; // false position, the end that stays weighed less each time (Illinois)
    for (int i = 0; i < most_looks; ++i) {
      share = (low * at_high - high * at_low) / (at_high - at_low);
      const double here = slope(share);
      if (std::abs(here) <= flat)
        break;
      if (here > 0.0) {
        high = share;
        at_high = here;
        at_low *= side == 1 ? 0.5 : 1.0;
        side = 1;
      } else {
        low = share;
        at_low = here;
        at_high *= side == -1 ? 0.5 : 1.0;
        side = -1;
      }
    }
    return share;
  }
  bool refuse() {
    lambda_ = std::max(first_damping, 10.0 * lambda_);
    return false;
  }
  const StaticEnergy& energy_;
  VectorXd x_, gradient_;
  std::vector<Touch> touches_;
  MatrixXd hessian_;
  double lambda_ = least_damping;
};

} // namespace

Equilibrium static_equilibrium(const Scene& scene) {
  const StaticEnergy energy(scene);
  Equilibrium out;
  Descent descent(energy, VectorXd::Zero(energy.size()));
  out.motion = energy.unanswered();
  bool found = false;
  while (out.motion.size() == 0 && out.iterations < most_iterations) {
    const auto [size, round_off] = energy.forces(descent.x(), descent.touches());
    const double before = descent.gradient().norm();
    found = before <= std::max(tolerance * size, round_off);
    ++out.iterations;
    const bool better = before > 0.0 && descent.step();
    if (energy.is_carried_away(descent.x()))
      out.motion = energy.modal(descent.x());
    // as long as a step halves the residual it is not yet round-off
    if (found && !(better && descent.gradient().norm() < 0.5 * before)) {
      VectorXd x = descent.x();
      if (!leave_unstable(energy, x, descent.touches()))
        break;
      descent.move_to(x);
      found = false;
    }
  }
  out.q = energy.modal(descent.x());
  out.normal_force.resize(static_cast<Index>(scene.contacts.size()));
  for (std::size_t c = 0; c < descent.touches().size(); ++c)
    out.normal_force(static_cast<Index>(c)) = descent.touches()[c].force;
  const double size = energy.forces(descent.x(), descent.touches()).size;
  out.residual = size > 0.0 ? descent.gradient().norm() / size : 0.0;
  if (out.motion.size() > 0) {
    out.balance = Balance::not_held;
    out.motion.normalize();
  } else if (!found) {
    out.balance = Balance::not_converged;
  }
  return out;
}

} // namespace fretwork::transient
