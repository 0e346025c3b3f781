// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_interval.hpp"
#include "friction_pieces.hpp"
#include "uniform.hpp"
#include <array>
#include <gtest/gtest.h>

namespace friction_in_plane_test {

using namespace fretwork;
using namespace fretwork::contact;
using tests::driven;
using tests::law;
using tests::line;

namespace {

constexpr double round_off = 1e-12;

} // namespace

TEST(FrictionInAPlane, TurnsASpringWithoutDamperAsPerfectPlasticity) {
  // at the bound, pushed at right angles, it turns towards the motion: tan(a/2) falls as exp(-K x/bound), in intervals of any length
  constexpr double bound = 0.5, length = 1.0, speed = 0.3;
  const double angle = 2.0 * std::atan(std::exp(-law.stiffness * speed * length / bound)); // from -velocity
  for (const int intervals : {1, 2, 16}) {
    Vec2 spring{bound, 0.0};
    double work = 0.0;
    const double dt = length / intervals;
    for (int i = 0; i < intervals; ++i) {
      const PieceTables table = piece_tables(law, 0.0, dt);
      const auto f = friction_over_interval(law, table, 0.0, spring, true, dt, line(1.0, 1.0),
                                            driven<Vec2, Sym2>({0.0, speed}));
      spring = f.spring;
      work += f.slider_work;
      EXPECT_GE(f.slider_work, 0.0);
      EXPECT_NEAR(norm(spring), bound, round_off);
    }
    EXPECT_NEAR(std::acos(-spring.t / bound), angle, 1e-12) << intervals;
    // what the spring does not keep: bound times the integral of speed cos(a)
    const double spent = bound * bound / law.stiffness * std::log(1.0 / std::sin(angle));
    EXPECT_NEAR(work / spent, 1.0, 1e-11) << intervals;
  }
}

TEST(FrictionInAPlane, TurnsItsDirectionOfSlipToOrderTwo) {
  // under a force that turns, from no damper to a slow one, and normal forces that grow, come from 0, and bow
  const Sym2 mobility{0.4, 0.1, 0.7};
  constexpr double duration = 4.0, push = 1.5, rate = 0.8;
  constexpr double bound_of_error = 0.016,
                   bound_of_work = 4.2e-3; // in 16 intervals: 0.0153, 0.0139 and 3.9e-3
  constexpr double order = 1.93;           // of spring and velocity: 1.94 and 1.98 at least
  const auto at = [](double t) { return push * Vec2{std::cos(rate * t), std::sin(rate * t)}; };
  const ParabolicForce normals[] = {line(1.0, 1.4), line(0.0, 2.0), {0.6, 1.4, 1.6}};
  struct Course {
    Vec2 spring, velocity;
    double work;
  };
  for (const ParabolicForce& normal : normals)
    for (const double damping : {0.0, 1e-4, 0.05, 0.5, 5.0}) {
      SCOPED_TRACE(testing::Message() << normal.first << " N, C_T " << damping);
      const FrictionLaw turning{2.0, damping, 0.5, 0.5};
      const auto after = [&](int intervals) {
        const double dt = duration / intervals;
        const PieceTables table = piece_tables(turning, 0.7, dt);
        Course out{0.5 * normal.first * Vec2{0.6, -0.8}, {-0.5, 1.5}, 0.0};
        for (int i = 0; i < intervals; ++i) {
          const double from = static_cast<double>(i) / intervals, to = (i + 1.0) / intervals;
          const double first = normal.at(from), last = normal.at(to);
          const double mean = (first + 4.0 * normal.at(0.5 * (from + to)) + last) / 6.0;
          const Vec2 a0 = at(i * dt), a1 = at((i + 1) * dt); // a line over the interval
          const auto f =
              friction_over_interval(turning, table, 0.7, out.spring, true, dt, {first, last, mean},
                                     {out.velocity, a0, (1.0 / dt) * (a1 - a0), mobility});
          EXPECT_NEAR(f.sliding_time, dt, round_off);
          out = {f.spring, f.velocity, out.work + f.slider_work};
        }
        return out;
      };
      const Course exact = after(4096);
      double spring0 = 0.0, velocity0 = 0.0;
      for (const int intervals : {16, 32, 64, 128}) {
        const Course c = after(intervals);
        const double spring = norm(c.spring - exact.spring), velocity = norm(c.velocity - exact.velocity);
        if (intervals == 16) {
          EXPECT_LT(spring, bound_of_error);
          EXPECT_LT(velocity, bound_of_error);
          EXPECT_NEAR(c.work / exact.work, 1.0, bound_of_work);
          spring0 = spring;
          velocity0 = velocity;
        } else if (intervals == 128) {
          EXPECT_GT(std::log2(spring0 / spring) / 3.0, order);
          EXPECT_GT(std::log2(velocity0 / velocity) / 3.0, order);
        }
      }
    }
}

TEST(FrictionInAPlane, IsThatOfALineWhereItMovesAlongOne) {
  tests::Uniform draw(11);
  constexpr int draws = 20000;
  constexpr double tolerance = 1e-9;
  const Vec2 along{0.6, 0.8};
  int slides = 0, differ = 0;
  for (int i = 0; i < draws; ++i) {
    const FrictionLaw any{draw.scale(0.1, 1000.0), i % 2 == 0 ? 0.0 : draw.scale(1e-3, 10.0), 0.5,
                          draw(0.2, 0.5)};
    const double dt = draw.scale(0.05, 2.0), first = draw(-0.3, 1.0), last = draw(-0.3, 1.0);
    const ParabolicForce normal = line(std::max(0.0, first), std::max(0.0, last)); // from 0, to 0, and at 0
    const double spring = draw(-0.5, 0.5) * normal.first, velocity = draw(-1.0, 1.0), push = draw(-2.0, 2.0),
                 mobility = draw(0.0, 1.0);
    const PieceTables table = piece_tables(any, mobility, dt);
    const bool sliding = draw(0.0, 1.0) > 0.5;
    const auto on_line =
        friction_over_interval(any, table, mobility, spring, sliding, dt, normal,
                               TangentialPath<double, double>{velocity, push, 0.0, mobility});
    const auto in_plane = friction_over_interval(
        any, table, mobility, spring * along, sliding, dt, normal,
        TangentialPath<Vec2, Sym2>{velocity * along, push * along, {}, {mobility, 0.0, mobility}});
    slides += on_line.sliding_time > 0.0 ? 1 : 0;
    ASSERT_TRUE(std::isfinite(norm(in_plane.impulse)) && std::isfinite(in_plane.slider_work)) << i;
    if (norm(in_plane.spring - on_line.spring * along) > tolerance ||
        norm(in_plane.impulse - on_line.impulse * along) > tolerance ||
        std::abs(in_plane.slider_work - on_line.slider_work) > tolerance)
      ++differ; // where a slip that turns round ends in a piece, or there is no normal force at all
  }
  EXPECT_GT(slides, draws / 4);
  EXPECT_LT(differ, draws / 400); // 46
}

TEST(FrictionInAPlane, SticksAsAlongItsAxes) {
  constexpr double c = 0.8, t = 0.6, dt = 1.0; // cosine and sine of the first axis
  const std::array mobility{1.0, 0.25}, compliance{4e-3, 1e-3}, velocity{0.3, -0.2}, spring{-0.2, 0.1},
      lift{3e-3, -1e-3}, shift{-2e-3, 1e-3};
  const auto turned = [&](const std::array<double, 2>& a) {
    return Vec2{c * a[0] - t * a[1], t * a[0] + c * a[1]};
  };
  const auto tensor = [&](const std::array<double, 2>& a) {
    return Sym2{c * c * a[0] + t * t * a[1], c * t * (a[0] - a[1]), t * t * a[0] + c * c * a[1]};
  };
  for (const double damping : {0.0, 0.8}) {
    const FrictionLaw sticking{1.0, damping, 10.0, 10.0};
    const PieceTables table = piece_tables(sticking, mobility[0], dt);
    const auto plane = friction_over_interval(
        sticking, table, mobility[0], turned(spring), false, dt, line(1.0, 1.0),
        {turned(velocity), {}, {}, tensor(mobility), turned(lift), tensor(compliance), turned(shift)});
    std::array<double, 2> by{}, rate{}, moment{};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto f =
          friction_over_interval(sticking, table, mobility[0], spring[k], false, dt, line(1.0, 1.0),
                                 {velocity[k], 0.0, 0.0, mobility[k], lift[k], compliance[k], shift[k]});
      by[k] = f.displacement;
      rate[k] = f.velocity;
      moment[k] = f.moment;
    }
    EXPECT_NEAR(norm(plane.displacement - turned(by)), 0.0, round_off) << damping;
    EXPECT_NEAR(norm(plane.velocity - turned(rate)), 0.0, round_off) << damping;
    EXPECT_NEAR(norm(plane.moment - turned(moment)), 0.0, round_off) << damping;
  }
}

