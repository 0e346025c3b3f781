// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_point.hpp"
#include "core/error.hpp"
#include "fem/beam_element.hpp"
#include <Eigen/Geometry>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

constexpr double at_node = 1e-9; ///< of a beam's length

const Vec3& place_of(const Model& model, Index node) { return model.nodes[static_cast<std::size_t>(node)]; }

BeamAxis axis_of(const Model& model, const Beam& beam) {
  return {place_of(model, beam.a), place_of(model, beam.b), beam.middle};
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

/// The direction in which a beam leaves a node.
Vec3 leaving(const Model& model, const Beam& beam, Index node) {
  const Vec3 tangent = tangent_at(model, beam, node);
  return beam.a == node ? tangent : Vec3(-tangent);
}

const Beam& first_beam(const Model& model, Index node, const Vec3& direction, const std::string& what) {
  const Beam* best = nullptr;
  double most = 0.0;
  for (const Beam* beam : beams_at(model, node, nullptr)) {
    const double along = leaving(model, *beam, node).dot(direction);
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

Vec3 tangent_at(const Model& model, const Beam& beam, Index node) {
  const BeamAxis axis = axis_of(model, beam);
  return axis.tangent(beam.a == node ? 0.0 : axis.length());
}

BeamPoint point_at(const Model& model, Index node) {
  Eigen::Matrix<double, 3, 6> weights = Eigen::Matrix<double, 3, 6>::Zero();
  weights.leftCols<3>().setIdentity();
  return {place_of(model, node), {{node, weights}}};
}

BeamPoint point_on(const Model& model, const Beam& beam, double s) {
  const BeamElement element(model, beam);
  const Eigen::Matrix<double, 3, 12> moved = element.shapes(s).topRows<3>();
  return {element.axis().point(s * element.axis().length()),
          {{beam.a, moved.leftCols<6>()}, {beam.b, moved.rightCols<6>()}}};
}

BeamPoint point_along(const Model& model, Index node, const Vec3& direction, double distance,
                      const std::string& what) {
  if (distance == 0.0)
    return point_at(model, node);
  const Beam* beam = &first_beam(model, node, direction, what);
  double walked = 0.0;
  while (true) {
    const Index end = far_end(*beam, node);
    const double length = axis_of(model, *beam).length();
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
