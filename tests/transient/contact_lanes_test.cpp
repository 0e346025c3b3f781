// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The laws in vector lanes against the same laws contact by contact.
#include "contact/instant_spring.hpp"
#include "transient/contact_solver.hpp"
#include <gtest/gtest.h>
#include <random>

namespace fretwork::transient {
namespace {

constexpr double round_off = 1e-11; ///< relative, of memories that many steps have built up
constexpr double settled = 1e-4; ///< both sweeps stop at 1e-6 of a force, and memories keep what they leave

/// The contact side of a scheme.
struct Engine {
  Engine(const std::vector<ContactPoint>& points, Eigen::Index modes, double step, bool in_lanes)
      : contacts(points, modes), motion(contacts),
        memory((contacts.in_lanes = contacts.in_lanes && in_lanes, contacts), step), solver(contacts, step),
        trial(contacts.count) {}
  ContactLosses step(const kernels::Array& q, const kernels::Array& v) {
    motion.gather(q.data(), v.data());
    action = solver.solve(memory, motion, trial);
    converged = action.converged && converged;
    return memory.commit(motion, trial);
  }
  PackedContacts contacts;
  ContactMotion motion;
  ContactMemory memory;
  ContactSolver solver;
  ContactTrial trial;
  ContactSolver::Action action;
  bool converged = true;
};

contact::Support support_of(int kind) {
  contact::Support s{contact::Circle{1e-3}, {1e5, 20.0}, {5e4, 15.0, 0.4, 0.3}};
  switch (kind % 6) {
  case 0:
    break;
  case 1:
    s.obstacle = contact::PlanePair{8e-4, contact::PlaneAxis::z};
    s.normal = {2e5, 0.0, 1.5};
    break;
  case 2:
    s.obstacle = contact::RoundPair{1e-3};
    s.friction.mu_dynamic = 0.0;
    break;
  case 3:
    s.friction = {};
    break;
  case 4:
    s.friction.along = {0.0, 0.0};
    break;
  default:
    s.obstacle = contact::Stop{1e-4, contact::PlaneAxis::y};
    s.friction.damping = 0.0;
  }
  return s;
}

struct Contacts {
  int count;
  bool planes_apart = false, damped = true; ///< modes of either plane; some normal laws with dampers
  double step = 1e-4;                       ///< s
  [[nodiscard]] bool long_steps() const { return step > 1e-4; }
};

/// Vectors of another size while it lives.
class Vectors {
public:
  explicit Vectors(kernels::VectorSize most) { kernels::limit_vectors(most); }
  Vectors(const Vectors&) = delete;
  Vectors& operator=(const Vectors&) = delete;
  ~Vectors() { kernels::limit_vectors(kernels::VectorSize::pack); }
};

/// Many steps of random motion, half of the contacts closed on the average. `tolerance` relative to forces.
void compare(const Contacts& kind, double tolerance) {
  const auto [count, planes_apart, damped, h] = kind;
  std::mt19937 random(static_cast<unsigned>(count));
  std::normal_distribution<double> normal;
  constexpr Eigen::Index modes = 24;
  constexpr double force = 100.0;
  std::vector<ContactPoint> points(static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c) {
    points[c].support = support_of(c);
    if (!damped)
      points[c].support.normal = {points[c].support.normal.stiffness};
    if (kind.long_steps()) { // so that frictions do not move each other more than themselves
      points[c].support.friction.stiffness *= 0.2;
      points[c].support.friction.damping *= 0.2;
    }
    const double coupling = damped ? 0.3 : 0.6;
    points[c].b = Eigen::MatrixXd::NullaryExpr(3, modes, [&] { return coupling * normal(random); });
    points[c].b.row(0).setZero();
    if (planes_apart) { // modes of either plane, axes along them
      points[c].b.row(1).head(modes / 2).setZero();
      points[c].b.row(2).tail(modes / 2).setZero();
    }
  }
  Engine lanes(points, modes, h, true), each(points, modes, h, false);
  ASSERT_TRUE(lanes.contacts.in_lanes);
  EXPECT_NE(lanes.contacts.mobility_lanes.coupled, planes_apart);
  const auto padded = static_cast<std::size_t>(lanes.contacts.padded_modes);
  kernels::Array q(padded), v(padded);
  int closed = 0, sliding = 0, left = 0; ///< to the others
  for (int k = 0; k < 2000; ++k) {
    for (Eigen::Index i = 0; i < modes; ++i) {
      q[i] = 0.98 * q[i] + (kind.long_steps() ? h * v[i] : 1.5e-4 * normal(random));
      v[i] = 0.9 * v[i] + 0.02 * normal(random);
    }
    const ContactLosses a = lanes.step(q, v), b = each.step(q, v);
    ASSERT_EQ(lanes.trial.active, each.trial.active) << "step " << k;
    ASSERT_EQ(lanes.trial.opened, each.trial.opened);
    const bool gave_up = !lanes.trial.found_in_lanes && !lanes.trial.active.empty();
    EXPECT_TRUE(!gave_up || kind.long_steps())
        << "they gave up"; // in long steps contacts move almost together
    left += gave_up;
    EXPECT_NEAR(lanes.action.work, each.action.work, count * tolerance * force * h);
    EXPECT_NEAR(lanes.action.jump, each.action.jump, count * tolerance * force * h);
    for (const int c : lanes.trial.active) {
      const ContactState &s = lanes.trial.states[c], &t = each.trial.states[c];
      EXPECT_NEAR(s.normal_force, t.normal_force, tolerance * force);
      EXPECT_NEAR(s.instant_share * s.normal_force, t.instant_share * t.normal_force, tolerance * force);
      EXPECT_NEAR(s.friction.t, t.friction.t, tolerance * force);
      EXPECT_NEAR(s.displacement.t, t.displacement.t, tolerance * h);
      EXPECT_NEAR(s.friction_work, t.friction_work, tolerance * force * h);
      EXPECT_NEAR(s.damper_work, t.damper_work, tolerance * force * h);
      EXPECT_NEAR(s.approach, t.approach, round_off); // FMA or not
      const auto m = lanes.memory.at(c, s.ny, s.nz), n = each.memory.at(c, s.ny, s.nz);
      EXPECT_NEAR(m.spring.t, n.spring.t, tolerance * force);
      ++closed;
      sliding += s.slides;
    }
    EXPECT_NEAR(lanes.trial.springs, each.trial.springs, round_off * (1e-3 + each.trial.springs));
    EXPECT_NEAR(a.friction, b.friction, count * tolerance * force * h);
    EXPECT_NEAR(a.damping, b.damping, count * tolerance * force * h);
    EXPECT_NEAR(lanes.memory.spring_energy(), each.memory.spring_energy(), count * tolerance * 0.1);
    ASSERT_FALSE(testing::Test::HasFailure()) << "step " << k;
  }
  EXPECT_TRUE(lanes.converged);
  EXPECT_LT(left, 1000);
  EXPECT_GT(closed, 300 * count);
  EXPECT_GT(sliding, 30);
}

/// In vectors of 2, 4 and 8 doubles, as far as the processor has them.
class ContactLanes : public testing::TestWithParam<kernels::VectorSize> {
  Vectors vectors_{GetParam()};
};

TEST_P(ContactLanes, FollowTheLawsOfOneContact) {
  compare({1}, round_off);
  compare({1, true}, round_off);
}

/// So few that they are taken one after the other.
TEST_P(ContactLanes, FollowTheLawsOfTwoContacts) { compare({2}, settled); }

TEST_P(ContactLanes, FollowTheLawsOfOnePackOfContacts) { compare({5}, settled); }

TEST_P(ContactLanes, FollowTheLawsOfAFewPacksOfContacts) { compare({19}, settled); }

TEST_P(ContactLanes, FollowTheLawsWherePlanesAreNotCoupled) {
  compare({2, true}, settled);
  compare({11, true}, settled);
}

/// w_c h from 0.4 to 1.3, displacements that follow the velocities: contacts close and open between actions.
TEST_P(ContactLanes, FollowTheLawsOfLongSteps) {
  for (const int count : {1, 2, 4, 11})
    for (const double step : {0.5e-3, 1e-3, 1.4e-3})
      compare({count, true, false, step}, count > 1 ? settled : round_off);
}

/// Where sweeps are over frictions alone.
TEST_P(ContactLanes, FollowTheLawsWithoutNormalDampers) {
  for (const int count : {1, 2, 4, 7, 19}) {
    compare({count, false, false}, count > 1 ? settled : round_off);
    compare({count, true, false}, count > 1 ? settled : round_off);
  }
}

/// What flights ask, against the gaps of all contacts one by one.
TEST_P(ContactLanes, TellWhichMotionsLeaveAllContactsOpen) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1e-3, 1e-3);
  for (const int count : {1, 2, 3, 4, 5, 8, 11}) {
    std::vector<ContactPoint> points(static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c) {
      points[c].support = support_of(c % 3 == 2 ? 5 : c % 3); // circle, planes, stop
      points[c].rest = {0.0, 0.1 * place(random), 0.1 * place(random)};
      points[c].b = Eigen::MatrixXd::Zero(3, 1);
    }
    const PackedContacts contacts(points, 1);
    ContactMotion motion(contacts), later(contacts);
    int open = 0, slow = 0;
    constexpr int motions = 4000;
    for (int k = 0; k < motions; ++k) {
      const double time = place(random), size = std::pow(count, -0.5);
      const auto length = [&](double y, double z) { return std::sqrt(y * y + z * z); };
      bool all_open = true, all_slow = true;
      for (int c = 0; c < count; ++c)
        for (const int i : {c, contacts.width + c}) {
          motion.u[i] = 1.1 * size * place(random);
          motion.w[i] = 2000.0 * size * place(random);
          later.u[i] = motion.u[i] + time * motion.w[i];
        }
      for (int c = 0; c < count; ++c) {
        all_open = all_open && later.locate(c).gap > 0.0;
        all_slow = all_slow && std::abs(time) * length(motion.w[c], motion.w[contacts.width + c]) <=
                                   0.3 * contacts.reach[c].limit[kernels::lane(c)];
      }
      EXPECT_EQ(motion.opens_after(time), all_open) << count << " contacts, motion " << k;
      EXPECT_EQ(motion.moves_less(std::abs(time), 0.3), all_slow) << count << " contacts, motion " << k;
      open += all_open;
      slow += all_slow;
    }
    for (const int number : {open, slow}) {
      EXPECT_GT(number, motions / 40) << count << " contacts";
      EXPECT_LT(number, motions - motions / 40) << count << " contacts";
    }
  }
}

