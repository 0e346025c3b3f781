// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/obstacle_motion.hpp"
#include <algorithm>
#include <array>

namespace fretwork::transient {

ObstacleMotion::ObstacleMotion(const Scene& scene, const PackedContacts& contacts, double step)
    : contacts_(contacts), h_(step) {
  constexpr std::array<int, 3> component = {1, 2, 0}; // of the blocks of lanes: y, z, x
  const auto stride = static_cast<std::size_t>(contacts.stride());
  const auto add_lanes = [&](auto matrix_of, std::size_t column) {
    carried_.resize(carried_.size() + stride, 0.0);
    double* lanes = carried_.data() + carried_.size() - stride;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
      if (const Eigen::MatrixXd& carried = matrix_of(scene.contacts[c]); carried.size() > 0)
        for (int block = 0; block < contacts.components; ++block)
          lanes[static_cast<std::size_t>(block * contacts.width) + c] =
              carried(component[static_cast<std::size_t>(block)], static_cast<Eigen::Index>(column));
  };
  for (std::size_t k = 0; k < scene.motions.size(); ++k) {
    signals_.emplace_back(scene.motions[k], scene.duration);
    add_lanes([](const ContactPoint& point) -> const Eigen::MatrixXd& { return point.carried; }, k);
  }
  for (std::size_t k = 0; k < scene.loads.size(); ++k) {
    const auto moves = [&](const ContactPoint& point) {
      return point.under_loads.size() > 0 && !point.under_loads.col(static_cast<Eigen::Index>(k)).isZero(0.0);
    };
    if (std::none_of(scene.contacts.begin(), scene.contacts.end(), moves))
      continue;
    loads_.emplace_back(scene.loads[k].function, scene.duration);
    add_lanes([](const ContactPoint& point) -> const Eigen::MatrixXd& { return point.under_loads; }, k);
  }
  velocity_.assign(stride, 0.0);
}

void ObstacleMotion::add(double time, ContactMotion& motion) {
  if (still())
    return;
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  const double* carried = carried_.data();
  const auto move = [&](double displacement, double velocity) {
    for (std::size_t l = 0; l < velocity_.size(); ++l) {
      motion.u[l] += carried[l] * displacement;
      velocity_[l] += carried[l] * velocity;
    }
    carried += velocity_.size();
  };
  for (const MotionSignal& signal : signals_) {
    const MotionState s = signal(time);
    move(s.displacement, s.velocity);
  }
  for (const Signal& load : loads_) {
    const double before = std::max(0.0, time - 0.5 * h_), after = time + 0.5 * h_;
    move(load(time), (load(after) - load(before)) / h_);
  }
  for (std::size_t l = 0; l < velocity_.size(); ++l)
    motion.w[l] += velocity_[l];
}

double ObstacleMotion::power(const ContactTrial& trial) const {
  if (still())
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
