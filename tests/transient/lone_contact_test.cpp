// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The step of a contact that acts alone against that of the same contact among others.
#include "transient/contact_solver.hpp"
#include "transient/sliding_paths.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace fretwork::transient {
namespace {

constexpr double h = 1e-4;
constexpr Eigen::Index modes = 24;

/// The contact side of `splitting`.
struct Side {
  explicit Side(const std::vector<ContactPoint>& points)
      : contacts(points, modes), motion(contacts), memory(contacts, h), solver(contacts, h),
        trial(contacts.count), paths(contacts, h, true) {}

  void act_together() {
    const double before = memory.spring_energy();
    memory.follow(motion, 0.5 * h);
    followed = memory.spring_energy() - before;
    const auto found = solver.solve_near(memory, motion, trial);
    work = found.work;
    jump = found.jump;
    paths.correct(motion, memory, trial);
    losses = memory.commit(motion, trial);
    paths.end_slides(trial, losses);
    memory.leave(motion, trial, 0.5 * h);
  }
  /// Returns whether it could.
  bool act_alone(int c) {
    kernels::NormalPush& push = paths.push(c);
    const bool closes = push.y == 0.0 && push.z == 0.0;
    const kernels::LoneStep step = memory.step_alone(c, motion, solver.rule(), push, trial);
    if (!step.found)
      return false;
    const ContactState& s = trial.states[static_cast<std::size_t>(c)];
    EXPECT_EQ(step.force_y, s.normal_force * s.ny + s.friction.t * s.nz);
    EXPECT_EQ(step.force_z, s.normal_force * s.nz - s.friction.t * s.ny);
    followed = step.followed;
    work = step.work;
    jump = step.jump;
    losses = {step.damping, step.friction};
    if (paths.ends(c)) {
      paths.end_alone(c, closes, step, motion, s);
      paths.end_slides(trial, losses);
    }
    return true;
  }

