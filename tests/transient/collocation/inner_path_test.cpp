// SPDX-License-Identifier: GPL-3.0-or-later
// What contacts do inside a step of collocation.
#include "scenes.hpp"
#include "transient/collocation/inner_path.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace inner_path_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

constexpr double h = 2e-4, stiffness = 1e6, speed = 0.05;

/// A contact at the nodes of a step along a straight path: the penetration is 0 at the share `touch` of the step, `rate` m/s.
struct Straight {
  ContactNode nodes[3];
  Straight(const contact::Support& support, double touch, double rate) {
    for (int j = 0; j < 3; ++j) {
      ContactNode& node = nodes[j];
      node.axes.ny = node.face.ny = 1.0;
      node.rate = rate;
      node.penetration = rate * h * (0.5 * j - touch);
      node.normal = contact::normal_force(support.normal, node.penetration, rate);
    }
  }
};

/// Integrals over the step, in shares of it, of what a force is at the nodes.
struct Moments {
  double zeroth, first;
};
Moments of_quadratic(double f0, double f1, double f2) {
  return {(f0 + 4.0 * f1 + f2) / 6.0, (2.0 * f1 + f2) / 6.0};
}

} // namespace

TEST(InnerPath, GivesTheImpulseOfAContactThatClosesOrOpens) {
  for (const double damping : {0.0, 5.0})
    for (const double touch : {0.03, 0.2, 0.47, 0.55, 0.81, 0.96})
      for (const double rate : {speed, -speed}) {
        const contact::Support support{contact::Stop{}, {stiffness, damping}, {}};
        const Straight path(support, touch, rate);
        ASSERT_TRUE(changes_inside(support, spring_table(support.friction, h), path.nodes)) << touch;
        const InnerPath inner = inner_path<2>(support, spring_table(support.friction, h), path.nodes, h);
        const Moments law = of_quadratic(path.nodes[0].normal, path.nodes[1].normal, path.nodes[2].normal),
                      more = of_quadratic(0.0, inner.force[0].normal, inner.force[1].normal);
        // F = a (s - touch) + b from the touch on, or up to where it is 0
        const double a = stiffness * rate * h, b = damping * rate, zero = touch - (rate < 0.0 ? b / a : 0.0),
                     from = rate > 0.0 ? touch : 0.0, to = rate > 0.0 ? 1.0 : zero;
        const auto zeroth = [&](double s) { return 0.5 * a * s * s + (b - a * touch) * s; };
        const auto first = [&](double s) { return a * s * s * s / 3.0 + 0.5 * (b - a * touch) * s * s; };
        const double most = std::abs(a) + std::abs(b), part = 1.0 / 16.0;
        EXPECT_NEAR(law.zeroth + more.zeroth, zeroth(to) - zeroth(from), 0.2 * part * part * most);
        EXPECT_NEAR(law.first + more.first, first(to) - first(from), 0.2 * part * part * most);
      }
}

TEST(InnerPath, LosesWhatTheDamperTakesAndWhatItsPositivePartCuts) {
  const contact::Support support{contact::Stop{}, {stiffness, 50.0}, {}};
  for (const double touch : {0.1, 0.45, 0.7}) {
    const Straight path(support, touch, speed);
    const InnerPath inner = inner_path<2>(support, spring_table(support.friction, h), path.nodes, h);
    const double closed = (1.0 - touch) * h; // s
    EXPECT_NEAR(inner.loss[1].damper, 50.0 * speed * speed * closed, 1e-3 * 50.0 * speed * speed * h);
    // without a damper nothing, at a closing or an opening; with a strong one that lets go before, all that the spring holds then
    const contact::Support lossless{contact::Stop{}, {stiffness}, {}};
    for (const double rate : {speed, -speed}) {
      const Straight way(lossless, touch, rate);
      const double held = 0.5 * stiffness * speed * speed * h * h;
      EXPECT_NEAR(inner_path<2>(lossless, spring_table({}, h), way.nodes, h).loss[1].damper, 0.0,
                  1e-12 * held);
    }
    const contact::Support damped{contact::Stop{}, {stiffness, 0.5 * touch * h * stiffness}, {}};
    const Straight leaves(damped, touch, -speed);
    const double cut = 0.5 * touch * h,
                 force = stiffness * speed * cut; // F = K |p'| (touch h - t) - C |p'|, up to t = touch h/2
    EXPECT_NEAR(inner_path<2>(damped, spring_table({}, h), leaves.nodes, h).loss[1].damper,
                damped.normal.damping * speed * speed * cut + 0.5 * stiffness * speed * speed * cut * cut,
                0.03 * force * speed * h);
  }
}

