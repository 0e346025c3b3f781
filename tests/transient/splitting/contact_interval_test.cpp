// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_interval.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace contact_interval_test {

using namespace fretwork;
using namespace fretwork::transient;

namespace {

constexpr double step = 1e-4; // s

/// Of a free mass.
ImpulseResponse isotropic(double w) {
  ImpulseResponse out;
  for (int i = 0; i < 3; ++i)
    out.w.add(i, i, w);
  return out;
}

/// A contact through a step.
MovingContact through(const contact::Support& support, const ImpulseResponse& response, double h, int count,
                      const FreePath& path, const ContactPast& past, const Components& held = {}) {
  const ContactIntervals intervals(support, {}, response, false, h, 1e-3, {});
  const IntervalTable table = intervals.table(count);
  MovingContact m;
  m.path = path;
  m.course.past = past;
  intervals.begin(m, held, table);
  for (int index = 0; index < count; ++index) {
    intervals.find_force(m, table, index);
    intervals.move(m, table);
    ContactIntervals::extrapolate(m, table);
  }
  return m;
}

ContactPast closed(contact::ContactAxes axes) {
  ContactPast past;
  past.closed = true;
  past.axes = axes;
  return past;
}

} // namespace

// Displacement and velocity at the end of an interval follow from its mean acceleration and jerk, exactly; the last part of the path has its mean.
TEST(FreePath, HasTheAccelerationsOfItsIntervals) {
  constexpr double h = 2e-3;
  const FreePath path{{1.0, 0.0, 0.0},  {-300.0, 0.0, 0.0}, {2e5, 0.0, 0.0},
                      {-1e8, 0.0, 0.0}, {7e5, 0.0, 0.0},    1.0 / h};
  for (const int count : {1, 3}) {
    const double dt = h / count;
    for (int index = 0; index < count; ++index) {
      const double start = index * dt, middle = start + 0.5 * dt;
      const double a = path.acceleration(middle, 1.0 / count).y(), j = path.jerk(middle).y();
      const double u = path.displacement(start).y(), v = path.velocity(start).y();
      EXPECT_NEAR(path.velocity(start + dt).y(), v + dt * a, 1e-9);
      EXPECT_NEAR(path.displacement(start + dt).y(), u + dt * v + dt * dt * (0.5 * a - dt / 12.0 * j), 1e-12);
    }
  }
  double mean = 0.0;
  for (int k = 0; k < 1000; ++k)
    mean += FreePath{{}, {}, {}, {}, {7e5, 0.0, 0.0}, 1.0 / h}.displacement((k + 0.5) * h / 1000).y() / 1000;
  EXPECT_NEAR(mean, 7e5 * h * h / 60.0, 1e-6);
}

// r_t h = 12, in parts of 4 where it sticks beside modes as fast as the step along a direction.
TEST(ContactIntervals, AreShorterWhereAContactSticksBesideAFastStructure) {
  const contact::Support support{contact::Stop{0.0, contact::PlaneAxis::y}, {1e6}, {1e5, 1e3, 0.3, 0.3}};
  ImpulseResponse response = isotropic(1.0);
  response.w.add(1, 1, 9.0); // a direction of more mobility that is slow does not hide it
  response.v.add(0, 0, 1.01 / (step * step));
  const DamperRates rates{0.0, 12.0 / step};
  const auto count = [&](const contact::Support& of, const ImpulseResponse& own, bool sliding,
                         bool pressed = true) {
    ContactPast past = closed({-1.0, 0.0});
    past.closed = pressed;
    past.friction.sliding = sliding;
    return ContactIntervals(of, {}, own, true, step, 1e-3, rates).least_count(2, past, {});
  };
  EXPECT_EQ(count(support, response, false), 3);
  EXPECT_EQ(count(support, response, true), 2);
  EXPECT_EQ(count(support, response, false, false), 2);
  EXPECT_EQ(count({support.obstacle, support.normal, {}}, response, false), 2);
  response.v = {};
  response.v.add(0, 0, 0.99 / (step * step));
  EXPECT_EQ(count(support, response, false), 2);
}

