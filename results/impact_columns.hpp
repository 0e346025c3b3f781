// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The columns of a table of impacts, as files have them. `rebounds`, a count, follows them.
#pragma once
#include "post/impact_table.hpp"

namespace fretwork::results {

struct ImpactColumn {
  const char* name;
  const char* units;
  double post::Impact::*value;
};

inline constexpr ImpactColumn impact_columns[] = {
    {"start", "s", &post::Impact::start},
    {"duration", "s", &post::Impact::duration},
    {"peak_force", "N", &post::Impact::peak},
    {"impulse", "N s", &post::Impact::impulse},
    {"velocity_before", "m/s", &post::Impact::velocity_before},
    {"velocity_after", "m/s", &post::Impact::velocity_after},
    {"energy_lost", "J", &post::Impact::energy_lost},
};

} // namespace fretwork::results
