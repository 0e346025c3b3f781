// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/mode_direction.hpp"
#include "hand_made.hpp"
#include <gtest/gtest.h>

namespace fretwork::flow::mode_direction_test {
namespace {

using Kind = ModeDirection::Kind;
using tests::HandMade;

constexpr double round_off = 1e-9; ///< relative, of sums over stations

std::vector<ModeDirection> directions_of(const HandMade& hand, double length) {
  Zone zone = tests::liquid_zone("a", 0.0, length, 740, 1);
  zone.velocity = ScalarVelocity{tests::constant(1.0), Vec3::UnitY()};
  return mode_directions(sample(hand.tube(), Profile({zone}, length), hand.basis));
}

TEST(ModeDirection, OfAStraightTubeIsTheGlobalAxis) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 2.0, 5, {1.0, 2.0}, Vec3(0.6, 0.8, 0.0));
  for (const ModeDirection& one : directions_of(hand, 2.0)) {
    EXPECT_EQ(one.kind, Kind::y);
    EXPECT_NEAR(one.share, 0.64, round_off);
    EXPECT_EQ(short_text(one), "64% y");
  }
  EXPECT_STREQ(key_of(Kind::y), "y");
}

/// Two legs at a right angle in the plane of x and z, which rigid motions move: along y, along (3, 4, 0)/5, and along each leg alone.
TEST(ModeDirection, OfABentTubeIsInOrOutOfItsPlane) {
  HandMade hand;
  const Index property = hand.builder.property(tests::tube_property());
  hand.nodes = hand.builder.line(Vec3::Zero(), Vec3::UnitZ(), 4, property);
  const std::vector<Index> leg = hand.builder.line_from(hand.nodes.back(), Vec3(1, 0, 1), 4, property);
  hand.nodes.insert(hand.nodes.end(), leg.begin(), leg.end());
  hand.set_frequencies({1.0, 2.0, 3.0, 4.0});
  for (const Index node : hand.nodes) {
    hand.set_shape(0, node, Vec3::UnitY(), Vec3::Zero());
    hand.set_shape(1, node, {0.6, 0.8, 0}, Vec3::Zero());
    hand.set_shape(2, node, {1, 0, 1}, Vec3::Zero());
  }
  const std::vector<ModeDirection> found = directions_of(hand, 2.0);
  EXPECT_EQ(found[0].kind, Kind::out_of_plane);
  EXPECT_NEAR(found[0].share, 1.0, round_off);
  EXPECT_EQ(short_text(found[0]), "out of plane");
  EXPECT_EQ(found[1].kind, Kind::out_of_plane);
  const double across = 0.5 * 0.36; // of one leg the part along x is along it
  EXPECT_NEAR(found[1].share, 0.64 / (0.64 + across), round_off);
  EXPECT_EQ(short_text(found[1]), "78% out");
  EXPECT_EQ(found[2].kind, Kind::in_plane);
  EXPECT_EQ(short_text(found[2]), "in plane");
  EXPECT_EQ(found[3].kind, Kind::none); // no motion
  EXPECT_EQ(short_text(found[3]), "-");
  EXPECT_EQ(key_of(Kind::none), nullptr);
}

} // namespace
} // namespace fretwork::flow::mode_direction_test