TEST(ContactIntervals, LeaveWhatRestsAtRest) {
  constexpr double stiffness = 1e6, penetration = 1e-5, w = 20.0; // w_c h = 0.45
  const contact::Support support{contact::Circle{1e-3}, {stiffness}, {}};
  const Components held{0.0, -stiffness * penetration, 0.0};
  const MovingContact m = through(support, isotropic(w), step, 2,
                                  {{0.0, 1e-3 + penetration, 0.0}, {}, {}, {}}, closed({0.0, -1.0}), held);
  EXPECT_NEAR(m.course.force.mean.z() / held.z(), 1.0, 1e-12);
  EXPECT_NEAR(m.course.force.slope.z() / held.z(), 0.0, 1e-12);
  EXPECT_NEAR(m.response.z(), 0.0, 1e-12 * penetration);
  EXPECT_TRUE(m.course.past.closed);
  EXPECT_EQ(m.course.state.touches, 0);
}

// The force over the step is the one of its intervals, by Legendre's polynomials.
TEST(ContactIntervals, GiveTheMomentsOfTheirForces) {
  constexpr double stiffness = 1e6, w = 20.0, h = step;
  constexpr int count = 4, points = 4000;
  const contact::Support support{contact::Stop{0.0, contact::PlaneAxis::y}, {stiffness, 100.0}, {}};
  const ContactIntervals intervals(support, {}, isotropic(w), false, h, 1.0, {});
  const IntervalTable table = intervals.table(count);
  MovingContact m;
  m.path = {{1e-3, 0.0, 0.0}, {0.3, 0.0, 0.0}, {-400.0, 0.0, 0.0}, {}};
  m.course.past = closed({-1.0, 0.0});
  intervals.begin(m, {}, table);
  std::array<double, 4> exact{};
  for (int i = 0; i < count; ++i) {
    intervals.find_force(m, table, i);
    for (int k = 0; k < points; ++k) {
      const double part = (k + 0.5) / points, x = 2.0 * (i + part) / count - 1.0,
                   force = m.force.y() + (part - 0.5) * m.growth.y();
      const double legendre[] = {1.0, x, 0.5 * (3.0 * x * x - 1.0), 0.5 * (5.0 * x * x * x - 3.0 * x)};
      for (std::size_t d = 0; d < exact.size(); ++d)
        exact[d] += (static_cast<double>(d) + 0.5) * force * legendre[d] * 2.0 / (count * points);
    }
    intervals.move(m, table);
    ContactIntervals::extrapolate(m, table);
  }
  const StepForce& found = m.course.force;
  const double of[] = {found.mean.y(), found.slope.y(), found.bends[0].y(), found.bends[1].y()};
  for (std::size_t d = 0; d < exact.size(); ++d) {
    EXPECT_GT(std::abs(exact[d]), 5e-4 * std::abs(exact[0])) << d;
    EXPECT_NEAR(of[d], exact[d], 1e-5 * std::abs(exact[0])) << d;
  }
}

