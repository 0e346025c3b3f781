// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where a contact's node was, from the obstacle's centre in its local axes: its displacement from the place of rest, and that place.
///
/// A flat obstacle (planes, stops, bars) has one normal axis; along the other the node slides on its face. A radius means nothing there:
/// the position along the normal and the range of sliding are given apart.
#pragma once
#include "results/run_results.hpp"

namespace fretwork::results {

struct ContactPosition {
  post::Moments y, z; ///< m
};
[[nodiscard]] ContactPosition position_of(const ContactFacts& facts, const post::ContactSummary& summary);

/// Of a flat obstacle.
struct FlatPosition {
  post::Moments normal, sliding; ///< m, along the normal axis and across it
};
/// None for obstacles in or round which the node moves.
[[nodiscard]] std::optional<FlatPosition> flat_position_of(const ContactFacts& facts,
                                                           const post::ContactSummary& summary);

/// Clearances at rest between two faces, m: on the negative and the positive side, below 0 where a face overlaps.
struct Clearances {
  double negative, positive;
};
/// Of planes and bars on both sides; none of other obstacles, or where both are the gap to 0.1 % of it.
[[nodiscard]] std::optional<Clearances> unequal_clearances_of(const ContactFacts& facts);

} // namespace fretwork::results
