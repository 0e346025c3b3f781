// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/packed_contacts.hpp"
#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace fretwork::transient {
namespace {

/// Local component (x y z of a ContactPoint's b) stored in block y, z, x.
constexpr std::array<int, 3> stored = {1, 2, 0};
/// Values of a row that take the time in which a row by itself begins and ends.
constexpr std::size_t cost_of_row = 24;

} // namespace

PackedContacts::PackedContacts(const std::vector<ContactPoint>& contacts, Eigen::Index mode_count, bool full)
    : count(static_cast<int>(contacts.size())), width(kernels::padded(static_cast<int>(contacts.size()))),
      modes(static_cast<int>(mode_count)), padded_modes(kernels::padded(static_cast<int>(mode_count))) {
  for (const ContactPoint& c : contacts) {
    const contact::FrictionLaw& law = c.support.friction;
    const bool moves = !c.b.row(0).isZero(0.0) || (c.imposed.size() > 0 && !c.imposed.row(0).isZero(0.0));
    in_plane.push_back(law.active() && law.along.x != 0.0 && moves);
  }
  components = std::any_of(in_plane.begin(), in_plane.end(), [](char x) { return x; }) ? 3 : 2;
  reach = ReachLanes(width);
  for (int c = 0; c < width; ++c)
    reach[c].limit[kernels::lane(c)] =
        std::numeric_limits<double>::infinity(); // a lane of padding is never near

  for (int c = 0; c < count; ++c) {
    const ContactPoint& point = contacts[static_cast<std::size_t>(c)];
    supports.push_back(point.support);
    const contact::ObstacleProperties obstacle = contact::properties_of(point.support.obstacle);
    const contact::GapBound& bound = obstacle.gap_bound;
    ReachNumbers& r = reach[c];
    const int l = kernels::lane(c);
    r.rest_y[l] = point.rest.y();
    r.rest_z[l] = point.rest.z();
    r.wy[l] = bound.wy;
    r.wz[l] = bound.wz;
    r.radial[l] = bound.radial;
    r.ly[l] = bound.ly;
    r.lz[l] = bound.lz;
    r.limit[l] = bound.limit;
    if (!obstacle.is_bound_gap)
      located.push_back(c);
    has_parts.push_back(obstacle.has_parts);
    add_rows(point);
  }
  gather.half = lane_count().half();
  apart_ = lane_count().few() || (full && lane_count().half());
  for (int lane = 0; lane < stride(); lane += kernels::lanes)
    add_pack(lane);
}

/// The rows of the next contact, over whole packs of modes.
void PackedContacts::add_rows(const ContactPoint& point) {
  std::vector<Span>& own = spans.emplace_back();
  if (point.modes.empty() || lane_count().few())
    own.push_back({0, padded_modes});
  else
    for (const vibration::ModeRange& range : point.modes) {
      const int first = static_cast<int>(range.first) / kernels::lanes * kernels::lanes,
                end = kernels::padded(static_cast<int>(range.first + range.size));
      if (!own.empty() && own.back().first + own.back().size >= first)
        own.back().size = end - own.back().first; // they share a pack, or follow each other
      else if (range.size > 0)
        own.push_back({first, end - first});
    }
  layout.push_back(spans.size() == 1 ? 0 : layout.back() + (own != spans[spans.size() - 2] ? 1 : 0));
  std::size_t size = 0;
  for (const Span& span : own)
    size += static_cast<std::size_t>(span.size);
  row_begin_.push_back(rows_.size());
  row_size_.push_back(size);
  const std::size_t begin = rows_.size();
  rows_.resize(begin + 3 * size, 0.0);
  point.for_ranges([&](Eigen::Index first, const auto& part) {
    for (Eigen::Index i = 0; i < part.cols(); ++i) {
      const auto mode = static_cast<int>(first + i);
      std::size_t before = 0;
      for (const Span& span : own) {
        if (mode >= span.first && mode < span.first + span.size) {
          const std::size_t at = begin + before + static_cast<std::size_t>(mode - span.first);
          for (int k = 0; k < components; ++k)
            rows_[at + static_cast<std::size_t>(k) * size] = part(stored[static_cast<std::size_t>(k)], i);
        }
        before += static_cast<std::size_t>(span.size);
      }
    }
  });
}

/// The contacts whose lanes begin here: together over all modes that one of them moves, or each by itself where that is less.
void PackedContacts::add_pack(int lane) {
  const int component = lane / width, from = lane % width, end = std::min(from + kernels::lanes, count);
  std::vector<Span> all;
  std::size_t apart = 0;
  for (int c = from; c < end; ++c) {
    all.insert(all.end(), spans[static_cast<std::size_t>(c)].begin(),
               spans[static_cast<std::size_t>(c)].end());
    apart += row_size_[static_cast<std::size_t>(c)] + cost_of_row;
  }
  const bool same = std::all_of(all.begin(), all.end(), [&](const Span& s) { return s == all.front(); });
  std::map<int, std::array<double, kernels::lanes>> by_mode; // those that some contact moves
  for (int c = from; c < end; ++c) {
    const double* value = row(c, component);
    for (const Span& span : spans[static_cast<std::size_t>(c)])
      for (int i = 0; i < span.size; ++i, ++value)
        if (*value != 0.0)
          by_mode[span.first + i][static_cast<std::size_t>(c - from)] = *value;
  }
  if (!apart_ && (same || by_mode.size() * kernels::lanes <= apart)) {
    gather.add_pack(by_mode);
    return;
  }
  gather.add_pack({});
  for (int c = from; c < end; ++c) {
    const double* value = row(c, component);
    for (const Span& span : spans[static_cast<std::size_t>(c)]) {
      gather.parts.push_back({lane + c - from, span.first, span.size, gather.of_parts.size()});
      gather.of_parts.insert(gather.of_parts.end(), value, value + span.size);
      value += span.size;
    }
  }
}

} // namespace fretwork::transient
