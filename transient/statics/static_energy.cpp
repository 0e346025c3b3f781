// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/statics/static_energy.hpp"
#include "core/symmetric.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Penetrations are differences of positions: their force is no better than this many units of round-off of them.
constexpr double position_round_off = 64.0 * std::numeric_limits<double>::epsilon();
/// Loads on a rigid mode below this share of all loads are the round-off of its shape: they balance each other.
constexpr double balanced_load = 1e-9;
/// Rigid motions that contacts hold less than this, relative to the one held best, do not meet any.
constexpr double unseen_motion = 1e-12;
/// A contact that has gone this many times the lengths of the scene will not meet anything any more.
constexpr double carried_away = 1e6;

} // namespace

StaticEnergy::StaticEnergy(const Scene& scene) : scene_(scene) {
  const Index n = scene.system.size();
  load_.setZero(n);
  for (const vibration::Load& load : scene.loads)
    if (!load.inertial)
      load_ += signals::static_value(load.function, scene.duration) * load.modal_force;
  rows_.resize(2 * static_cast<Index>(scene.contacts.size()), n);
  VectorXd scale = scene.system.stiffness, by_contacts = VectorXd::Zero(n);
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const ContactPoint& point = scene.contacts[c];
    const Eigen::MatrixXd b = point.over_all(n);
    rows_.middleRows<2>(2 * static_cast<Index>(c)) = b.middleRows<2>(1);
    const auto [y, z] = contact::normal_directions(point.support.obstacle);
    for (const auto& [counts, row] : {std::pair{y, 1}, std::pair{z, 2}})
      if (counts)
        by_contacts += point.support.normal.stiffness * b.row(row).cwiseAbs2().transpose();
    length_ = std::max(length_, std::hypot(point.rest.y(), point.rest.z()) +
                                    contact::properties_of(point.support.obstacle).extent);
  }
  spring_ = VectorXd::Ones(n);
  const double all_loads = load_.norm();
  for (Index i = 0; i < n; ++i)
    if (scene.system.stiffness(i) == 0.0) {
      spring_(i) = 0.0;
      scale(i) = by_contacts(i) > 0.0 ? by_contacts(i) : 1.0;
      if (std::abs(load_(i)) <= balanced_load * all_loads)
        load_(i) = 0.0;
    }
  root_ = scale.cwiseSqrt().cwiseInverse();
  load_.array() *= root_.array();
  rows_ *= root_.asDiagonal();
  find_unseen();
  length_ += rows_.rows() > 0 ? (rows_.cwiseAbs() * load_.cwiseAbs()).maxCoeff() : 0.0;
}

void StaticEnergy::find_unseen() {
  std::vector<Index> rigid;
  for (Index i = 0; i < size(); ++i)
    if (spring_(i) == 0.0)
      rigid.push_back(i);
  unseen_.resize(size(), 0);
  if (rigid.empty())
    return;
  MatrixXd stiffness = MatrixXd::Zero(static_cast<Index>(rigid.size()), static_cast<Index>(rigid.size()));
  for (std::size_t c = 0; c < scene_.contacts.size(); ++c) {
    const contact::Support& support = scene_.contacts[c].support;
    const auto [y, z] = contact::normal_directions(support.obstacle);
    for (const auto& [counts, offset] : {std::pair{y, 0}, std::pair{z, 1}})
      if (counts) {
        const VectorXd row = rows_.row(2 * static_cast<Index>(c) + offset)(rigid).transpose();
        stiffness += support.normal.stiffness * row * row.transpose();
      }
  }
  const auto [values, vectors] = core::symmetric_eigenpairs(stiffness);
  const double limit = unseen_motion * values.maxCoeff();
  Index count = 0;
  while (count < values.size() && values(count) <= limit)
    ++count;
  unseen_.setZero(size(), count);
  for (std::size_t i = 0; i < rigid.size(); ++i)
    unseen_.row(rigid[i]) = vectors.row(static_cast<Index>(i)).head(count);
}

VectorXd StaticEnergy::unanswered() const {
  const VectorXd along = unseen_.transpose() * load_;
  if (along.size() == 0 || along.norm() <= balanced_load * load_.norm())
    return {};
  return modal(unseen_ * along);
}

