// SPDX-License-Identifier: GPL-3.0-or-later
// What holds of friction for any input: both memories, every law, every form of a step, in chains of steps under
// a normal force that falls under a loaded spring, ends and returns.
#include "friction_forms.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace friction_property_test {

using namespace fretwork;
using namespace fretwork::contact;
using namespace fretwork::tests;

namespace {

constexpr double bound_tolerance = 1e-12;
constexpr double round_off = 1e-12; // of energies, relative to the sum of their terms
constexpr double rescaled = 1e-12;  // rounding of scales that are no powers of two
constexpr double unlike = 1e-6;     // mobilities in two directions; the condition of what is solved
constexpr double alike = 1e-4;      // the same where its rounding is compared
constexpr double underflow = std::numeric_limits<double>::min(); // a free slider's spring relaxes below it
constexpr int steps = 4000;

/// Calls check(law, form, memory before, input, moved, end) along a chain of random steps of each law and form.
template <class Check>
void chain(FrictionMemoryKind kind, std::uint64_t seed, Check check, double least = unlike) {
  Uniform uniform(seed);
  for (const FrictionLaw& law : laws(kind))
    for (const Form form : forms) {
      FrictionMemory memory;
      double falling = 20.0;
      for (int i = 0; i < steps; ++i) {
        falling = i % 40 == 0 ? 20.0 : 0.8 * falling;
        const double h = uniform.scale(1e-6, 1e-3);
        if (i % 97 == 96) {
          memory = open_step(law, friction_table(law, h), memory).memory;
          continue;
        }
        const StepInput in = draw_step(uniform, i % 3 == 0 ? uniform(0.0, 20.0) : falling, least);
        const Moved moved = move(form, law, h, memory, in);
        const FrictionStep end = close_step(law, friction_table(law, h), memory, moved.friction, moved.dx);
        check(law, form, memory, in, moved, end);
        memory = end.memory;
      }
    }
}

/// Size of the energies of a step.
double energies(const FrictionLaw& law, const FrictionMemory& before, const Moved& moved,
                const FrictionStep& end) {
  return norm(moved.friction.force) * norm(moved.dx) + law.spring_energy(before.spring) +
         law.spring_energy(end.memory.spring);
}

} // namespace

TEST(FrictionProperty, ForceStaysWithinTheCone) {
  for (const auto kind : kinds) {
    int slips = 0, all = 0;
    chain(kind, 71,
          [&](const FrictionLaw& law, Form, const FrictionMemory& m, const StepInput& in, const Moved& moved,
              const FrictionStep&) {
            const double mu = moved.friction.slides || m.sliding ? law.mu_dynamic : law.mu_static;
            EXPECT_LE(norm(moved.friction.force), mu * in.normal * (1.0 + bound_tolerance));
            slips += moved.friction.slides;
            ++all;
          });
    EXPECT_GT(slips, all / 10); // both regimes were met
    EXPECT_LT(slips, all - all / 10);
  }
}

TEST(FrictionProperty, SliderNeverGivesEnergy) {
  constexpr double solved =
      1e-10; // direction of an implicit slip of `reference`: Newton's last step is below it
  for (const auto kind : kinds)
    chain(kind, 72,
          [&](const FrictionLaw& law, Form, const FrictionMemory& m, const StepInput&, const Moved& moved,
              const FrictionStep& end) {
            EXPECT_GE(end.friction_work, -solved * energies(law, m, moved, end));
            if (!moved.friction.slides) {
              EXPECT_EQ(end.friction_work, 0.0);
              EXPECT_EQ(norm(end.slip), 0.0);
            }
          });
}

