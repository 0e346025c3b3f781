// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/obstacle_motion.hpp"
#include <algorithm>
#include <array>

namespace fretwork::transient {

ObstacleMotion::ObstacleMotion(const Scene& scene, const PackedContacts& contacts, double step)
    : contacts_(contacts), h_(step) {
  constexpr std::array<int, 3> component = {1, 2, 0}; // of the blocks of lanes: y, z, x
  const auto stride = static_cast<std::size_t>(contacts.stride());
  const auto add_lanes = [&](auto matrix_of, std::size_t column) {
    imposed_.resize(imposed_.size() + stride, 0.0);
    double* lanes = imposed_.data() + imposed_.size() - stride;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
      if (const Eigen::MatrixXd& imposed = matrix_of(scene.contacts[c]); imposed.size() > 0)
        for (int block = 0; block < contacts.components; ++block)
          lanes[static_cast<std::size_t>(block * contacts.width) + c] =
              imposed(component[static_cast<std::size_t>(block)], static_cast<Eigen::Index>(column));
  };
  for (std::size_t k = 0; k < scene.motions.size(); ++k) {
    signals_.emplace_back(scene.motions[k], scene.duration);
    add_lanes([](const ContactPoint& point) -> const Eigen::MatrixXd& { return point.imposed; }, k);
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
}

ImposedMotion ObstacleMotion::workspace() const {
  const bool still = signals_.empty() && loads_.empty();
  const kernels::Array lanes(still ? 0 : static_cast<std::size_t>(contacts_.stride()), 0.0);
  return {lanes, lanes};
}

template <class Move> void ObstacleMotion::each(double time, const Move& move) const {
  const auto stride = static_cast<std::size_t>(contacts_.stride());
  const double* imposed = imposed_.data();
  for (const MotionSignal& signal : signals_) {
    const MotionState s = signal(time);
    move(imposed, s.displacement, s.velocity);
    imposed += stride;
  }
  for (const Signal& load : loads_) {
    const double from = std::max(0.0, time - 0.5 * h_), to = time + 0.5 * h_;
    move(imposed, load.over_step(time, h_),
         (load.over_step(to, h_) - load.over_step(from, h_)) / (to - from));
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

void ObstacleMotion::add(double time, int c, ContactMotion& motion) const {
  each(time, [&](const double* lanes, double displacement, double velocity) {
    for (int lane = c; lane < contacts_.stride(); lane += contacts_.width) {
      motion.u[static_cast<std::size_t>(lane)] += lanes[lane] * displacement;
      motion.w[static_cast<std::size_t>(lane)] += lanes[lane] * velocity;
    }
  });
}

} // namespace fretwork::transient
