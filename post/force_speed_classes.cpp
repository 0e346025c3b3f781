// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/force_speed_classes.hpp"

namespace fretwork::post {

ForceSpeedClasses::ForceSpeedClasses(const std::vector<std::optional<wear::KwuMaxima>>& maxima, double from)
    : from_(from) {
  for (const auto& of_contact : maxima) {
    watched_.push_back(of_contact ? static_cast<int>(classes_.size()) : none);
    if (of_contact)
      classes_.emplace_back(of_contact->force, of_contact->speed);
  }
}

void ForceSpeedClasses::step(const transient::Record& record) {
  if (!(record.time >= from_))
    return;
  for (const int c : record.active) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    const int at = watched_[static_cast<std::size_t>(c)];
    const double time = state.closed * record.step;
    if (at != none && time > 0.0)
      classes_[static_cast<std::size_t>(at)].add(state.normal_force / state.closed, state.slid / time, time);
  }
}

} // namespace fretwork::post