TEST(FrictionProperty, DamperNeverGivesEnergy) {
  const auto expect_loss = [](const FrictionLaw& law, const FrictionMemory& m, const Moved& moved,
                              const FrictionStep& end) {
    EXPECT_GE(end.damper_work, -round_off * energies(law, m, moved, end));
  };
  chain(FrictionMemoryKind::return_map, 73,
        [&](const FrictionLaw& law, Form, const FrictionMemory& m, const StepInput&, const Moved& moved,
            const FrictionStep& end) { expect_loss(law, m, moved, end); });
  int jumps = 0;
  chain(FrictionMemoryKind::reference, 74,
        [&](const FrictionLaw& law, Form, const FrictionMemory& m, const StepInput&, const Moved& moved,
            const FrictionStep& end) {
          if (!moved.friction.slides) {
            expect_loss(law, m, moved, end);
            return;
          }
          // a slip sets the spring: its energy jumps, and the jump is what is booked
          const double jump = law.spring_energy(end.memory.spring) - law.spring_energy(m.spring);
          EXPECT_NEAR(end.damper_work, -jump, round_off * energies(law, m, moved, end));
          jumps += jump > 0.0;
        });
  EXPECT_GT(jumps, 100);
}

TEST(FrictionProperty, EnergyIsSharedOutWithoutRest) {
  for (const auto kind : kinds)
    chain(kind, 75,
          [&](const FrictionLaw& law, Form, const FrictionMemory& m, const StepInput&, const Moved& moved,
              const FrictionStep& end) {
            const double stored = law.spring_energy(end.memory.spring) - law.spring_energy(m.spring);
            EXPECT_NEAR(-dot(moved.friction.force, moved.dx), end.friction_work + end.damper_work + stored,
                        round_off * energies(law, m, moved, end) + underflow);
          });
}

TEST(FrictionProperty, NothingActsOrIsRememberedAlongABarredDirection) {
  for (const auto kind : kinds) {
    int acted = 0;
    chain(kind, 76,
          [&](const FrictionLaw& law, Form, const FrictionMemory&, const StepInput&, const Moved& moved,
              const FrictionStep& end) {
            const auto expect_none = [&](double allowed, double force, double spring, double slip) {
              if (allowed == 0.0) {
                EXPECT_EQ(force, 0.0);
                EXPECT_EQ(spring, 0.0);
                EXPECT_EQ(slip, 0.0);
              }
              acted += allowed != 0.0 && force != 0.0;
            };
            expect_none(law.along.x, moved.friction.force.x, end.memory.spring.x, end.slip.x);
            expect_none(law.along.t, moved.friction.force.t, end.memory.spring.t, end.slip.t);
          });
    EXPECT_GT(acted, steps);
  }
}

TEST(FrictionProperty, ARestrictedPlaneIsALine) {
  // friction across x_loc only: whatever moves along it and however it is coupled
  Uniform uniform(77);
  for (const auto kind : kinds) {
    const FrictionLaw across{1e6, 50.0, 0.5, 0.3, kind, {0.0, 1.0}};
    const FrictionTable table = friction_table(across, 1e-4);
    for (int i = 0; i < steps; ++i) {
      const StepInput in = draw_step(uniform, uniform(0.0, 20.0), unlike);
      const FrictionMemory memory{{0.0, uniform(-5.0, 5.0)}, uniform(-1, 1) > 0.0};
      const Friction plane = step_friction_plane(across, table, memory, in.normal, in.velocity, in.mobility);
      const Friction line =
          step_friction_line(across, table, memory, in.normal, in.velocity.t, in.mobility.tt);
      EXPECT_EQ(plane.slides, line.slides);
      EXPECT_NEAR(plane.force.t, line.force.t, bound_tolerance * (std::abs(line.force.t) + 0.5 * in.normal));
      const Friction instant = evaluate(across, memory, in.normal, 1e-5 * in.velocity, in.velocity);
      const Friction on_line = evaluate_line(across, memory, in.normal, 1e-5 * in.velocity.t, in.velocity.t);
      EXPECT_NEAR(instant.force.t, on_line.force.t, bound_tolerance * 0.5 * in.normal);
      EXPECT_EQ(instant.slides, on_line.slides);
    }
  }
}

TEST(FrictionProperty, TheSameInputGivesTheSameBits) {
  for (const auto kind : kinds)
    chain(kind, 78,
          [&](const FrictionLaw& law, Form form, const FrictionMemory& m, const StepInput& in, const Moved&,
              const FrictionStep&) {
            const FrictionMemory before = m;
            const Moved a = move(form, law, 1e-4, m, in), b = move(form, law, 1e-4, m, in);
            EXPECT_EQ(a.friction.force.x, b.friction.force.x);
            EXPECT_EQ(a.friction.force.t, b.friction.force.t);
            EXPECT_EQ(a.friction.slides, b.friction.slides);
            EXPECT_EQ(m.spring.x, before.spring.x);
            EXPECT_EQ(m.spring.t, before.spring.t);
          });
}

