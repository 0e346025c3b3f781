// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/impact_table.hpp"
#include <algorithm>

namespace fretwork::post {

ImpactTable::ImpactTable(std::size_t contacts, double from, double rest_time, std::size_t most)
    : from_(from), rest_time_(rest_time), most_(most), under_way_(contacts), out_(contacts) {
  for (ContactImpacts& contact : out_)
    contact.rows.reserve(most);
}

void ImpactTable::step(const transient::Record& record) {
  const std::int64_t now = number_++;
  for (const int c : record.opened) {
    const auto at = static_cast<std::size_t>(c);
    under_way_[at].row.velocity_after = -record.states[at].approach;
  }
  const double begin = record.time - 0.5 * record.step;
  for (const int c : record.active) {
    const auto at = static_cast<std::size_t>(c);
    const transient::ContactState& state = record.states[at];
    UnderWay& u = under_way_[at];
    if (u.last_closed != now - 1) { // it was open
      if (u.last_closed >= 0 && begin - u.end < rest_time_) {
        ++u.row.rebounds;
      } else {
        keep(at);
        u.row = {};
        u.row.velocity_before = state.approach;
        u.begin = begin;
        u.counted = record.time >= from_;
      }
      u.row.velocity_after = std::numeric_limits<double>::quiet_NaN();
    }
    u.last_closed = now;
    u.end = begin + record.step;
    u.row.peak = std::max(u.row.peak, state.normal_force);
    u.row.impulse += state.normal_force * record.step;
    u.row.energy_lost += state.damper_work + state.friction_work;
  }
}

std::vector<ContactImpacts> ImpactTable::impacts() && {
  for (std::size_t c = 0; c < under_way_.size(); ++c)
    keep(c);
  return std::move(out_);
}

/// The impact of a contact is over: it becomes a row, if it is one of the window.
void ImpactTable::keep(std::size_t contact) {
  UnderWay& u = under_way_[contact];
  if (!u.counted)
    return;
  u.counted = false;
  if (out_[contact].rows.size() == most_) {
    ++out_[contact].left_out;
    return;
  }
  u.row.start = u.begin;
  u.row.duration = u.end - u.begin;
  out_[contact].rows.push_back(u.row);
}

} // namespace fretwork::post
