// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/mesh_error.hpp"
#include "fem/beam_constants.hpp"
#include "fem/flexible_beam.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <numbers>

namespace fretwork::fem {
namespace {

double squared(double x) { return x * x; }

/// One plane of bending.
struct Plane {
  double bending, shear; ///< EI, 1/(k G A)
  double inertia;        ///< of mass, m
  double pull;           ///< N - lambda rho I
};

/// E: deflections wa, wb and slopes sa, sb of the ends.
double bending_energy(const Plane& plane, double length, double lambda, double wa, double wb, double sa,
                      double sb) {
  const double phi = 12.0 * plane.bending * plane.shear / squared(length),
               gamma = phi / (1.0 + phi) * ((wb - wa) / length - 0.5 * (sa + sb));
  const double l = 0.5 * length, a = l * (sa + gamma), b = l * (sb + gamma);
  const double w0 = 0.5 * (wa + wb) + (a - b) / 6.0, w1 = 0.6 * (wb - wa) - 0.1 * (a + b), w2 = (b - a) / 6.0,
               w3 = 0.1 * (a + b - wb + wa);
  const double q = lambda * plane.inertia, p = plane.pull / squared(l);
  const double q0 = q * w0 + 3.0 * p * w2, q1 = q * w1 + 15.0 * p * w3, q2 = q * w2, q3 = q * w3;
  const double c2 = q0 / 3.0 - 2.0 * q2 / 21.0, c3 = q1 / 15.0 - 2.0 * q3 / 45.0, c4 = q2 / 35.0,
               c5 = q3 / 63.0;
  const double f1 = q0 - q2 / 5.0, f2 = q1 / 3.0 - q3 / 7.0, f3 = q2 / 5.0, f4 = q3 / 7.0;
  const double cube = l * l * l;
  return cube * l * l / plane.bending *
             (2.0 / 5.0 * c2 * c2 + 2.0 / 7.0 * c3 * c3 + 2.0 / 9.0 * c4 * c4 + 2.0 / 11.0 * c5 * c5) +
         cube * plane.shear *
             (2.0 / 3.0 * f1 * f1 + 2.0 / 5.0 * f2 * f2 + 2.0 / 7.0 * f3 * f3 + 2.0 / 9.0 * f4 * f4);
}

/// (k L)^2 of two elements a half wave; with fewer the series of E means nothing.
constexpr double resolved_wave = 0.25 * std::numbers::pi * std::numbers::pi;

/// E of a bar or shaft between ua and ub; intensity: lambda m.
double axial_energy(double stiffness, double length, double intensity, double ua, double ub) {
  const double l = 0.5 * length, q1 = intensity * 0.5 * (ub - ua);
  const double wave = std::min(intensity * length * length / stiffness, resolved_wave);
  return 2.0 / 45.0 * l * l * l * q1 * q1 / stiffness * (1.0 + 23.0 / 42.0 * wave);
}

/// Displacement, slopes across and rotation about the axis of one end, in its frame.
struct End {
  Vec3 displacement;
  double slope_y, slope_z, turn;
};

End end_of(const Eigen::Matrix3d& frame, double curvature, const Vec3& displacement, const Vec3& rotation) {
  const Vec3 u = frame * displacement, r = frame * rotation;
  return {u, r.z() - curvature * u.x(), -r.y(), r.x()};
}

/// In the middle of the beam, which stands for all of it; the softer plane of an arc for both, whichever way its section
/// is turned.
BeamConstants constants_of(const BeamAxis& axis, const BeamProperty& property, const Beam& beam) {
  BeamConstants k = beam_constants(property, 0.5 * (beam.along[0] + beam.along[1]));
  if (!axis.is_straight()) {
    k.bending_y = k.bending_z = std::min(k.bending_y, k.bending_z);
    k.shear_y = k.shear_z = std::max(k.shear_y, k.shear_z);
    k.inertia_y = k.inertia_z = std::max(k.inertia_y, k.inertia_z);
  }
  return k;
}

/// One beam, ready for many fields.
class ElementError {
public:
  ElementError(const Model& model, const Beam& beam)
      : property_(model.properties[static_cast<std::size_t>(beam.property)]),
        axis_(model.nodes[static_cast<std::size_t>(beam.a)], model.nodes[static_cast<std::size_t>(beam.b)],
              beam.middle),
        k_(constants_of(axis_, property_, beam)), force_(axial_force(property_, beam.along)),
        frame_a_(frame_at(0.0)), frame_b_(frame_at(axis_.length())) {}

  [[nodiscard]] double energy(const Vector12& u, double lambda) const {
    const double l = axis_.length(), curvature = axis_.angle() / l;
    const End a = end_of(frame_a_, curvature, u.segment<3>(0), u.segment<3>(3)),
              b = end_of(frame_b_, curvature, u.segment<3>(6), u.segment<3>(9));
    const Plane y{k_.bending_z, k_.shear_y, k_.mass_transverse, force_ - lambda * k_.inertia_z},
        z{k_.bending_y, k_.shear_z, k_.mass_transverse, force_ - lambda * k_.inertia_y};
    return bending_energy(y, l, lambda, a.displacement.y(), b.displacement.y(), a.slope_y, b.slope_y) +
           bending_energy(z, l, lambda, a.displacement.z(), b.displacement.z(), a.slope_z, b.slope_z) +
           axial_energy(k_.axial, l, lambda * k_.mass_axial, a.displacement.x(), b.displacement.x()) +
           axial_energy(k_.torsion, l, lambda * k_.inertia_x, a.turn, b.turn);
  }

private:
  /// Rows tangent, y, z at s; y towards the centre of an arc.
  [[nodiscard]] Eigen::Matrix3d frame_at(double s) const {
    const Vec3 x = axis_.tangent(s);
    if (axis_.is_straight())
      return frame_along(x, property_.orientation, axis_.point(0.0), axis_.point(axis_.length()));
    const Vec3 y = axis_.inward(s);
    Eigen::Matrix3d frame;
    frame << x.transpose(), y.transpose(), x.cross(y).transpose();
    return frame;
  }

  const BeamProperty& property_;
  BeamAxis axis_;
  BeamConstants k_;
  double force_; ///< N, axial
  Eigen::Matrix3d frame_a_, frame_b_;
};

} // namespace

Eigen::VectorXd mesh_error(const Model& model, const Structure& structure, const Eigen::MatrixXd& fields,
                           const Eigen::VectorXd& lambda) {
  assert(fields.cols() == lambda.size());
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(fields.cols());
  for (const Index number : structure.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const ElementError element(model, beam);
    const Eigen::Index a = Eigen::Index{position_of(structure, beam.a)} * dofs_per_node,
                       b = Eigen::Index{position_of(structure, beam.b)} * dofs_per_node;
    for (Eigen::Index j = 0; j < fields.cols(); ++j) {
      Vector12 u;
      u << fields.col(j).segment<6>(a), fields.col(j).segment<6>(b);
      energy[j] += element.energy(u, lambda[j]);
    }
  }
  return energy.binaryExpr(lambda, [](double e, double l) { return l > 0.0 ? 0.5 * e / l : 0.0; });
}

} // namespace fretwork::fem
