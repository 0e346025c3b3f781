// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/mass_scaling.hpp"
#include <algorithm>
#include <cassert>
#include <limits>
#include <numbers>

namespace fretwork::transient {
namespace {

/// Of the accuracy: share of scaled modes in the energy with which modes start to vibrate.
constexpr double vibrating_share = 0.1;

/// Shortest interval in which a table changes, s, 0 at a jump; infinite without a table.
double shortest_change(const signals::TimeFunction& function) {
  double shortest = std::numeric_limits<double>::infinity();
  if (const auto* table = std::get_if<signals::Table>(&function))
    for (std::size_t i = 1; i < table->time.size(); ++i)
      if (table->value[i] != table->value[i - 1])
        shortest = std::min(shortest, table->time[i] - table->time[i - 1]);
  return shortest;
}

/// N, on the modes: of contacts that overlap at t = 0, without their dampers.
Eigen::VectorXd normal_forces_at_start(const Scene& scene) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(scene.system.size());
  for (const ContactPoint& point : scene.contacts) {
    const contact::Location at = scene.location_at_start(point);
    if (!(at.gap < 0.0))
      continue;
    const double force = -point.support.normal.stiffness * at.gap;
    const core::Vec3 along(0.0, force * at.ny, force * at.nz);
    point.for_ranges([&](Eigen::Index first, const auto& part) {
      out.segment(first, part.cols()) += part.transpose() * along;
    });
  }
  return out;
}

} // namespace

Eigen::VectorXd scaled_masses(const Scene& scene, double fastest) {
  Eigen::VectorXd masses = Eigen::VectorXd::Ones(scene.system.size());
  if (!(fastest > 0.0))
    return masses;
  for (const ContactPoint& point : scene.contacts)
    point.for_ranges([&](Eigen::Index first, const auto& part) {
      for (Eigen::Index i = 0; i < part.cols(); ++i)
        if (!part.col(i).isZero(0.0))
          masses(first + i) = std::max(1.0, scene.system.stiffness(first + i) / (fastest * fastest));
    });
  return masses;
}

bool may_scale(const Scene& scene, double fastest, double accuracy) {
  if (!scene.system.motion.empty())
    return false;
  const Eigen::Array<bool, Eigen::Dynamic, 1> scaled = scaled_masses(scene, fastest).array() > 1.0;
  const Eigen::ArrayXd k = scene.system.stiffness.array(), flexibility = (k > 0.0).select(1.0 / k, 0.0);
  Eigen::ArrayXd at_start = Eigen::ArrayXd::Zero(k.size()), noise = at_start; // modal forces; (rms force)^2
  for (const vibration::Load& load : scene.loads) {
    const Eigen::ArrayXd square = load.modal_force.array().square(), bent = square * flexibility;
    if (scaled.select(bent, 0.0).sum() > accuracy * bent.sum())
      return false;
    if (scaled.select(square, 0.0).sum() > 0.0 &&
        shortest_change(load.function) * fastest < 2.0 * std::numbers::pi)
      return false;
    if (const auto* random = std::get_if<signals::Random>(&load.function)) // starts anywhere
      noise += random->rms * random->rms * square;
    else
      at_start += signals::Signal(load.function, scene.duration)(0.0) * load.modal_force.array();
  }
  for (const signals::SampledLoad& load : scene.sampled_loads) {
    const Eigen::ArrayXd square = load.rms.array().square(), bent = square * flexibility;
    if (scaled.select(bent, 0.0).sum() > accuracy * bent.sum())
      return false;
    noise += square;
  }
  const Eigen::ArrayXd moving = scene.v0.array().square(), spring = k * scene.q0.array();
  // what contacts hold bent at the start does not vibrate; what they bend from then on, they make vibrate
  const Eigen::ArrayXd unbalanced =
      (spring - at_start).square().min((spring - at_start - normal_forces_at_start(scene).array()).square());
  const Eigen::ArrayXd vibrates = moving + (unbalanced + noise) * flexibility,
                       all = moving + (spring.square() + at_start.square() + noise) * flexibility;
  return scaled.select(vibrates, 0.0).sum() <= vibrating_share * accuracy * all.sum();
}

Scene with_masses(const Scene& scene, const Eigen::VectorXd& masses) {
  assert(scene.system.motion.empty());
  const Eigen::VectorXd s = masses.cwiseSqrt().cwiseInverse();
  Scene out = scene;
  out.system.stiffness.array() /= masses.array();
  out.system.damping.array() /= masses.array();
  if (out.system.damping_matrix.size() > 0)
    out.system.damping_matrix = s.asDiagonal() * scene.system.damping_matrix * s.asDiagonal();
  for (vibration::Load& load : out.loads)
    load.modal_force.array() *= s.array();
  for (signals::SampledLoad& load : out.sampled_loads)
    load.multiply(s);
  for (ContactPoint& point : out.contacts)
    if (point.modes.empty()) {
      point.b = point.b * s.asDiagonal();
    } else {
      Eigen::Index column = 0;
      for (const vibration::ModeRange& range : point.modes) {
        point.b.middleCols(column, range.size) *= s.segment(range.first, range.size).asDiagonal();
        column += range.size;
      }
    }
  out.q0.array() /= s.array();
  out.v0.array() /= s.array();
  return out;
}

} // namespace fretwork::transient
