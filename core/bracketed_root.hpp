// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A zero of a function between two places where its signs differ, by the secant rule of Illinois: order 1.44, and the bracket never leaves the zero.
/// Source: M. Dowell, P. Jarratt, BIT 11 (1971) 168.
#pragma once

namespace fretwork::core {

/// @param f  called last at what is returned, or nearer than round-off to it   @param at_low, at_high  f at both ends, of opposite signs
/// @param width  of the bracket, relative to its upper end, at which the search ends
template <class Function>
[[nodiscard]] double bracketed_root(const Function& f, double low, double high, double at_low, double at_high,
                                    double width) {
  constexpr int most_secants = 100;
  const bool rises = at_high > 0.0;
  double x = high;
  int side = 0;
  for (int i = 0; i < most_secants && high - low > width * high; ++i) {
    x = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(x > low && x < high))
      break; // round-off
    const double here = f(x);
    if (here == 0.0)
      break;
    const int now = (here > 0.0) == rises ? 1 : -1;
    if (now > 0) {
      high = x;
      at_high = here;
      at_low *= side > 0 ? 0.5 : 1.0;
    } else {
      low = x;
      at_low = here;
      at_high *= side < 0 ? 0.5 : 1.0;
    }
    side = now;
  }
  return x;
}

} // namespace fretwork::core
