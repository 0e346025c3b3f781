// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/obstacle_motion.hpp"
#include <algorithm>
#include <array>

namespace fretwork::transient {

ObstacleMotion::ObstacleMotion(const Scene& scene, const PackedContacts& contacts) : contacts_(contacts) {
  constexpr std::array<int, 3> component = {1, 2, 0}; // of the blocks of lanes: y, z, x
  const auto stride = static_cast<std::size_t>(contacts.stride());
  imposed_.resize(scene.motions.size() * stride, 0.0);
  for (std::size_t k = 0; k < scene.motions.size(); ++k) {
    signals_.emplace_back(scene.motions[k], scene.duration);
    double* lanes = imposed_.data() + k * stride;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
      if (const Eigen::MatrixXd& imposed = scene.contacts[c].imposed; imposed.size() > 0)
        for (int block = 0; block < contacts.components; ++block)
          lanes[static_cast<std::size_t>(block * contacts.width) + c] =
              imposed(component[static_cast<std::size_t>(block)], static_cast<Eigen::Index>(k));
  }
}

ImposedMotion ObstacleMotion::workspace() const {
  const kernels::Array lanes(signals_.empty() ? 0 : static_cast<std::size_t>(contacts_.stride()), 0.0);
  return {lanes, lanes};
}

template <class Move> void ObstacleMotion::each(double time, const Move& move) const {
  const auto stride = static_cast<std::size_t>(contacts_.stride());
  const double* imposed = imposed_.data();
  for (const signals::MotionSignal& signal : signals_) {
    const signals::MotionState s = signal(time);
    move(imposed, s.displacement, s.velocity);
    imposed += stride;
  }
}

void ObstacleMotion::at(double time, ImposedMotion& imposed) const {
  std::fill(imposed.u.begin(), imposed.u.end(), 0.0);
  std::fill(imposed.w.begin(), imposed.w.end(), 0.0);
  each(time, [&](const double* lanes, double displacement, double velocity) {
    for (std::size_t lane = 0; lane < imposed.u.size(); ++lane) {
      imposed.u[lane] += lanes[lane] * displacement;
      imposed.w[lane] += lanes[lane] * velocity;
    }
  });
}

void ObstacleMotion::place(double time, const double* q, const double* v, ImposedMotion& imposed,
                           ContactMotion& motion) const {
  motion.gather(q, v);
  at(time, imposed);
  imposed.add_to(motion);
}

void ObstacleMotion::add(double time, int c, ContactMotion& motion) const {
  each(time, [&](const double* lanes, double displacement, double velocity) {
    for (int lane = c; lane < contacts_.stride(); lane += contacts_.width) {
      motion.u[static_cast<std::size_t>(lane)] += lanes[lane] * displacement;
      motion.w[static_cast<std::size_t>(lane)] += lanes[lane] * velocity;
    }
  });
}

} // namespace fretwork::transient