// A mass on a stop follows its sine: impulse, times of touch and departure of an impact inside one step.
TEST(ContactIntervals, HoldWholeImpactsOfAFreeMass) {
  constexpr double stiffness = 1e6, w = 1.0, speed = 0.1, rate = 1e3; // K W = rate^2
  constexpr double h = 5e-3, gap = 1e-5;
  const double before = gap / speed, lasts = std::numbers::pi / rate;
  const contact::Support support{contact::Stop{gap, contact::PlaneAxis::y}, {stiffness}, {}};
  double worst = 0.0;
  for (const auto& [count, tolerance] :
       {std::pair(8, 2.5e-3), std::pair(10, 1e-3), std::pair(20, 1e-4)}) { // w_c dt = 0.625, 0.5, 0.25
    const MovingContact m = through(support, isotropic(w), h, count, {{}, {speed, 0.0, 0.0}, {}, {}}, {});
    const double error = std::abs(m.course.force.mean.y() * h * w / (-2.0 * speed) - 1.0);
    EXPECT_LT(error, tolerance);
    EXPECT_EQ(m.course.state.touches, 1);
    EXPECT_TRUE(m.course.opened);
    EXPECT_NEAR(m.course.state.closed_at * h, before, 1e-9 * h);
    EXPECT_NEAR((m.course.state.opened_at - m.course.state.closed_at) * h / lasts, 1.0, tolerance);
    EXPECT_NEAR(m.course.state.approach / speed, 1.0, 1e-12);
    EXPECT_NEAR(m.course.state.departure / speed, 1.0, 1e-3);
    EXPECT_NEAR(m.course.state.peak / (speed * stiffness / rate), 1.0, 2e-3);
    EXPECT_NEAR(m.rate.y() / (-2.0 * speed), 1.0, 1e-3);
    worst = std::max(worst, error);
  }
  EXPECT_GT(worst, 1e-12);
}

// Impacts inside one step with a damper C_N, K_N p + C_N p', and with dissipation d, K_N p (1 + d p'): how fast the mass leaves, what is lost.
TEST(ContactIntervals, LoseInAnImpactWhatItsDamperTakes) {
  constexpr double stiffness = 1e6, w = 1.0, speed = 0.1, rate = 1e3, h = 5e-3, gap = 1e-5; // K W = rate^2
  constexpr double ratio = 0.1, dissipation = 3.0; // C_N W/(2 rate), s/m
  const double decay = std::sqrt(1.0 - ratio * ratio);
  // the force ends where K_N p + C_N p' = 0
  const double lasts =
      (std::numbers::pi - std::atan2(2.0 * ratio * decay, 1.0 - 2.0 * ratio * ratio)) / (decay * rate);
  const double left = std::exp(-ratio * rate * lasts); // of the speed
  // v dv/dp = -rate^2 p (1 + d v): v/d - ln(1 + d v)/d^2 is as large at both ends
  const auto height = [](double v) {
    return v / dissipation - std::log1p(dissipation * v) / (dissipation * dissipation);
  };
  double low = 0.0, high = speed;
  for (int i = 0; i < 60; ++i)
    (height(-0.5 * (low + high)) < height(speed) ? low : high) = 0.5 * (low + high);
  struct Case {
    contact::NormalLaw law;
    double leaves; // of the speed
  };
  for (const auto& [law, leaves] :
       {Case{{stiffness, 2.0 * ratio * rate / w}, left}, Case{{stiffness, 0.0, dissipation}, low / speed}}) {
    const contact::Support support{contact::Stop{gap, contact::PlaneAxis::y}, law, {}};
    for (const int count : {8, 16}) { // w_c dt = 0.625, 0.31
      const MovingContact m = through(support, isotropic(w), h, count, {{}, {speed, 0.0, 0.0}, {}, {}}, {});
      const double tolerance = count == 8 ? 2e-3 : 4e-4,
                   lost = 0.5 * speed * speed * (1.0 - leaves * leaves) / w;
      EXPECT_EQ(m.course.state.touches, 1);
      EXPECT_TRUE(m.course.opened);
      EXPECT_NEAR(m.rate.y() / speed, -1.0 - leaves, tolerance);
      EXPECT_NEAR(m.course.state.departure / speed, leaves, tolerance);
      EXPECT_NEAR(m.course.state.damper_work / lost, 1.0, 5.0 * tolerance);
      if (law.damping > 0.0) {
        EXPECT_NEAR((m.course.state.opened_at - m.course.state.closed_at) * h / lasts, 1.0, tolerance);
      }
    }
  }
}

