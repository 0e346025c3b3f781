// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_axis.hpp"
#include "core/error.hpp"
#include <Eigen/Geometry>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

/// Sine of the smallest angle between a beam and its orientation vector: below it the y axis would be made of
/// round-off.
constexpr double least_orientation_sine = 1e-6;
/// An arc that turns by less (rad) is a line: meshers place points to 1e-11 of a curve, 1e-9 of an element;
/// frequencies feel the square of the angle.
constexpr double straight_angle = 1e-8;

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

/// Global direction least aligned with x: y then never degenerates.
Vec3 any_orientation(const Vec3& x) {
  Eigen::Index least = 0;
  x.cwiseAbs().minCoeff(&least);
  return Vec3::Unit(least);
}

} // namespace

std::string beam_text(const Vec3& a, const Vec3& b) { return "beam from " + place(a) + " to " + place(b); }

BeamAxis::BeamAxis(const Vec3& a, const Vec3& b, const std::optional<Vec3>& middle) : start_(a) {
  const Vec3 chord = b - a;
  length_ = chord.norm();
  if (!(length_ > 0.0))
    throw core::Error(beam_text(a, b) + " has no length; merge its nodes or move one of them");
  tangent_ = chord / length_;
  if (!middle)
    return;
  const Vec3 p = a - *middle, q = b - *middle, turn = p.cross(q);
  const double angle = 2.0 * std::atan2(turn.norm(), -p.dot(q));
  if (!(angle < 2.0 * EIGEN_PI * (1.0 - straight_angle)) || p.norm() == 0.0 || q.norm() == 0.0)
    throw core::Error(fmt::format("{}: its middle node at {} is not between its ends; put it on the arc from "
                                  "one end to the other",
                                  beam_text(a, b), place(*middle)));
  if (angle < straight_angle)
    return;
  // p x q points along chord x bulge; away from it lies the centre
  const Vec3 inward = turn.normalized().cross(tangent_) * -1.0;
  const double half = 0.5 * angle;
  angle_ = angle;
  length_ /= sinc(half);
  const Vec3 along = tangent_;
  tangent_ = std::cos(half) * along - std::sin(half) * inward;
  normal_ = std::sin(half) * along + std::cos(half) * inward;
}

Vec3 BeamAxis::point(double s) const {
  const double turned = angle_ * s / length_;
  return start_ + s * (sinc(turned) * tangent_ + std::sin(0.5 * turned) * sinc(0.5 * turned) * normal_);
}

Vec3 BeamAxis::tangent(double s) const {
  const double turned = angle_ * s / length_;
  return std::cos(turned) * tangent_ + std::sin(turned) * normal_;
}

Vec3 BeamAxis::inward(double s) const {
  const double turned = angle_ * s / length_;
  return std::cos(turned) * normal_ - std::sin(turned) * tangent_;
}

Eigen::Matrix3d frame_along(const Vec3& x, const std::optional<Vec3>& orientation, const Vec3& a,
                            const Vec3& b) {
  const Vec3 guide = orientation ? *orientation : any_orientation(x);
  const Vec3 across = guide - x * x.dot(guide);
  if (!(across.norm() > least_orientation_sine * guide.norm()))
    throw core::Error(
        fmt::format("{}: orientation {} is along the beam (or zero); give a vector in the plane of the beam "
                    "and the y axis of its section",
                    beam_text(a, b), place(guide)));
  const Vec3 y = across.normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = x.transpose();
  axes.row(1) = y.transpose();
  axes.row(2) = x.cross(y).transpose();
  return axes;
}

} // namespace fretwork::fem
