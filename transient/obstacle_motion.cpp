// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/obstacle_motion.hpp"
#include <algorithm>
#include <array>

namespace fretwork::transient {

ObstacleMotion::ObstacleMotion(const Scene& scene, const PackedContacts& contacts) : contacts_(contacts) {
  constexpr std::array<int, 3> component = {1, 2, 0}; // of the blocks of lanes: y, z, x
  const auto stride = static_cast<std::size_t>(contacts.stride());
  for (std::size_t k = 0; k < scene.motions.size(); ++k) {
    signals_.emplace_back(scene.motions[k], scene.duration);
    carried_.resize((k + 1) * stride, 0.0);
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
      if (const Eigen::MatrixXd& carried = scene.contacts[c].carried; carried.size() > 0)
        for (int block = 0; block < contacts.components; ++block)
          carried_[k * stride + static_cast<std::size_t>(block * contacts.width) + c] =
              carried(component[static_cast<std::size_t>(block)], static_cast<Eigen::Index>(k));
  }
  velocity_.assign(stride, 0.0);
}

void ObstacleMotion::add(double time, ContactMotion& motion) {
  if (signals_.empty())
    return;
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  const double* carried = carried_.data();
  for (const MotionSignal& signal : signals_) {
    const MotionState s = signal(time);
    for (std::size_t l = 0; l < velocity_.size(); ++l) {
      motion.u[l] += carried[l] * s.displacement;
      velocity_[l] += carried[l] * s.velocity;
    }
    carried += velocity_.size();
  }
  for (std::size_t l = 0; l < velocity_.size(); ++l)
    motion.w[l] += velocity_[l];
}

double ObstacleMotion::power(const ContactTrial& trial) const {
  if (signals_.empty())
    return 0.0;
  const auto width = static_cast<std::size_t>(contacts_.width);
  double sum = 0.0;
  for (const int active : trial.active) {
    const auto c = static_cast<std::size_t>(active);
    const ContactState& s = trial.states[c];
    sum += (s.normal_force * s.ny + s.friction.t * s.nz) * velocity_[c] +
           (s.normal_force * s.nz - s.friction.t * s.ny) * velocity_[width + c];
    if (contacts_.components == 3)
      sum += s.friction.x * velocity_[2 * width + c];
  }
  return sum;
}

} // namespace fretwork::transient
