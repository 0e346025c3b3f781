// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/sector_work.hpp"

namespace fretwork::post {

SectorStatistics::SectorStatistics(const std::vector<int>& sectors, double from,
                                   std::span<const transient::ContactPoint> by_place)
    : from_(from), by_place_(by_place) {
  for (const int n : sectors) {
    watched_.push_back(n == 0 ? none : static_cast<int>(work_.size()));
    if (n != 0)
      work_.emplace_back(n);
  }
}

double SectorStatistics::angle(const transient::Record& record, std::size_t contact) const {
  if (!by_place_.empty()) {
    const transient::ContactPoint& point = by_place_[contact];
    if (contact::properties_of(point.support.obstacle).has_parts)
      return wear::contact_angle(-(point.rest.y() + record.uy[contact]),
                                 -(point.rest.z() + record.uz[contact]));
  }
  const contact::ContactAxes& axes = record.states[contact].axes;
  return wear::contact_angle(axes.ny, axes.nz);
}

void SectorStatistics::step(const transient::Record& record) {
  if (!(record.time >= from_))
    return;
  time_ += record.step;
  for (const int c : record.active) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    const int at = watched_[static_cast<std::size_t>(c)];
    if (at != none && state.wear_work > 0.0)
      work_[static_cast<std::size_t>(at)].add(angle(record, static_cast<std::size_t>(c)), state.wear_work);
  }
}

std::vector<std::vector<double>> SectorStatistics::rates() const {
  std::vector<std::vector<double>> out;
  for (const int at : watched_) {
    if (at == none) {
      out.emplace_back();
      continue;
    }
    const wear::SectorWork& work = work_[static_cast<std::size_t>(at)];
    out.push_back(time_ > 0.0 ? work.rates(time_) : std::vector<double>(work.size(), 0.0));
  }
  return out;
}

} // namespace fretwork::post
