// SPDX-License-Identifier: GPL-3.0-or-later
// Any number of contacts and modes gives what plain loops give.
#include "plain_schemes.hpp"
#include "scenes.hpp"
#include "transient/explicit/explicit_schemes.hpp"
#include "transient/splitting/splitting.hpp"
#include <gtest/gtest.h>

namespace padding_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using namespace fretwork::vibration;

namespace {

constexpr double explicit_tolerance = 1e-9; // round-off grown by some impacts
constexpr double sweep_tolerance =
    1e-6; // sums in another order may make a sweep more or less; impacts amplify

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

namespace {

/// The scene with modes that nothing moves and contacts far from their obstacles, which nothing couples to the others.
Scene padded_scene(const Scene& scene, int modes, int contacts) {
  Scene out = scene;
  const Eigen::Index n = scene.system.size(), all = n + modes;
  const auto extend = [&](Eigen::VectorXd& v, double value) {
    v.conservativeResize(all);
    v.tail(modes).setConstant(value);
  };
  extend(out.system.stiffness, 1e4);
  extend(out.system.damping, 0.0);
  extend(out.q0, 0.0);
  extend(out.v0, 0.0);
  for (Load& load : out.loads)
    extend(load.modal_force, 0.0);
  for (ContactPoint& point : out.contacts) {
    point.b.conservativeResize(3, all);
    point.b.rightCols(modes).setZero();
  }
  for (int c = 0; c < contacts; ++c) {
    ContactPoint far = out.contacts.front();
    far.b.setZero();
    far.support.obstacle = contact::Circle{1.0};
    far.rest.setZero();
    out.contacts.push_back(far);
  }
  return out;
}

} // namespace

TEST(Padding, OfSplittingIsNotSeen) {
  constexpr double h = 1e-4;
  constexpr int steps = 400;
  for (const Size& size : sizes) {
    const Scene scene = rattling(size.contacts, size.modes, h * steps), more = padded_scene(scene, 3, 6);
    const auto plain = make_splitting(scene, h, {.parts = 2}), padded = make_splitting(more, h, {.parts = 2});
    const PlainState a = last_state(*plain, scene, steps);
    PlainState b = last_state(*padded, more, steps);
    EXPECT_EQ(b.q.tail(3).norm(), 0.0);
    b.q.conservativeResize(a.q.size());
    expect_same(a, b, sweep_tolerance, size);
  }
}

} // namespace padding_test