// A contact that leaves a damped obstacle while the forces of spring and damper, which would pull, stay balanced for good: the time until its force
// returns is below what the time of the step can resolve. The step ends nevertheless, with no force that pulls.
TEST(ContactIntervals, EndWhereTheForceIsAlwaysAboutToReturn) {
  constexpr double h = 2e-5, stiffness = 1e8, damping = 1700.0, out = 8e-3, penetration = 1e-7;
  const contact::Support support{contact::Stop{0.0, contact::PlaneAxis::y}, {stiffness, damping}, {}};
  const double pressing = stiffness * out / damping * (1.0 - 1e-14); // K_N p' = C_N p'' but for round-off
  const double falling = stiffness * pressing / damping;             // and so it stays
  const FreePath path{{penetration, 0.0, 0.0}, {-out, 0.0, 0.0}, {pressing, 0.0, 0.0}, {-falling, 0.0, 0.0}};
  const MovingContact m = through(support, isotropic(12.0), h, 6, path, {});
  EXPECT_GE(m.course.state.normal_force, 0.0);
  EXPECT_TRUE(std::isfinite(m.response.y()));
}

// A mass that is held in a hole by its centrifugal force runs round it: the normal turns by 0.3 rad an interval. Its contact neither opens nor loses its force.
TEST(ContactIntervals, FollowTheWallOfAHole) {
  constexpr double gap = 1e-3, w = 1.0, rate = 1e3, stiffness = 1e6, turning = 300.0, h = 2e-2; // rad/s
  // K_N p = (gap + p) turning^2/W
  const double penetration = gap * turning * turning / (rate * rate - turning * turning),
               radius = gap + penetration;
  const contact::Support support{contact::Circle{gap}, {stiffness}, {}};
  const double force = stiffness * penetration;
  for (const int count : {20, 40}) {
    const ContactIntervals intervals(support, {}, isotropic(w), false, h, gap, {});
    const IntervalTable table = intervals.table(count);
    MovingContact m;
    m.path = {{radius, 0.0, 0.0}, {0.0, radius * turning, 0.0}, {}, {}};
    m.course.past = closed({-1.0, 0.0});
    m.path.a = {-w * force, 0.0, 0.0}; // of the force held
    intervals.begin(m, {-force, 0.0, 0.0}, table);
    for (int index = 0; index < count; ++index) {
      intervals.find_force(m, table, index);
      intervals.move(m, table);
      ContactIntervals::extrapolate(m, table);
      EXPECT_TRUE(m.course.past.closed) << index;
    }
    const double share = count == 20 ? 0.025 : 0.006; // of order 2
    EXPECT_EQ(m.course.state.touches, 0);
    EXPECT_NEAR(m.course.state.normal_force / force, 1.0, share);
    EXPECT_NEAR(std::sqrt(m.course.state.normal_square) / force, 1.0, share);
    const Components u = m.path.displacement(h) + m.response;
    EXPECT_NEAR(std::hypot(u.y(), u.z()) / radius, 1.0, share);
  }
}

// What find_force adds to is the course alone: put back, it gives the same force again, whatever was found in between.
TEST(ContactIntervals, FindTheSameForceAgainFromTheSameCourse) {
  constexpr double h = 1e-3, gap = 1e-4;
  const contact::Support support{contact::Circle{gap}, {1e6, 50.0}, {1e6, 20.0, 0.3, 0.3}};
  const ContactIntervals intervals(support, {}, isotropic(1.0), true, h, gap, {});
  const IntervalTable table = intervals.table(2);
  for (const bool was_closed : {false, true}) {
    MovingContact m;
    m.path = {{was_closed ? 1.02 * gap : 0.98 * gap, 0.0, 0.0}, {0.05, 0.1, 0.02}, {}, {}};
    if (was_closed)
      m.course.past = closed({-1.0, 0.0});
    intervals.begin(m, {}, table);
    const ContactCourse before = m.course;
    const auto find = [&](double others) {
      m.course = before;
      m.others = {others, 0.0, 0.0};
      m.force = m.growth = {};
      ContactIntervals::apply_own_force(m, table);
      intervals.find_force(m, table, 0);
      const ContactState& s = m.course.state;
      const ContactPast& past = m.course.past;
      return std::vector<double>{m.force.y(),
                                 m.force.z(),
                                 m.force.x,
                                 m.growth.y(),
                                 m.growth.z(),
                                 m.last.y(),
                                 m.penetration,
                                 m.course.force.mean.y(),
                                 m.course.force.slope.z(),
                                 m.course.relaxed,
                                 1.0 * m.throughout,
                                 1.0 * m.course.opened,
                                 1.0 * m.course.penetrates,
                                 s.normal_force,
                                 s.normal_square,
                                 s.peak,
                                 s.closed,
                                 s.approach,
                                 s.closed_at,
                                 s.departure,
                                 s.opened_at,
                                 1.0 * s.touches,
                                 s.friction.t,
                                 s.friction_work,
                                 s.damper_work,
                                 s.slid,
                                 s.sliding,
                                 s.displacement.x,
                                 past.friction.spring.x,
                                 past.friction.spring.t,
                                 1.0 * past.closed,
                                 past.rise.z(),
                                 past.spring_at_opening};
    };
    const std::vector<double> once = find(0.0);
    EXPECT_GT(once[0] * once[0] + once[1] * once[1], 0.0);
    for (const double others : {-1e4, 100.0}) { // open; pressed
      EXPECT_NE(find(others), once);
      EXPECT_EQ(find(0.0), once);
    }
  }
}