TEST(FrictionInAPlane, SticksWhereItsDirectionsDiffer) {
  const FrictionLaw sticking{1.0, 0.8, 10.0, 10.0};
  const Sym2 mobility{0.3, 0.1, 1.0};
  constexpr double most = 1.02, duration = 4.0; // 1/kg, its largest eigenvalue about; s
  const auto after = [&](double dt) {
    const PieceTables table = piece_tables(sticking, most, dt);
    Vec2 spring{0.3, -0.2}, velocity{1.0, 0.5};
    for (int i = 0; i < static_cast<int>(std::lround(duration / dt)); ++i) {
      const auto f = friction_over_interval(sticking, table, most, spring, false, dt, line(1.0, 1.0),
                                            {velocity, {0.1, 0.05 * i * dt}, {0.0, 0.05}, mobility});
      // what the mean and the moment of the force move is what the piece says
      const Vec2 mean = (1.0 / dt) * f.impulse, growth = (12.0 / (dt * dt)) * f.moment;
      const Vec2 moved = dt * velocity + (0.5 * dt * dt) * Vec2{0.1, 0.05 * i * dt} +
                         (dt * dt * dt / 6.0) * Vec2{0.0, 0.05} +
                         (0.5 * dt * dt) * (mobility * Vec2(mean - (1.0 / 6.0) * growth));
      EXPECT_NEAR(norm(moved - f.displacement), 0.0, round_off) << dt;
      spring = f.spring;
      velocity = f.velocity;
    }
    return velocity;
  };
  const Vec2 exact = after(1e-3);
  const double coarse = norm(after(0.8) - exact), fine = norm(after(0.4) - exact);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_GT(std::log2(coarse / fine), 3.0);
}

} // namespace friction_in_plane_test
