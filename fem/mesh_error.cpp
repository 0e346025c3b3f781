// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/mesh_error.hpp"
#include "fem/beam_constants.hpp"
#include "fem/beam_element.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace fretwork::fem {
namespace {

double squared(double x) { return x * x; }

/// E: deflections wa, wb and slopes sa, sb at the ends, load `intensity` (N/m2) times the
/// cubic between them.
double bending_energy(double stiffness, double length, double intensity, double wa, double wb, double sa,
                      double sb) {
  const double l = 0.5 * length, a = l * sa, b = l * sb;
  const double q0 = 0.5 * (wa + wb) + (a - b) / 6.0, q1 = 0.6 * (wb - wa) - 0.1 * (a + b), q2 = (b - a) / 6.0,
               q3 = 0.1 * (a + b - wb + wa);
  const double c2 = q0 / 3.0 - 2.0 * q2 / 21.0, c3 = q1 / 15.0 - 2.0 * q3 / 45.0, c4 = q2 / 35.0,
               c5 = q3 / 63.0;
  return squared(intensity) * std::pow(l, 5) / stiffness *
         (2.0 / 5.0 * c2 * c2 + 2.0 / 7.0 * c3 * c3 + 2.0 / 9.0 * c4 * c4 + 2.0 / 11.0 * c5 * c5);
}

/// Of a bar or shaft between ua and ub: lambda times twice the kinetic energy of the linear shape, times the
/// error of a wave.
double axial_energy(double stiffness, double length, double intensity, double ua, double ub) {
  const double mean = 0.5 * (ua + ub), half = 0.5 * (ub - ua);
  return intensity * length * (mean * mean + half * half / 3.0) *
         squared(intensity * length * length / stiffness) / 240.0;
}

/// Displacement, slopes across and rotation about the axis of one end, in its frame.
struct End {
  Vec3 displacement;
  double slope_y, slope_z, turn;
};

/// Frames of the two ends: rows tangent, y, z; y towards the centre of an arc.
std::array<Eigen::Matrix3d, 2> end_frames(const BeamAxis& axis, const BeamProperty& property) {
  const std::array<Vec3, 2> tangents{axis.tangent(0.0), axis.tangent(axis.length())};
  if (axis.is_straight()) {
    const Eigen::Matrix3d frame = frame_along(tangents[0], property.orientation, "beam");
    return {frame, frame};
  }
  const Vec3 across = tangents[0].cross(tangents[1]).normalized(); // arcs turn by less than half a circle
  std::array<Eigen::Matrix3d, 2> frames;
  for (std::size_t i = 0; i < 2; ++i)
    frames[i] << tangents[i].transpose(), across.cross(tangents[i]).transpose(), across.transpose();
  return frames;
}

End end_of(const Eigen::Matrix3d& frame, double curvature, const Vec3& displacement, const Vec3& rotation) {
  const Vec3 u = frame * displacement, r = frame * rotation;
  return {u, r.z() - curvature * u.x(), -r.y(), r.x()};
}

double element_energy(const BeamElement& element, const BeamProperty& property, const Vector12& u,
                      double lambda) {
  const BeamAxis& axis = element.axis();
  BeamConstants k = beam_constants(property);
  if (!axis.is_straight()) // whichever way the section is turned
    k.bending_y = k.bending_z = std::min(k.bending_y, k.bending_z);
  const double l = axis.length(), curvature = axis.angle() / l;
  const auto frames = end_frames(axis, property);
  const End a = end_of(frames[0], curvature, u.segment<3>(0), u.segment<3>(3)),
            b = end_of(frames[1], curvature, u.segment<3>(6), u.segment<3>(9));
  const double across = lambda * k.mass_transverse;
  return bending_energy(k.bending_z, l, across, a.displacement.y(), b.displacement.y(), a.slope_y,
                        b.slope_y) +
         bending_energy(k.bending_y, l, across, a.displacement.z(), b.displacement.z(), a.slope_z,
                        b.slope_z) +
         axial_energy(k.axial, l, lambda * k.mass_axial, a.displacement.x(), b.displacement.x()) +
         axial_energy(k.torsion, l, lambda * k.inertia_x, a.turn, b.turn);
}

} // namespace

Eigen::VectorXd mesh_error(const Model& model, const Structure& structure, const Eigen::MatrixXd& fields,
                           const Eigen::VectorXd& lambda) {
  assert(fields.cols() == lambda.size());
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(fields.cols());
  for (const Index number : structure.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const BeamProperty& property = model.properties[static_cast<std::size_t>(beam.property)];
    const BeamElement element(model, beam);
    const Eigen::Index a = Eigen::Index{position_of(structure, beam.a)} * dofs_per_node,
                       b = Eigen::Index{position_of(structure, beam.b)} * dofs_per_node;
    for (Eigen::Index j = 0; j < fields.cols(); ++j) {
      Vector12 u;
      u << fields.col(j).segment<6>(a), fields.col(j).segment<6>(b);
      energy[j] += element_energy(element, property, u, lambda[j]);
    }
  }
  return energy.binaryExpr(lambda, [](double e, double l) { return l > 0.0 ? 0.5 * e / l : 0.0; });
}

} // namespace fretwork::fem
