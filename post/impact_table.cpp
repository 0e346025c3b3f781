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
  const double start = record.time - 0.5 * record.step;
  const auto leave = [&](UnderWay& u, const transient::ContactState& state) {
    u.row.velocity_after = state.departure;
    u.end = start + state.opened_at * record.step;
  };
  for (const int c : record.opened) {
    const auto at = static_cast<std::size_t>(c);
    if (const transient::ContactState& state = record.states[at];
        state.touches == 0 || state.opened_at < state.closed_at)
      leave(under_way_[at], state);
  }
  for (const int c : record.active) {
    const auto at = static_cast<std::size_t>(c);
    const transient::ContactState& state = record.states[at];
    UnderWay& u = under_way_[at];
    if (state.touches > 0)
      close(at, start + state.closed_at * record.step, state.approach, record.time >= from_);
    u.row.peak = std::max(u.row.peak, state.peak);
    u.row.impulse += state.normal_force * record.step;
    u.row.energy_lost += state.damper_work + state.friction_work;
    u.end = start + record.step;
  }
  for (const int c : record.opened) {
    const auto at = static_cast<std::size_t>(c);
    if (const transient::ContactState& state = record.states[at];
        state.touches == 0 || state.opened_at >= state.closed_at)
      leave(under_way_[at], state);
  }
}

/// A contact closes: another rebound, or another impact.
void ImpactTable::close(std::size_t contact, double time, double speed, bool counted) {
  UnderWay& u = under_way_[contact];
  if (u.begun && time - u.end < rest_time_) {
    ++u.row.rebounds;
  } else {
    keep(contact);
    u.row = {};
    u.row.velocity_before = speed;
    u.begin = time;
    u.begun = true;
    u.counted = counted;
  }
  u.row.velocity_after = std::numeric_limits<double>::quiet_NaN();
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
