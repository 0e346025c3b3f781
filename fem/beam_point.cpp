// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_point.hpp"
#include "core/error.hpp"
#include <Eigen/Geometry>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

constexpr double at_node = 1e-9; ///< of a beam's length

const Vec3& place_of(const Model& model, Index node) { return model.nodes[static_cast<std::size_t>(node)]; }

/// r x e as a matrix on r.
Eigen::Matrix3d cross_with(const Vec3& e) {
  Eigen::Matrix3d out;
  out << 0.0, e.z(), -e.y(), -e.z(), 0.0, e.x(), e.y(), -e.x(), 0.0;
  return out;
}

Index far_end(const Beam& beam, Index node) { return beam.a == node ? beam.b : beam.a; }

/// The beams at a node, without the one that leads to it.
std::vector<const Beam*> beams_at(const Model& model, Index node, const Beam* before) {
  std::vector<const Beam*> out;
  for (const Beam& beam : model.beams)
    if ((beam.a == node || beam.b == node) && &beam != before)
      out.push_back(&beam);
  return out;
}

const Beam& first_beam(const Model& model, Index node, const Vec3& direction, const std::string& what) {
  const Beam* best = nullptr;
  double most = 0.0;
  for (const Beam* beam : beams_at(model, node, nullptr)) {
    const double along =
        (place_of(model, far_end(*beam, node)) - place_of(model, node)).normalized().dot(direction);
    if (along > most) {
      most = along;
      best = beam;
    }
  }
  if (!best)
    throw core::Error(fmt::format("{}: no beam leaves its node at {} towards {}; the tube must reach as far "
                                  "as the support on both sides: take a smaller thickness, or another node",
                                  what, place(place_of(model, node)), place(direction)));
  return *best;
}

} // namespace

BeamPoint point_at(const Model& model, Index node) {
  Eigen::Matrix<double, 3, 6> weights = Eigen::Matrix<double, 3, 6>::Zero();
  weights.leftCols<3>().setIdentity();
  return {place_of(model, node), {{node, weights}}};
}

BeamPoint point_on(const Model& model, const Beam& beam, double s) {
  const Vec3 &a = place_of(model, beam.a), &b = place_of(model, beam.b);
  const double length = (b - a).norm();
  const Vec3 e = (b - a) / length;
  const Eigen::Matrix3d along = e * e.transpose(), across = Eigen::Matrix3d::Identity() - along;
  const Eigen::Matrix3d turn = cross_with(e);
  const double h_b = s * s * (3.0 - 2.0 * s);
  Eigen::Matrix<double, 3, 6> of_a, of_b;
  of_a << (1.0 - s) * along + (1.0 - h_b) * across, length * s * (1.0 - s) * (1.0 - s) * turn;
  of_b << s * along + h_b * across, length * s * s * (s - 1.0) * turn;
  return {a + s * (b - a), {{beam.a, of_a}, {beam.b, of_b}}};
}

BeamPoint point_along(const Model& model, Index node, const Vec3& direction, double distance,
                      const std::string& what) {
  if (distance == 0.0)
    return point_at(model, node);
  const Beam* beam = &first_beam(model, node, direction, what);
  double walked = 0.0;
  while (true) {
    const Index end = far_end(*beam, node);
    const double length = (place_of(model, end) - place_of(model, node)).norm();
    const double s = (distance - walked) / length;
    if (s < 1.0 - at_node)
      return s < at_node ? point_at(model, node) : point_on(model, *beam, beam->a == node ? s : 1.0 - s);
    if (s <= 1.0 + at_node)
      return point_at(model, end);
    walked += length;
    const auto next = beams_at(model, end, beam);
    if (next.size() != 1)
      throw core::Error(fmt::format("{}: the beam {} at {}, {:g} m from its node, before the edge of the "
                                    "support at {:g} m; take a smaller "
                                    "thickness, or another node",
                                    what, next.empty() ? "ends" : "branches", place(place_of(model, end)),
                                    walked, distance));
    node = end;
    beam = next[0];
  }
}

} // namespace fretwork::fem