/// Springs of open contacts die out over several steps at once as over one after the other, until they are forgotten.
TEST_P(ContactLanes, LetSpringsDieOutOverSeveralSteps) {
  for (const int count : {1, 4, 11}) {
    std::vector<ContactPoint> points(static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c) {
      points[c].support = support_of(0);
      points[c].support.friction.damping *= 1.0 + 0.2 * c; // at different paces
      points[c].b = Eigen::MatrixXd::Zero(3, 2);
      points[c].b(1, 0) = points[c].b(2, 1) = 0.3;
    }
    Engine at_once(points, 2, 1e-4, true), one_by_one(points, 2, 1e-4, true), each(points, 2, 1e-4, false);
    kernels::Array q(8), v(8), none(8);
    q[0] = 4e-3;
    v[1] = 0.5;
    double lost[3] = {}, loaded[3], most = 0.0; // J; `most`: while closed, whose round-off stays
    Engine* const engines[] = {&at_once, &one_by_one, &each};
    for (int i = 0; i < 3; ++i) {
      Engine* e = engines[i];
      e->step(q, v);
      most = std::max(most, e->memory.spring_energy());
      e->step(none, none);
      ASSERT_TRUE(e->memory.closed().empty());
      loaded[i] = e->memory.spring_energy();
      ASSERT_GT(loaded[i], 0.0);
    }
    for (int k = 0; k < 60; ++k) {
      lost[0] += at_once.memory.pass(at_once.motion, 12, at_once.trial).damping;
      for (int step = 0; step < 12; ++step)
        lost[1] += one_by_one.memory.pass(one_by_one.motion, 1, one_by_one.trial).damping;
      lost[2] += each.memory.pass(each.motion, 12, each.trial).damping;
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(engines[i]->memory.spring_energy(), at_once.memory.spring_energy(), 1e-9 * loaded[0]);
        EXPECT_NEAR(lost[i] + engines[i]->memory.spring_energy(), loaded[i], 1e-14 * most);
      }
      for (int c = 0; c < count; ++c)
        EXPECT_EQ(at_once.memory.at(c, -1.0, 0.0).spring.t, one_by_one.memory.at(c, -1.0, 0.0).spring.t);
    }
    for (const Engine* e : engines)
      for (int c = 0; c < count; ++c)
        EXPECT_EQ(e->memory.at(c, -1.0, 0.0).spring.t, 0.0) << "contact " << c;
    EXPECT_TRUE(at_once.memory.lanes().places.empty());
  }
}

