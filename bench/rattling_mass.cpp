// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/rattling_mass.hpp"

namespace fretwork::bench {

transient::Scene rattling_mass(const RattlingMass& mass, std::uint64_t draw) {
  constexpr double w = RattlingMass::w;
  transient::Scene scene;
  scene.system.stiffness = Eigen::VectorXd::Constant(2, w * w);
  scene.system.damping = Eigen::VectorXd::Constant(2, 2.0 * mass.damping * w);
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(2);
  scene.duration = mass.duration;
  for (int plane = 0; plane < 2; ++plane)
    scene.loads.push_back(
        {signals::Random{mass.force, 2.0, 100.0, 2 * draw + static_cast<std::uint64_t>(plane)},
         Eigen::VectorXd::Unit(2, plane)});
  transient::ContactPoint hole;
  hole.name = "hole";
  hole.support = {contact::Circle{mass.clearance}, {1e5}, {5e4, 50.0, 0.3, 0.3}};
  hole.b = Eigen::MatrixXd::Zero(3, 2);
  hole.b(1, 0) = hole.b(2, 1) = 1.0;
  scene.contacts = {hole};
  return scene;
}

} // namespace fretwork::bench