TEST(FrictionProperty, MirrorsWithItsInput) {
  for (const auto kind : kinds)
    for (const Vec2 mirror : {Vec2{-1.0, 1.0}, Vec2{1.0, -1.0}}) {
      const auto image = [&](Vec2 v) { return Vec2{mirror.x * v.x, mirror.t * v.t}; };
      chain(kind, 79,
            [&](const FrictionLaw& law, Form form, const FrictionMemory& m, const StepInput& in, const Moved&,
                const FrictionStep&) {
              const double h = 1e-4;
              const auto& a = in.mobility;
              const FrictionMemory m2{image(m.spring), m.sliding};
              const Moved f = move(form, law, h, m, in);
              const Moved g = move(form, law, h, m2, {in.normal, image(in.velocity), {a.xx, -a.xt, a.tt}});
              EXPECT_EQ(image(f.friction.force).x, g.friction.force.x);
              EXPECT_EQ(image(f.friction.force).t, g.friction.force.t);
              const FrictionStep e = close_step(law, friction_table(law, h), m, f.friction, f.dx),
                                 o = close_step(law, friction_table(law, h), m2, g.friction, g.dx);
              EXPECT_EQ(image(e.memory.spring).x, o.memory.spring.x);
              EXPECT_EQ(image(e.memory.spring).t, o.memory.spring.t);
              EXPECT_EQ(e.friction_work, o.friction_work);
              EXPECT_EQ(e.damper_work, o.damper_work);
            });
    }
}

TEST(FrictionProperty, HidesNoUnit) {
  struct Units {
    double mass, length, time, tolerance; // relative; 0: the same bytes
  };
  for (const Units u : {Units{0x1p9, 0x1p-11, 0x1p4, 0.0}, Units{1e-3, 1e3, 1.0, rescaled}})
    for (const auto kind : kinds)
      chain(
          kind, 80,
          [&](const FrictionLaw& law, Form form, const FrictionMemory& m, const StepInput& in, const Moved&,
              const FrictionStep&) {
            const double force = u.mass * u.length / (u.time * u.time), speed = u.length / u.time, h = 1e-4;
            FrictionLaw scaled = law;
            scaled.stiffness *= force / u.length;
            scaled.damping *= force / speed;
            const double easy = speed / force;
            const auto& a = in.mobility;
            const FrictionMemory m2{force * m.spring, m.sliding};
            const Moved f = move(form, law, h, m, in);
            const Moved g =
                move(form, scaled, h * u.time, m2,
                     {force * in.normal, speed * in.velocity, {easy * a.xx, easy * a.xt, easy * a.tt}});
            const double size = norm(m.spring) + law.mu_static * in.normal;
            EXPECT_NEAR(g.friction.force.x / force, f.friction.force.x, u.tolerance * size);
            EXPECT_NEAR(g.friction.force.t / force, f.friction.force.t, u.tolerance * size);
            const FrictionStep e = close_step(law, friction_table(law, h), m, f.friction, f.dx),
                               o = close_step(scaled, friction_table(scaled, h * u.time), m2, g.friction,
                                              g.dx);
            const double work =
                u.tolerance * (size + law.stiffness * norm(f.dx)) * (norm(f.dx) + size / law.stiffness);
            EXPECT_NEAR(o.friction_work / (force * u.length), e.friction_work, work);
            EXPECT_NEAR(o.damper_work / (force * u.length), e.damper_work, work + underflow);
            const FrictionStep open = open_step(law, friction_table(law, h), m),
                               other = open_step(scaled, friction_table(scaled, h * u.time), m2);
            EXPECT_NEAR(other.memory.spring.t / force, open.memory.spring.t, u.tolerance * size + underflow);
          },
          alike);
}

} // namespace friction_property_test
