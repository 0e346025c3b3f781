// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/flexible_beam.hpp"
#include "fem/gauss.hpp"
#include <Eigen/Cholesky>

namespace fretwork::fem {
namespace {

/// a x r as a matrix on r.
Eigen::Matrix3d cross_matrix(const Vec3& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// How end a carries a point with it: u_a + r_a x (point - x_a), r_a.
Shapes carried(const Vec3& point) {
  Shapes shapes = Shapes::Zero();
  shapes.leftCols<6>().setIdentity();
  shapes.block<3, 3>(0, 3) = -cross_matrix(point);
  return shapes;
}

} // namespace

Shapes deformation_matrix(const Vec3& span) {
  Shapes t = -carried(span);
  t.rightCols<6>().setIdentity();
  return t;
}

FlexibleBeam::FlexibleBeam(const BeamAxis& axis, const Eigen::Matrix3d& frame, const BeamProperty& property)
    : axis_(axis), frame_(frame), property_(property), constants_(beam_constants(property)),
      span_(point(axis.length())) {
  const Matrix6 flexibility = motion(axis_.length());
  stiffness_ = (0.5 * (flexibility + flexibility.transpose())).llt().solve(Matrix6::Identity());
  stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
}

Vec3 FlexibleBeam::point(double s) const { return frame_ * (axis_.point(s) - axis_.point(0.0)); }

Eigen::Matrix3d FlexibleBeam::section_axes(double s) const {
  return frame_along(axis_.tangent(s), property_.orientation,
                     beam_text(axis_.point(0.0), axis_.point(axis_.length()))) *
         frame_.transpose();
}

Matrix6 FlexibleBeam::strains(double s) const {
  const Eigen::Matrix3d axes = section_axes(s);
  const Vec3 bending(1.0 / constants_.torsion, 1.0 / constants_.bending_y, 1.0 / constants_.bending_z);
  Matrix6 strain = Matrix6::Zero();
  strain.row(0).head<3>() = axes.row(0) / constants_.axial;
  strain.bottomRightCorner<3, 3>() = bending.asDiagonal() * axes;
  strain.bottomLeftCorner<3, 3>() = strain.bottomRightCorner<3, 3>() * cross_matrix(span_ - point(s));
  return strain;
}

Matrix6 FlexibleBeam::motion(double s) const {
  const Vec3 here = point(s);
  Matrix6 moved = Matrix6::Zero();
  for (const auto& [share, weight] : gauss_points) {
    const double r = share * s;
    const Eigen::Matrix3d to_element = section_axes(r).transpose();
    const Matrix6 strain = strains(r);
    const Eigen::Matrix<double, 3, 6> turn = to_element * strain.bottomRows<3>();
    moved.topRows<3>() +=
        weight * s * (to_element * strain.topRows<3>() - cross_matrix(here - point(r)) * turn);
    moved.bottomRows<3>() += weight * s * turn;
  }
  return moved;
}

Shapes FlexibleBeam::shapes(double s) const {
  return carried(point(s)) + motion(s) * stiffness_ * deformation_matrix(span_);
}

Matrix12 FlexibleBeam::mass() const {
  const double length = axis_.length();
  const Shapes deformation = stiffness_ * deformation_matrix(span_);
  Matrix12 mass = Matrix12::Zero();
  for (const auto& [share, weight] : gauss_points) {
    const double s = share * length;
    const Eigen::Matrix3d axes = section_axes(s);
    const Shapes shape = carried(point(s)) + motion(s) * deformation;
    const Eigen::Matrix<double, 3, 12> moved = axes * shape.topRows<3>();
    const Eigen::Matrix<double, 1, 12> turned = axes.row(0) * shape.bottomRows<3>();
    const Shapes strain = strains(s) * deformation;
    const Vec3 lineic(constants_.mass_axial, constants_.mass_transverse, constants_.mass_transverse);
    mass += weight * length *
            (moved.transpose() * lineic.asDiagonal() * moved +
             constants_.inertia_x * turned.transpose() * turned +
             length * length / 12.0 *
                 (constants_.mass_axial * strain.row(0).transpose() * strain.row(0) +
                  constants_.inertia_x * strain.row(3).transpose() * strain.row(3)));
  }
  return mass;
}

} // namespace fretwork::fem
