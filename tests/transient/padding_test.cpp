// SPDX-License-Identifier: GPL-3.0-or-later
// Any number of contacts and modes gives what plain loops give.
#include "plain_schemes.hpp"
#include "scenes.hpp"
#include <gtest/gtest.h>

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

constexpr double explicit_tolerance = 1e-9; // round-off grown by some impacts
constexpr double sweep_tolerance = 2e-4;    // the sweeps stop at 1e-6 of the forces; impacts amplify

struct Size {
  int contacts, modes;
};
const Size sizes[] = {{1, 1}, {1, 8}, {1, 9}, {7, 8}, {8, 8}, {9, 9}, {17, 9}, {17, 1}, {33, 9}};

/// State of a scheme after the last action: at the last record.
PlainState last_state(Scheme& scheme, const Scene& scene, int steps) {
  PlainState s{Eigen::VectorXd(scene.system.size()), Eigen::VectorXd(scene.system.size())};
  const Record* record = nullptr;
  for (int k = 0; k < steps; ++k) {
    record = &scheme.advance();
    for (const int c : record->active) {
      ++s.closed;
      s.slid += record->states[static_cast<std::size_t>(c)].slides;
      s.friction_work += record->states[static_cast<std::size_t>(c)].friction_work;
    }
  }
  scheme.state_at(record->time, s.q.data(), s.v.data());
  return s;
}

void expect_same(const PlainState& a, const PlainState& b, double tolerance, const Size& size) {
  EXPECT_LT((a.q - b.q).norm(), tolerance * b.q.norm())
      << size.contacts << " contacts, " << size.modes << " modes";
  EXPECT_NEAR(a.friction_work, b.friction_work, tolerance * b.friction_work);
  EXPECT_EQ(a.closed, b.closed);
  EXPECT_GT(b.closed, 0);
}

} // namespace

TEST(Padding, OfEulerIsNotSeen) {
  constexpr double h = 2e-5;
  constexpr int steps = 2000;
  for (const Size& size : sizes) {
    const Scene scene = rattling(size.contacts, size.modes, h * steps);
    const auto scheme = make_euler(scene, h);
    const PlainState a = last_state(*scheme, scene, steps + 1);
    PlainState b = plain_euler(scene, h, steps + 1);
    const PlainState before =
        plain_euler(scene, h, steps); // a record shows the state from which its step starts
    b.q = before.q;
    expect_same(a, b, explicit_tolerance, size);
    EXPECT_LT((a.v - before.v).norm(), explicit_tolerance * before.v.norm());
  }
}

TEST(Padding, OfSplittingIsNotSeen) {
  constexpr double h = 1e-4;
  constexpr int steps = 400;
  for (const Size& size : sizes) {
    const Scene scene = rattling(size.contacts, size.modes, h * steps);
    const auto scheme = make_splitting(scene, h);
    const PlainState a = last_state(*scheme, scene, steps), b = plain_splitting(scene, h, steps);
    expect_same(a, b, sweep_tolerance, size);
  }
}

TEST(Padding, OfSplittingWithoutCoupledForcesIsNotSeenToRoundOff) {
  constexpr double h = 1e-4;
  constexpr int steps = 400;
  for (const Size& size : sizes) {
    Scene scene = rattling(size.contacts, size.modes, h * steps);
    for (ContactPoint& c : scene.contacts) {
      c.support.friction = {};
      c.support.normal.damping = 0.0;
    }
    const auto scheme = make_splitting(scene, h);
    const PlainState a = last_state(*scheme, scene, steps), b = plain_splitting(scene, h, steps);
    expect_same(a, b, explicit_tolerance, size);
  }
}

TEST(Padding, IsNotSeenWithHuntAndCrossleysDamperAndFrictionAlongOneDirection) {
  constexpr int steps = 400;
  for (const Size& size : sizes)
    for (const contact::Vec2 along : {contact::Vec2{1.0, 0.0}, contact::Vec2{0.0, 1.0}}) {
      Scene scene = rattling(size.contacts, size.modes, 1e-4 * steps);
      for (ContactPoint& c : scene.contacts) {
        c.support.normal.dissipation = 1.0;
        c.support.friction.along = along;
      }
      const auto scheme = make_splitting(scene, 1e-4);
      const PlainState a = last_state(*scheme, scene, steps), b = plain_splitting(scene, 1e-4, steps);
      expect_same(a, b, sweep_tolerance, size);
    }
}

TEST(PlanePair, TakesTheOppositeFaceForAnotherSurface) {
  // a stiff tangential damper: what one face has loaded would still be there at the other
  constexpr double h = 1e-5;
  constexpr int steps = 1000;
  Scene scene = mass_point(1.0, Vec3::Zero(), h * steps);
  start(scene, 1.0, Vec3::Zero(), Vec3(0.02, 0.2, 0.01));
  scene.contacts = {
      contact_of(1.0, {contact::PlanePair{1e-5, contact::PlaneAxis::y}, {1e6}, {1e5, 1e3, 5.0, 5.0}})};
  const auto scheme = make_splitting(scene, h);
  const PlainState a = last_state(*scheme, scene, steps), b = plain_splitting(scene, h, steps);
  expect_same(a, b, sweep_tolerance, {1, 3});
  EXPECT_GT(b.closed, steps / 4);
}
