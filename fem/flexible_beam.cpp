// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/flexible_beam.hpp"
#include "fem/gauss.hpp"
#include <Eigen/Cholesky>
#include <cmath>

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

FlexibleBeam::FlexibleBeam(const BeamAxis& axis, const Eigen::Matrix3d& frame, const BeamProperty& property,
                           const std::array<double, 2>& along)
    : axis_(axis), frame_(frame), property_(property), along_(along), span_(point(axis.length())) {
  const Matrix6 flexibility = motion(axis_.length());
  stiffness_ = (0.5 * (flexibility + flexibility.transpose())).llt().solve(Matrix6::Identity());
  stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
}

Vec3 FlexibleBeam::point(double s) const { return frame_ * (axis_.point(s) - axis_.point(0.0)); }

BeamConstants FlexibleBeam::constants(double s) const {
  return beam_constants(property_, std::lerp(along_[0], along_[1], s / axis_.length()));
}

Eigen::Matrix3d FlexibleBeam::section_axes(double s) const {
  return frame_along(axis_.tangent(s), property_.orientation, axis_.point(0.0), axis_.point(axis_.length())) *
         frame_.transpose();
}

Matrix6 FlexibleBeam::strains(double s) const {
  const Eigen::Matrix3d axes = section_axes(s);
  const BeamConstants k = constants(s);
  const Vec3 stretching(1.0 / k.axial, k.shear_y, k.shear_z);
  const Vec3 bending(1.0 / k.torsion, 1.0 / k.bending_y, 1.0 / k.bending_z);
  Matrix6 strain = Matrix6::Zero();
  strain.topLeftCorner<3, 3>() = stretching.asDiagonal() * axes;
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

Matrix6 FlexibleBeam::slope_spread() const {
  const double length = axis_.length();
  Matrix6 spread = Matrix6::Zero();
  for (const auto& [share, weight] : gauss_points) {
    const double s = share * length;
    const Eigen::Matrix3d axes = section_axes(s);
    Eigen::Matrix<double, 3, 6> slope = // sheared and turned: gamma + theta x t
        (axes.transpose() * strains(s).topRows<3>() - cross_matrix(axes.row(0)) * motion(s).bottomRows<3>()) *
        stiffness_;
    slope.leftCols<3>() -= Eigen::Matrix3d::Identity() / length;
    spread += weight * length * slope.bottomRows<2>().transpose() * slope.bottomRows<2>();
  }
  return spread;
}

FlexibleBeam::MovingSection FlexibleBeam::section(double s, const Shapes& deformation) const {
  const BeamConstants k = constants(s);
  return {section_axes(s),
          k,
          carried(point(s)) + motion(s) * deformation,
          strains(s) * deformation,
          {k.mass_axial, k.mass_transverse, k.mass_transverse},
          {k.inertia_x, k.inertia_y, k.inertia_z}};
}

InnerMotion FlexibleBeam::inner_motion() const {
  const double length = axis_.length(), curvature = axis_.angle() / length;
  const Shapes deformation = stiffness_ * deformation_matrix(span_);
  InnerMotion inner;
  inner.stiffness.setZero();
  inner.mass.setZero();
  inner.coupling.setZero();
  inner.strain_mass.resize(2 * static_cast<Eigen::Index>(gauss_points.size()), 12);
  Eigen::Index row = 0;
  for (const auto& [share, weight] : gauss_points) {
    const double s = share * length, w = weight * length;
    const double b = 4.0 * share * (1.0 - share), slope = 4.0 * (1.0 - 2.0 * share) / length;
    const Vec3 tangent = frame_ * axis_.tangent(s), inward = frame_ * axis_.inward(s),
               normal = tangent.cross(inward); // of the plane of the arc; zero where straight
    const auto [axes, k, shape, strain, lineic, inertia] = section(s, deformation);
    const Vec3 bending(k.torsion, k.bending_y, k.bending_z);
    Eigen::Matrix<double, 3, 2> moved, turned, bent;
    moved << axes * tangent * b, Vec3::Zero();
    turned << axes * normal * (curvature * b), axes * tangent * b;
    bent << axes * normal * (curvature * slope), axes * (tangent * slope + inward * (curvature * b));
    inner.stiffness += w * bent.transpose() * bending.asDiagonal() * bent;
    inner.stiffness(0, 0) += w * k.axial * slope * slope;
    inner.mass += w * (moved.transpose() * lineic.asDiagonal() * moved +
                       turned.transpose() * inertia.asDiagonal() * turned);
    inner.coupling += w * (moved.transpose() * lineic.asDiagonal() * (axes * shape.topRows<3>()) +
                           turned.transpose() * inertia.asDiagonal() * (axes * shape.bottomRows<3>()));
    inner.strain_mass.row(row++) = length * std::sqrt(w * k.mass_axial / 12.0) * strain.row(0);
    inner.strain_mass.row(row++) = length * std::sqrt(w * k.inertia_x / 12.0) * strain.row(3);
  }
  return inner;
}

Matrix12 FlexibleBeam::mass() const {
  const double length = axis_.length();
  const Shapes deformation = stiffness_ * deformation_matrix(span_);
  Matrix12 mass = Matrix12::Zero();
  for (const auto& [share, weight] : gauss_points) {
    const double s = share * length;
    const auto [axes, k, shape, strain, lineic, inertia] = section(s, deformation);
    const Eigen::Matrix<double, 3, 12> moved = axes * shape.topRows<3>(),
                                       turned = axes * shape.bottomRows<3>();
    mass += weight * length *
            (moved.transpose() * lineic.asDiagonal() * moved +
             turned.transpose() * inertia.asDiagonal() * turned +
             length * length / 12.0 *
                 (k.mass_axial * strain.row(0).transpose() * strain.row(0) +
                  k.inertia_x * strain.row(3).transpose() * strain.row(3)));
  }
  return mass;
}

} // namespace fretwork::fem