std::vector<Touch> StaticEnergy::touch(const VectorXd& x) const {
  const VectorXd u = rows_ * x;
  std::vector<Touch> out(scene_.contacts.size());
  for (std::size_t c = 0; c < out.size(); ++c) {
    const ContactPoint& point = scene_.contacts[c];
    const double y = point.rest.y() + u(2 * static_cast<Index>(c)),
                 z = point.rest.z() + u(2 * static_cast<Index>(c) + 1);
    const auto at = contact::locate(point.support.obstacle, y, z);
    Touch& t = out[c];
    t.position = std::hypot(y, z);
    t.ny = at.ny;
    t.nz = at.nz;
    t.gap = at.gap;
    const double p = -at.gap;
    if (!(p > 0.0))
      continue;
    t.force = contact::normal_force(point.support.normal, p, 0.0);
    t.along_n = contact::normal_slopes(point.support.normal, p, 0.0).by_penetration;
    t.along_t = -contact::curvature(point.support.obstacle, y, z) * t.force;
    t.energy = 0.5 * t.force * p;
  }
  return out;
}

double StaticEnergy::value(const VectorXd& x, const std::vector<Touch>& touches) const {
  double sum = 0.5 * x.dot(spring_.cwiseProduct(x)) - load_.dot(x);
  for (const Touch& t : touches)
    sum += t.energy;
  return sum;
}

double StaticEnergy::magnitude(const VectorXd& x, const std::vector<Touch>& touches) const {
  double sum = 0.5 * x.dot(spring_.cwiseProduct(x)) + load_.cwiseAbs().dot(x.cwiseAbs());
  for (const Touch& t : touches)
    sum += t.energy;
  return sum;
}

VectorXd StaticEnergy::gradient(const VectorXd& x, const std::vector<Touch>& touches) const {
  VectorXd out = spring_.cwiseProduct(x) - load_;
  for (std::size_t c = 0; c < touches.size(); ++c)
    if (touches[c].force > 0.0)
      out -= touches[c].force * normal_row(static_cast<Index>(c), touches[c]);
  return held(out);
}

MatrixXd StaticEnergy::hessian(const std::vector<Touch>& touches) const {
  MatrixXd out = spring_.asDiagonal();
  for (std::size_t c = 0; c < touches.size(); ++c) {
    const Touch& t = touches[c];
    if (!(t.force > 0.0))
      continue;
    const auto i = static_cast<Index>(c);
    out.selfadjointView<Eigen::Lower>().rankUpdate(normal_row(i, t), t.along_n);
    if (t.along_t != 0.0)
      out.selfadjointView<Eigen::Lower>().rankUpdate(
          VectorXd(t.nz * rows_.row(2 * i) - t.ny * rows_.row(2 * i + 1)), t.along_t);
  }
  return out;
}

StaticEnergy::Forces StaticEnergy::forces(const VectorXd& x, const std::vector<Touch>& touches) const {
  VectorXd size = spring_.cwiseProduct(x).cwiseAbs() + load_.cwiseAbs(), round_off = VectorXd::Zero(x.size());
  for (std::size_t c = 0; c < touches.size(); ++c) {
    if (!(touches[c].force > 0.0))
      continue;
    const VectorXd row = normal_row(static_cast<Index>(c), touches[c]).cwiseAbs();
    const ContactPoint& point = scene_.contacts[c];
    size += touches[c].force * row;
    round_off += position_round_off * point.support.normal.stiffness *
                 (touches[c].position + std::hypot(point.rest.y(), point.rest.z())) * row;
  }
  return {size.norm(), round_off.norm()};
}

double StaticEnergy::room_along(const VectorXd& step, const std::vector<Touch>& touches) const {
  const VectorXd u = rows_ * step;
  double room = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < touches.size(); ++c) {
    const auto obstacle = contact::properties_of(scene_.contacts[c].support.obstacle);
    if (obstacle.is_concave)
      continue;
    const auto i = static_cast<Index>(2 * c);
    room =
        std::min(room, std::max(0.25 * obstacle.extent, 0.5 * touches[c].gap) / std::hypot(u(i), u(i + 1)));
  }
  return room;
}

bool StaticEnergy::is_carried_away(const VectorXd& x) const {
  return rows_.rows() > 0 && (rows_ * x).cwiseAbs().maxCoeff() > carried_away * length_;
}

bool StaticEnergy::is_convex_at(const std::vector<Touch>& touches) const {
  for (std::size_t c = 0; c < touches.size(); ++c)
    if (touches[c].force > 0.0 && !contact::properties_of(scene_.contacts[c].support.obstacle).is_concave)
      return false;
  return true;
}

} // namespace fretwork::transient