  PackedContacts contacts;
  ContactMotion motion;
  ContactMemory memory;
  ContactSolver solver;
  ContactTrial trial;
  SlidingPaths paths;
  ContactLosses losses;
  double followed = 0.0, work = 0.0, jump = 0.0;
};

enum class Kind {
  undamped,
  damped,
  coupled,
  dissipating,
  ending,
  ending_damped,
  touching,
  crossing,
  smooth,
  along_nothing
};

bool has_damper(Kind kind) {
  return kind == Kind::damped || kind == Kind::dissipating || kind == Kind::ending_damped;
}
contact::Support support_of(Kind kind) {
  contact::Support s{contact::Circle{1e-3}, {1e5}, {5e4, 15.0, 0.4, 0.3}};
  switch (kind) {
  case Kind::undamped:
    break;
  case Kind::damped:
  case Kind::coupled: // friction acts on the normal force
    s.normal.damping = 20.0;
    break;
  case Kind::dissipating:
    s.obstacle = contact::PlanePair{8e-4, contact::PlaneAxis::z};
    s.normal.dissipation = 1.5;
    break;
  case Kind::ending: // C_T W h > 1: slides end inside a step
    s.friction.damping = 2e4;
    break;
  case Kind::ending_damped:
    s.normal.damping = 20.0;
    s.friction.damping = 2e4;
    break;
  case Kind::touching: // so hard that slides begin with a touch and end while the force grows
    s.normal.stiffness = 1e7;
    s.friction.damping = 2e4;
    break;
  case Kind::crossing: // from face to face
    s.obstacle = contact::PlanePair{0.0, contact::PlaneAxis::z};
    s.friction.damping = 2e4;
    break;
  case Kind::smooth:
    s.friction = {};
    break;
  case Kind::along_nothing:
    s.friction.along = {0.0, 0.0};
    break;
  }
  return s;
}

std::vector<ContactPoint> points_of(Kind kind, int count, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<ContactPoint> points(static_cast<std::size_t>(count));
  for (ContactPoint& point : points) {
    point.support = support_of(kind);
    point.b = Eigen::MatrixXd::NullaryExpr(3, modes, [&] { return 0.6 * normal(random); });
    point.b.row(0).setZero();
    if (has_damper(kind)) { // whose contacts act alone where friction does not act on the normal force
      point.b.row(1).tail(modes / 2).setZero();
      point.b.row(2).head(modes / 2).setZero();
      point.b.row(2).tail(modes / 2) = point.b.row(1).head(modes / 2).reverse();
    }
  }
  return points;
}

/// Sines of many frequencies.
class Motion {
public:
  Motion(int count, std::mt19937& random)
      // every contact moves about its hole: the more there are, the less often each touches it
      : amplitude_(3.4e-4 * (count > 4   ? 0.6
                             : count > 1 ? 0.75
                                         : 1.0)),
        rate_(modes), phase_(modes) {
    std::uniform_real_distribution<double> share;
    for (Eigen::Index i = 0; i < modes; ++i) {
      rate_[i] = 300.0 + 600.0 * share(random);
      phase_[i] = 6.28 * share(random);
    }
  }
  void at(double time, kernels::Array& q, kernels::Array& v) const {
    for (Eigen::Index i = 0; i < modes; ++i) {
      const double angle = rate_[i] * time + phase_[i];
      q[static_cast<std::size_t>(i)] = amplitude_ * std::sin(angle);
      v[static_cast<std::size_t>(i)] = amplitude_ * rate_[i] * std::cos(angle);
    }
  }

private:
  double amplitude_;
  Eigen::ArrayXd rate_, phase_;
};

/// What steps did.
struct Counts {
  int lone = 0, refused = 0, closes = 0, opens = 0, slides = 0, sticks = 0, ended = 0, held_open = 0,
      beside = 0, crossed = 0, begun = 0;
};

/// A step; contacts act alone where they can, if they `may`.
void step(Side& side, const kernels::Array& q, const kernels::Array& v, bool may, Counts& counts) {
  if (side.solver.window() > 0.0 || side.motion.places.all.few())
    side.motion.meet(q.data(), v.data(), side.solver.window());
  else
    side.motion.gather_near(q.data(), v.data(), side.memory.closed());
  if (side.motion.places.first.empty() && side.memory.closed().empty()) {
    side.losses = side.memory.pass(side.motion, 1, side.trial);
    return;
  }
  const int c = side.motion.lone();
  const bool was_closed = !side.memory.closed().empty();
  const double before_y = c >= 0 ? side.paths.push(c).y : 0.0, before_z = c >= 0 ? side.paths.push(c).z : 0.0;
  if (!(may && c >= 0 && side.memory.only(c))) {
    side.act_together();
    return;
  }
  if (!side.act_alone(c)) {
    ++counts.refused;
    side.act_together();
    return;
  }
  const ContactState& s = side.trial.states[static_cast<std::size_t>(c)];
  const bool is_closed = s.normal_force > 0.0;
  ++counts.lone;
  counts.closes += is_closed && !was_closed;
  counts.opens += was_closed && !is_closed;
  counts.slides += s.slides;
  counts.sticks += is_closed && !s.slides;
  counts.ended += s.slid != (s.slides ? std::abs(s.displacement.t) : 0.0);
  counts.begun += s.pressing_share != 1.0;
  counts.held_open += side.trial.cut != 0.0;
  counts.beside += side.memory.lanes().places.size() > 1;
  counts.crossed += is_closed && before_y * s.ny + before_z * s.nz < 0.0;
}

class LoneContacts : public testing::TestWithParam<std::tuple<kernels::VectorSize, Kind>> {
protected:
  void SetUp() override { kernels::limit_vectors(std::get<0>(GetParam())); }
  void TearDown() override { kernels::limit_vectors(kernels::VectorSize::pack); }
};

/// Each side goes its own way through the same motion.
TEST_P(LoneContacts, ActAsAmongOthers) {
  const Kind kind = std::get<1>(GetParam());
  for (const int count : {1, 2, 4, 11}) {
    if (kind == Kind::crossing && count > 1) // all are always closed
      continue;
    std::mt19937 random(static_cast<unsigned>(count));
    const auto points = points_of(kind, count, random);
    const Motion motion(count, random);
    Side alone(points), together(points);
    ASSERT_TRUE(alone.contacts.in_lanes);
    kernels::Array q(static_cast<std::size_t>(alone.contacts.padded_modes)), v(q);
    Counts counts, none;
    for (int k = 0; k < 20000; ++k) {
      motion.at(k * h, q, v);
      step(alone, q, v, true, counts);
      step(together, q, v, false, none);
      const double size = points[0].support.normal.stiffness / 1e5;
      const double force = 100.0 * size, energy = 1e-2 * size, tight = 1e-9; // N, J
      ASSERT_EQ(alone.trial.active, together.trial.active) << count << " contacts, step " << k;
      ASSERT_EQ(alone.trial.opened, together.trial.opened);
      ASSERT_EQ(alone.memory.closed(), together.memory.closed());
      EXPECT_NEAR(alone.trial.springs, together.trial.springs, tight * energy);
      EXPECT_NEAR(alone.trial.cut, together.trial.cut, tight * energy);
      EXPECT_NEAR(alone.followed, together.followed, tight * energy);
      EXPECT_NEAR(alone.work, together.work, tight * energy);
      EXPECT_NEAR(alone.jump, together.jump, tight * energy);
      EXPECT_NEAR(alone.losses.damping, together.losses.damping, tight * energy);
      EXPECT_NEAR(alone.losses.friction, together.losses.friction, tight * energy);
      EXPECT_NEAR(alone.memory.spring_energy(), together.memory.spring_energy(), tight * energy);
      for (int i = 0; i < count; ++i) {
        const auto c = static_cast<std::size_t>(i);
        const ContactState &a = alone.trial.states[c], &b = together.trial.states[c];
        EXPECT_NEAR(a.normal_force, b.normal_force, tight * force);
        EXPECT_NEAR(a.friction.t, b.friction.t, tight * force);
        EXPECT_EQ(a.ny, b.ny);
        EXPECT_EQ(a.nz, b.nz);
        EXPECT_NEAR(a.displacement.t, b.displacement.t, tight * 1e-4);
        EXPECT_NEAR(a.slid, b.slid, tight * 1e-4);
        EXPECT_NEAR(a.friction_work, b.friction_work, tight * energy);
        EXPECT_NEAR(a.damper_work, b.damper_work, tight * energy);
        EXPECT_NEAR(a.approach, b.approach, tight);
        EXPECT_NEAR(a.pressing_share, b.pressing_share, tight);
        EXPECT_NEAR(a.instant_share, b.instant_share, tight);
        EXPECT_EQ(a.slides, b.slides);
        const int l = kernels::lane(i);
        const kernels::MemoryNumbers &m = alone.memory.lanes()[i], &n = together.memory.lanes()[i];
        EXPECT_NEAR(m.spring[l], n.spring[l], tight * force);
        EXPECT_NEAR(m.left[l], n.left[l], 1e-12);
        EXPECT_EQ(m.sliding[l], n.sliding[l]);
        EXPECT_NEAR(m.force[l], n.force[l], tight * force);
      }
      const auto &some = alone.memory.lanes().places, &same = together.memory.lanes().places;
      EXPECT_TRUE(std::equal(some.begin(), some.end(), same.begin(), same.end()));
      ASSERT_FALSE(testing::Test::HasFailure()) << count << " contacts, step " << k;
    }
    if (kind == Kind::coupled) {
      EXPECT_GT(counts.refused, 100) << count << " contacts";
      continue;
    }
    EXPECT_GT(counts.lone, 100) << count << " contacts";
    if (kind == Kind::crossing) {
      EXPECT_GT(counts.crossed, 50);
      continue;
    }
    EXPECT_GT(counts.closes, 5) << count << " contacts";
    if (kind == Kind::damped) { // others open out of reach, where no contact is near
      EXPECT_GT(counts.opens, 5) << count << " contacts";
      EXPECT_GT(counts.held_open, 5) << count << " contacts";
    }
    if (kind != Kind::smooth && kind != Kind::along_nothing) {
      EXPECT_GT(counts.slides, 5) << count << " contacts";
      EXPECT_GT(counts.sticks, 5) << count << " contacts";
      EXPECT_TRUE(count == 1 || count == 4 || counts.beside > 5) << count << " contacts"; // 4: one place
    }
    if (kind == Kind::touching) {
      EXPECT_GT(counts.begun, 5) << count << " contacts";
    }
    if (kind == Kind::ending || kind == Kind::ending_damped) {
      EXPECT_GT(counts.ended, 5) << count << " contacts";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    InVectors, LoneContacts,
    testing::Combine(testing::Values(kernels::VectorSize::pair, kernels::VectorSize::half,
                                     kernels::VectorSize::pack),
                     testing::Values(Kind::undamped, Kind::damped, Kind::dissipating, Kind::coupled,
                                     Kind::ending, Kind::ending_damped, Kind::touching, Kind::crossing,
                                     Kind::smooth, Kind::along_nothing)));

/// In vectors of 4 doubles as in those of 8.
TEST(LoneContact, GivesTheSameBytesInHalfVectors) {
  using kernels::VectorSize;
  if (kernels::limit_vectors(VectorSize::pack) != VectorSize::pack)
    GTEST_SKIP() << "a processor without vectors of 8 doubles";
  for (const Kind kind : {Kind::undamped, Kind::damped, Kind::dissipating, Kind::ending, Kind::crossing})
    for (const int count : {1, 2, 4, 11}) {
      if (kind == Kind::crossing && count > 1)
        continue;
      std::vector<double> results[2];
      for (const bool half : {false, true}) {
        kernels::limit_vectors(half ? VectorSize::half : VectorSize::pack);
        std::mt19937 random(static_cast<unsigned>(count));
        Side side(points_of(kind, count, random));
        const Motion motion(count, random);
        kernels::Array q(static_cast<std::size_t>(side.contacts.padded_modes)), v(q);
        Counts counts;
        for (int k = 0; k < 3000; ++k) {
          motion.at(k * h, q, v);
          step(side, q, v, true, counts);
          for (const int c : side.trial.active) {
            const ContactState& s = side.trial.states[static_cast<std::size_t>(c)];
            for (const double x : {s.normal_force, s.friction.t, s.displacement.t, s.slid, s.friction_work,
                                   s.damper_work, s.approach, s.instant_share})
              results[half].push_back(x);
          }
          for (const double x : {side.losses.damping, side.losses.friction, side.memory.spring_energy()})
            results[half].push_back(x);
        }
        EXPECT_GT(counts.lone, 50);
      }
      kernels::limit_vectors(VectorSize::pack);
      EXPECT_EQ(results[0], results[1]) << count << " contacts";
    }
}

} // namespace
} // namespace fretwork::transient