/// Springs that follow their contacts (ContactMemory::follow, leave), as `splitting` has them.
void follow(int count, double h) {
  constexpr Eigen::Index modes = 24;
  constexpr double force = 100.0;
  std::mt19937 random(static_cast<unsigned>(count));
  std::normal_distribution<double> normal;
  std::vector<ContactPoint> points(static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c) {
    points[c].support = support_of(c);
    points[c].support.normal = {points[c].support.normal.stiffness};
    points[c].support.friction.damping *= 0.2;
    points[c].b = Eigen::MatrixXd::NullaryExpr(3, modes, [&] { return 0.6 * normal(random); });
    points[c].b.row(0).setZero();
  }
  Engine lanes(points, modes, h, true), each(points, modes, h, false);
  ASSERT_TRUE(lanes.contacts.in_lanes);
  kernels::Array q(static_cast<std::size_t>(lanes.contacts.padded_modes)), v(q);
  double moved = 0.0; // J, by which springs have followed
  int sticks = 0, slides = 0;
  for (int k = 0; k < 4000; ++k) {
    for (Eigen::Index i = 0; i < modes; ++i) {
      q[i] = 0.98 * q[i] + (h > 2e-4 ? h * v[i] : 1.5e-4 * normal(random));
      v[i] = 0.9 * v[i] + 0.02 * normal(random);
    }
    double energy[2] = {};
    for (Engine* e : {&lanes, &each}) {
      e->motion.gather_near(q.data(), v.data(), e->memory.closed());
      if (e->motion.places.first.empty() && e->memory.closed().empty()) {
        e->memory.pass(e->motion, 1, e->trial);
        continue;
      }
      const double before = e->memory.spring_energy();
      e->memory.follow(e->motion, 0.5 * h);
      energy[e == &each] = e->memory.spring_energy() - before;
      e->solver.solve_near(e->memory, e->motion, e->trial);
      e->memory.commit(e->motion, e->trial);
      e->memory.leave(e->motion, e->trial, 0.5 * h);
    }
    moved += std::abs(energy[0]);
    ASSERT_EQ(lanes.trial.active, each.trial.active) << "step " << k;
    EXPECT_NEAR(energy[0], energy[1], count * settled * 0.1);
    EXPECT_NEAR(lanes.memory.spring_energy(), each.memory.spring_energy(), count * settled * 0.1);
    for (const int c : lanes.trial.active) {
      const ContactState& s = lanes.trial.states[c];
      EXPECT_NEAR(lanes.memory.at(c, s.ny, s.nz).spring.t, each.memory.at(c, s.ny, s.nz).spring.t,
                  settled * force);
      sticks += !s.slides;
      slides += s.slides;
    }
    ASSERT_FALSE(testing::Test::HasFailure()) << count << " contacts, step " << k;
  }
  EXPECT_GT(moved, 1.0);
  EXPECT_GT(sticks, 100);
  EXPECT_GT(slides, 100);
}

