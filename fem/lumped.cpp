// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/lumped.hpp"

namespace fretwork::fem {

Matrix6 lumped_mass_matrix(const LumpedMass& body) {
  const Vec3& a = body.arm;
  Eigen::Matrix3d s;
  s << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  Matrix6 m;
  m << body.mass * Eigen::Matrix3d::Identity(), -body.mass * s, body.mass * s, -body.mass * s * s;
  m.bottomRightCorner<3, 3>().diagonal() += body.inertia;
  return m;
}

} // namespace fretwork::fem