/// A pressed contact whose tangential velocity turns round: v = 2 speed (1 - 2 s/turn).
TEST(InnerPath, FollowsASlideThatEndsAndTurnsRound) {
  const contact::Support support{contact::Stop{}, {stiffness}, {1e6, 100.0, 0.3, 0.3}};
  const double press = 20.0, bound = 0.3 * press;
  for (const double turn : {0.6, 1.0, 1.4}) {
    ContactNode nodes[3];
    for (int j = 0; j < 3; ++j) {
      nodes[j].axes.ny = nodes[j].face.ny = 1.0;
      nodes[j].penetration = press / stiffness;
      nodes[j].normal = press;
      nodes[j].slip.t = 2.0 * speed * (1.0 - j / turn);
      nodes[j].slides = true;
      nodes[j].spring.t = -bound; // slid for long
      nodes[j].friction.t = nodes[j].slip.t > 0.0 ? -bound : bound;
    }
    const InnerPath inner = inner_path<2>(support, spring_table(support.friction, h), nodes, h);
    EXPECT_TRUE(changes_inside(support, spring_table(support.friction, h), nodes));
    // in many small parts
    double spring = -bound, impulse = 0.0, slider = 0.0;
    constexpr int parts = 200000;
    const double dt = h / parts, keep = std::exp(-1e6 / 100.0 * dt);
    for (int i = 0; i < parts; ++i) {
      const double v = 2.0 * speed * (1.0 - 2.0 * (i + 0.5) / parts / turn), stuck = spring - 1e6 * dt * v,
                   trial = stuck - 100.0 * v;
      const bool sticks = std::abs(trial) <= bound;
      const double force = sticks ? trial : std::copysign(bound, trial), before = spring;
      spring = sticks ? stuck : keep * spring + (1.0 - keep) * force;
      impulse += force / parts;
      if (!sticks)
        slider += std::max(0.0, force * ((before - spring) / 1e6 - v * dt));
    }
    const Moments law = of_quadratic(nodes[0].friction.t, nodes[1].friction.t, nodes[2].friction.t),
                  more = of_quadratic(0.0, inner.force[0].friction.t, inner.force[1].friction.t);
    EXPECT_NEAR(law.zeroth + more.zeroth, impulse, 5e-3 * bound) << turn;
    EXPECT_NEAR(inner.end[1].spring.t, spring, 0.02 * bound) << turn;
    EXPECT_NEAR(inner.loss[1].slider, slider, 0.02 * bound * speed * h) << turn;
  }
}

/// A contact that slides on under a friction that has fallen from its static bound to its dynamic one.
TEST(InnerPath, SlidesOnAtTheDynamicCoefficient) {
  const double press = 20.0;
  for (const double damping : {0.0, 10.0}) {
    const contact::Support support{contact::Stop{}, {stiffness}, {1e6, damping, 0.6, 0.3}};
    ContactNode nodes[3];
    for (int j = 0; j < 3; ++j) {
      nodes[j].axes.ny = nodes[j].face.ny = 1.0;
      nodes[j].penetration = press / stiffness;
      nodes[j].normal = press;
      nodes[j].slip.t = 0.15;
      nodes[j].slides = j > 0;
      nodes[j].friction.t = j > 0 ? -0.3 * press : -damping * 0.15;
      nodes[j].spring.t = j > 0 ? -0.3 * press : 0.0;
    }
    ASSERT_TRUE(changes_inside(support, spring_table(support.friction, h), nodes));
    const InnerPath inner = inner_path<2>(support, spring_table(support.friction, h), nodes, h);
    EXPECT_NEAR(inner.end[1].spring.t, -0.3 * press, 0.02 * press);
    EXPECT_TRUE(inner.end[0].slides && inner.end[1].slides);
    double spring = 0.0, impulse = 0.0;
    bool slides = false;
    constexpr int parts = 100000;
    const double dt = h / parts, keep = damping > 0.0 ? std::exp(-1e6 / damping * dt) : 0.0;
    for (int i = 0; i < parts; ++i) {
      const double stuck = spring - 1e6 * dt * 0.15, trial = stuck - damping * 0.15;
      const bool sticks = !slides && std::abs(trial) <= 0.6 * press;
      slides = !sticks;
      const double force = sticks ? trial : -0.3 * press;
      spring = sticks ? stuck : keep * spring + (1.0 - keep) * force;
      impulse += force / parts;
    }
    const Moments law = of_quadratic(nodes[0].friction.t, nodes[1].friction.t, nodes[2].friction.t),
                  more = of_quadratic(0.0, inner.force[0].friction.t, inner.force[1].friction.t);
    EXPECT_NEAR(law.zeroth + more.zeroth, impulse, 2e-3 * press) << damping;
  }
}

// Steps in which contacts close, open, stick and slide: by the quadratic alone errors are 1.1e-3 and 1.1e-4, with friction 8.6e-4 and 8.1e-5.
TEST(InnerPath, BringsTrajectoriesThroughImpacts) {
  for (const bool rubs : {false, true}) {
    Scene scene = rattling(3, 12, 0.04);
    if (!rubs)
      for (ContactPoint& c : scene.contacts)
        c.support.friction = {};
    StepOptions exact;
    exact.scheme = SchemeKind::runge_kutta_54;
    exact.tolerance = 1e-10;
    const History reference = simulate(scene, exact, 2e-3);
    double errors[2];
    for (int i = 0; i < 2; ++i) {
      const History run = simulate(scene, collocation(i == 0 ? 2e-4 : 5e-5), 2e-3);
      errors[i] = (run.q - reference.q).cwiseAbs().maxCoeff() / reference.q.cwiseAbs().maxCoeff();
    }
    EXPECT_LT(errors[0], rubs ? 2e-4 : 5e-5);
    EXPECT_LT(errors[1], rubs ? 5e-5 : 5e-6);
  }
}

} // namespace inner_path_test