// A contact that crosses a hole to the opposite side, of a circle or of an ellipse near one, resolves it in shorter intervals, the more the faster.
TEST(ContactIntervals, AreShorterWhereAHoleIsCrossed) {
  constexpr double radius = 1e-2, gap = 1e-4;
  const auto path = [](double clearances) {
    return FreePath{{1.01 * gap, 0.0, 0.0}, {-clearances * gap / step, 0.0, 0.0}, {}, {}};
  };
  for (const contact::Obstacle& hole :
       {contact::Obstacle(contact::Circle{gap}),
        contact::Obstacle(contact::Ellipse{radius + gap, radius + 1.01 * gap, radius})}) {
    const contact::Support support{hole, {1e6}, {}};
    const ContactIntervals intervals(support, {}, isotropic(1.0), false, step, gap, {});
    EXPECT_EQ(intervals.least_count(1, closed({-1.0, 0.0}), path(0.2)), 1);
    EXPECT_EQ(intervals.least_count(1, closed({-1.0, 0.0}), path(2.2)), 4);
    EXPECT_EQ(intervals.least_count(1, closed({-1.0, 0.0}), path(8.8)), 9);
    EXPECT_EQ(intervals.least_count(2, closed({-1.0, 0.0}), path(8.8)), 18);
    EXPECT_EQ(intervals.least_count(3, closed({-1.0, 0.0}), path(8.8)), 18);
    EXPECT_EQ(intervals.least_count(24, closed({-1.0, 0.0}), path(8.8)), 24);
    EXPECT_EQ(intervals.least_count(2, closed({-1.0, 0.0}), path(80.0)), 64);
  }
}

TEST(ContactIntervals, AreShorterForDampersThatGrowWithThePenetration) {
  constexpr double stiffness = 1e6, d = 100.0, w = 20.0, gap = 1e-3;
  const contact::Support support{contact::Stop{gap, contact::PlaneAxis::y}, {stiffness, 0.0, d}, {}};
  const ContactIntervals intervals(support, {}, isotropic(w), false, step, gap,
                                   {.by_penetration = stiffness * d * w});
  const auto count = [&](double start, double end) {
    const FreePath path{{gap + start, 0.0, 0.0}, {(end - start) / step, 0.0, 0.0}, {}, {}};
    return intervals.least_count(1, closed({-1.0, 0.0}), path);
  };
  EXPECT_EQ(count(1e-6, 1e-6), 1);
  EXPECT_EQ(count(1e-4, 1e-4), 12); // r h = 20, r dt at most 1.8
  EXPECT_EQ(count(9e-5, 1e-4), 12);
  EXPECT_EQ(count(1e-4, 9e-5), 12);
  EXPECT_EQ(count(1e-2, 1e-2), 64);
}

} // namespace contact_interval_test
