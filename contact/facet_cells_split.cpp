// SPDX-License-Identifier: GPL-3.0-or-later
/// How FacetCells::Builder divides a cell and the list of what it needs.
#include "contact/facet_cells_builder.hpp"
#include <iterator>

namespace fretwork::contact {
namespace {

constexpr std::size_t too_long = 32; // pairs of a list to be looked at closely, at most: others wait for cuts

} // namespace

/// The corners of r have been looked at.
FacetCells::Builder::Split FacetCells::Builder::split(const Line& line, double at, const Region& r,
                                                      const List& list) {
  std::array<Some<std::size_t>, 2> corners;
  const std::size_t number = r.corners.number;
  for (std::size_t k = 0; k < number; ++k) {
    const PlanePoint a = r.corners.of[k], b = r.corners.of[k + 1 == number ? 0 : k + 1];
    const double value = line(a) - at, next = line(b) - at;
    corners[value >= 0.0].add(k);
    if ((value >= 0.0) != (next >= 0.0)) {
      const double share = value / (value - next);
      const std::size_t cut = look({a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)}, list);
      corners[0].add(cut);
      corners[1].add(cut);
    }
  }
  Split s;
  for (std::size_t k = 0; k < 2; ++k) {
    Region& part = s.parts[k];
    part = r;
    part.corners.number = 0;
    for (const std::size_t i : corners[k].all())
      part.corners.add(places_[i].at);
    ++part.depth;
    s.lists[k] = corners[k].number > 0 ? needed_in(corners[k], list) : list;
  }
  for (Region& part : s.parts)
    part.growth *=
        static_cast<double>(s.lists[0].size() + s.lists[1].size()) / static_cast<double>(list.size());
  return s;
}

/// What the parts of a cell need, together, parts of parts and so on. It is less than what the cell was found to need:
/// in a part a single thing may be nearer all over where in the cell it takes several.
FacetCells::Builder::List FacetCells::Builder::looked_at_closely(const List& list, const Region& r,
                                                                 int times) {
  if (times == 0 || list.size() <= short_list || list.size() > too_long || r.corners.number < 3 ||
      r.corners.number > most_corners - 4)
    return list;
  PlanePoint longest{0.0, 0.0};
  for (const PlanePoint& p : r.corners.all())
    for (const PlanePoint& q : r.corners.all())
      if (squared(p.y - q.y, p.z - q.z) > squared(longest.y, longest.z))
        longest = {p.y - q.y, p.z - q.z};
  const Line line{static_cast<float>(longest.y), static_cast<float>(longest.z), 0.0f};
  look_at_corners(r, list);
  const Split s = split(line, line(r.middle()), r, list);
  const auto together = [](const List& a, const List& b) {
    List both;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
  };
  List both = together(s.lists[0], s.lists[1]);
  if (both.size() == list.size()) // as among the facets of a smooth wall
    return both;
  return together(looked_at_closely(s.lists[0], s.parts[0], times - 1),
                  looked_at_closely(s.lists[1], s.parts[1], times - 1));
}

/// A cell of the grid, across t or across m, whichever leaves less.
FacetCells::Builder::Split FacetCells::Builder::halve(const List& list, const Region& r, Bits most) {
  const List some = sample(list, sampled);
  look_at_corners(r, some);
  const float y = r.quadrant & 1u ? -1.0f : 1.0f, z = r.quadrant & 2u ? -1.0f : 1.0f;
  const auto t = static_cast<float>(r.middle_of(0)),
             m = static_cast<float>(r.middle_of(1)); // exact: few bits
  const std::array<Line, 2> lines{{{-y * t, z * (1.0f - t), 0.0f}, {y, z, m}}};
  std::size_t across = r.bits[0] < most[0] ? 0 : 1;
  if (across == 0 && r.bits[1] < most[1])
    across = split(lines[1], 0.0, r, some).cost() < split(lines[0], 0.0, r, some).cost() ? 1 : 0;
  look_at_corners(r, list);
  Split best = split(lines[across], 0.0, r, list);
  for (std::uint32_t k = 0; k < 2; ++k) {
    Region& part = best.parts[k];
    ++part.bits[across];
    part.low[across] += std::uint64_t{k} << (word - part.bits[across]);
  }
  return best;
}

} // namespace fretwork::contact