TEST_P(ContactLanes, LetSpringsFollowTheirContacts) {
  for (const int count : {1, 2, 3, 4, 7, 11, 19})
    for (const double step : {1e-4, 1e-3, 1.4e-3})
      follow(count, step);
}

INSTANTIATE_TEST_SUITE_P(InVectors, ContactLanes,
                         testing::Values(kernels::VectorSize::pair, kernels::VectorSize::half,
                                         kernels::VectorSize::pack));

/// Contacts that move together: Jacobi sweeps do not settle and the others take over.
TEST(JacobiSweeps, GiveWayWhereTheyDoNotConverge) {
  constexpr Eigen::Index modes = 2;
  std::vector<ContactPoint> points(9);
  for (ContactPoint& point : points) {
    point.support = {contact::Stop{0.0, contact::PlaneAxis::y}, {1e6, 5e2}, {}};
    point.b = Eigen::MatrixXd::Zero(3, modes);
    point.b(1, 0) = point.b(2, 1) = 1.0;
  }
  Engine engine(points, modes, 1e-3, true);
  ASSERT_TRUE(engine.contacts.in_lanes);
  kernels::Array q(8), v(8);
  q[0] = 1e-4, v[0] = 0.1;
  engine.step(q, v);
  EXPECT_TRUE(engine.converged);
  // all equal: F = F_K + C (v - 9 (h/2) F), each F_K as of a contact alone
  const double share = 0.5e-3, spring = contact::InstantSpring(1e6, share, 1e-3).force(1e-4, 0.1);
  for (const ContactState& s : engine.trial.states)
    EXPECT_NEAR(s.normal_force, (spring + 5e2 * 0.1) / (1.0 + 9.0 * 5e2 * share), 1e-4 * s.normal_force);
}

} // namespace
} // namespace fretwork::transient
