// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/packed_contacts.hpp"
#include <algorithm>
#include <array>
#include <limits>

namespace fretwork::transient {
namespace {

/// Local component (x y z of a ContactPoint's b) stored in block y, z, x.
constexpr std::array<int, 3> stored = {1, 2, 0};

} // namespace

PackedContacts::PackedContacts(const std::vector<ContactPoint>& contacts, Eigen::Index mode_count)
    : count(static_cast<int>(contacts.size())), width(kernels::padded(static_cast<int>(contacts.size()))),
      modes(static_cast<int>(mode_count)), padded_modes(kernels::padded(static_cast<int>(mode_count))) {
  for (const ContactPoint& c : contacts) {
    const contact::FrictionLaw& law = c.support.friction;
    const bool moves = !c.b.row(0).isZero(0.0) || (c.carried.size() > 0 && !c.carried.row(0).isZero(0.0));
    in_plane.push_back(law.active() && law.along.x != 0.0 && moves);
  }
  components = std::any_of(in_plane.begin(), in_plane.end(), [](char x) { return x; }) ? 3 : 2;
  reach = kernels::ReachLanes(width);
  kernels::Array by_mode(static_cast<std::size_t>(modes) * stride(), 0.0);
  rows.assign(static_cast<std::size_t>(count) * 3 * padded_modes, 0.0);
  mobility.assign(static_cast<std::size_t>(count) * 3 * stride(), 0.0);
  for (int c = 0; c < width; ++c)
    reach[c].limit[kernels::lane(c)] =
        std::numeric_limits<double>::infinity(); // a lane of padding is never near

  for (int c = 0; c < count; ++c) {
    const ContactPoint& point = contacts[static_cast<std::size_t>(c)];
    supports.push_back(point.support);
    const contact::ObstacleProperties obstacle = contact::properties_of(point.support.obstacle);
    const contact::GapBound& bound = obstacle.gap_bound;
    kernels::ReachNumbers& r = reach[c];
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
    for (int k = 0; k < components; ++k)
      for (int i = 0; i < modes; ++i) {
        by_mode[static_cast<std::size_t>(i) * stride() + k * width + c] = point.b(stored[k], i);
        rows[(static_cast<std::size_t>(c) * 3 + k) * padded_modes + i] = point.b(stored[k], i);
      }
    for (int from = 0; from < components; ++from)
      for (int other = 0; other < count; ++other)
        for (int to = 0; to < components; ++to)
          mobility[(static_cast<std::size_t>(c) * 3 + from) * stride() + to * width + other] =
              contacts[static_cast<std::size_t>(other)].b.row(stored[to]).dot(point.b.row(stored[from]));
  }
  gather.half = lane_count().half();
  gather.rows = lane_count().few() ? count : 0;
  for (int lane = 0; lane < stride(); lane += kernels::lanes)
    gather.add_pack(modes, stride(), by_mode.data() + lane);
}

} // namespace fretwork::transient
