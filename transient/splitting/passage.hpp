// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How a contact passes an interval of a step: from open or closed to open or closed, and what happens between.
#pragma once

namespace fretwork::transient {

enum class Passage {
  stays_open,
  closes,
  closes_and_opens,
  stays_closed,
  opens,
  crosses, ///< from a face to the opposite one, without a gap that the interval resolves: it opens and closes
  crosses_and_opens,
  rolls_round, ///< the wall of a hole, and stays closed, with a force or without
};

/// What decides it.
struct PassageConditions {
  bool was_closed;  ///< at the start
  bool rolls_round; ///< contact::rolls_round
  bool crosses;     ///< its normal is that of the opposite face of the one that it was closed at
  bool has_force;   ///< a normal force, in the interval
  bool force_ends;  ///< within it
};

[[nodiscard]] constexpr Passage passage_of(const PassageConditions& c) {
  if (!c.was_closed) {
    if (!c.has_force)
      return Passage::stays_open;
    return c.force_ends ? Passage::closes_and_opens : Passage::closes;
  }
  if (c.rolls_round)
    return Passage::rolls_round;
  if (!c.has_force)
    return Passage::opens;
  if (c.crosses)
    return c.force_ends ? Passage::crosses_and_opens : Passage::crosses;
  return c.force_ends ? Passage::opens : Passage::stays_closed;
}

[[nodiscard]] constexpr bool crosses(Passage p) {
  return p == Passage::crosses || p == Passage::crosses_and_opens;
}
/// It touches: an impact begins.
[[nodiscard]] constexpr bool touches(Passage p) {
  return p == Passage::closes || p == Passage::closes_and_opens || crosses(p);
}
/// It departs, and is open at the end.
[[nodiscard]] constexpr bool departs(Passage p) {
  return p == Passage::opens || p == Passage::closes_and_opens || p == Passage::crosses_and_opens;
}
[[nodiscard]] constexpr bool ends_closed(Passage p) { return p != Passage::stays_open && !departs(p); }

} // namespace fretwork::transient
