// SPDX-License-Identifier: GPL-3.0-or-later
// No number of the program has a hidden unit: a scene in other units of length, mass and time gives the same
// results in those units, to the last bit where the units differ by powers of two.
#include "contact/profile.hpp"
#include "scenes.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace scaling_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using namespace fretwork::vibration;
using contact::FrictionMemoryKind;
using contact::PlaneAxis;

namespace {

/// What one metre, kilogram and second are in the other units.
struct Units {
  double length, mass, time;
  [[nodiscard]] double speed() const { return length / time; }
  [[nodiscard]] double force() const { return mass * length / (time * time); }
  [[nodiscard]] double energy() const { return force() * length; }
  [[nodiscard]] double coordinate() const { return std::sqrt(mass) * length; } ///< q, modes of unit mass
};

contact::Obstacle in_units(const contact::Obstacle& obstacle, double length) {
  struct Visitor {
    double l;
    contact::Obstacle operator()(const contact::Circle& o) const { return contact::Circle{l * o.gap}; }
    contact::Obstacle operator()(const contact::PlanePair& o) const {
      return contact::PlanePair{l * o.gap, o.axis};
    }
    contact::Obstacle operator()(const contact::Stop& o) const { return contact::Stop{l * o.gap, o.axis}; }
    contact::Obstacle operator()(const contact::RoundPair& o) const {
      return contact::RoundPair{l * o.distance};
    }
    contact::Obstacle operator()(const contact::FacingPlanes& o) const {
      return contact::FacingPlanes{l * o.distance, o.axis, o.side};
    }
    contact::Obstacle operator()(const contact::Ellipse& o) const {
      return contact::Ellipse{l * o.semi_y, l * o.semi_z, l * o.radius};
    }
    contact::Obstacle operator()(const contact::BroachedSpace& o) const {
      contact::BroachedHole hole = o.hole();
      hole.land_radius *= l, hole.lobe_radius *= l;
      return contact::BroachedSpace(l * o.tube_radius(), hole);
    }
    contact::Obstacle operator()(const contact::Profile& o) const {
      std::vector<contact::PolarPoint> points;
      for (const auto& vertex : o.vertices()) {
        const double angle = std::atan2(vertex.z, vertex.y);
        points.push_back(
            {angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle, l * std::hypot(vertex.y, vertex.z)});
      }
      return contact::Profile(points);
    }
  };
  return std::visit(Visitor{length}, obstacle);
}

TimeFunction in_units(const TimeFunction& function, double time) {
  struct Visitor {
    double t;
    TimeFunction operator()(const Constant& f) const { return f; }
    TimeFunction operator()(Harmonic f) const {
      f.frequency /= t;
      return f;
    }
    TimeFunction operator()(Table f) const {
      for (double& instant : f.time)
        instant *= t;
      return f;
    }
    TimeFunction operator()(Random f) const {
      f.low /= t;
      f.high /= t;
      return f;
    }
    TimeFunction operator()(const Integral&) const {
      throw std::logic_error("no scene of these tests follows an integral");
    }
  };
  return std::visit(Visitor{time}, function);
}

Scene in_units(const Scene& scene, const Units& to) {
  Scene s = scene;
  s.system.stiffness /= to.time * to.time;
  s.system.damping /= to.time;
  s.system.damping_matrix /= to.time;
  s.q0 *= to.coordinate();
  s.v0 *= to.coordinate() / to.time;
  s.duration *= to.time;
  for (Load& load : s.loads) {
    load.function = in_units(load.function, to.time);
    load.modal_force *= to.coordinate() / (to.time * to.time);
  }
  for (ContactPoint& point : s.contacts) {
    contact::Support& support = point.support;
    support.obstacle = in_units(support.obstacle, to.length);
    support.normal.stiffness *= to.mass / (to.time * to.time);
    support.normal.damping *= to.mass / to.time;
    support.normal.dissipation /= to.speed();
    support.friction.stiffness *= to.mass / (to.time * to.time);
    support.friction.damping *= to.mass / to.time;
    point.rest *= to.length;
    point.b /= std::sqrt(to.mass);
  }
  return s;
}

StepOptions in_units(StepOptions options, const Units& to) {
  if (options.step)
    *options.step *= to.time;
  return options;
}

/// Passes where a, in units 1/`unit` of b's, is b within `tolerance` of b's largest value (0: bit for bit).
testing::AssertionResult same(const char* what, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                              double unit, double tolerance) {
  const double largest = b.size() > 0 ? b.cwiseAbs().maxCoeff() : 0.0;
  const double apart = b.size() > 0 ? (a / unit - b).cwiseAbs().maxCoeff() : 0.0;
  if (apart <= tolerance * largest)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << what << " differ by " << apart / largest << " of the largest";
}

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

void expect_same_statistics(const post::ContactSummary& a, const post::ContactSummary& b, const Units& to,
                            double tolerance) {
  const auto numbers = [](const post::ContactSummary& s) {
    return vector({static_cast<double>(s.impacts), s.contact_time_ratio, s.sticking_ratio});
  };
  const auto forces = [](const post::ContactSummary& s) {
    return vector({s.normal_mean, s.normal_rms, s.normal_max, s.normal_in_contact_mean,
                   s.normal_in_contact_rms, s.tangential_rms, s.tangential_max});
  };
  const auto lengths = [](const post::ContactSummary& s) {
    return vector({s.y.mean, s.y.std, s.y.min, s.y.max, s.z.mean, s.z.std, s.z.min, s.z.max, s.radial_rms,
                   s.radial_max, s.sliding_distance});
  };
  const auto powers = [](const post::ContactSummary& s) { return vector({s.work_rate, s.friction_power}); };
  const auto speeds = [](const post::ContactSummary& s) {
    return vector(
        {s.impact_velocity_mean, s.impact_velocity_max, s.departure_velocity_mean, s.departure_velocity_max});
  };
  const auto impulse = [](const post::ContactSummary& s) { return vector({s.impulse}); };
  const auto losses = [](const post::ContactSummary& s) { return vector({s.damping_work, s.friction_work}); };
  const auto times = [](const post::ContactSummary& s) {
    return vector({s.contact_duration_mean, s.contact_duration_max});
  };
  EXPECT_TRUE(same("counts", numbers(a), numbers(b), 1.0, tolerance));
  EXPECT_TRUE(same("forces of the statistics", forces(a), forces(b), to.force(), tolerance));
  EXPECT_TRUE(same("displacements of the statistics", lengths(a), lengths(b), to.length, tolerance));
  EXPECT_TRUE(same("powers", powers(a), powers(b), to.energy() / to.time, tolerance));
  EXPECT_TRUE(same("impact speeds", speeds(a), speeds(b), to.speed(), tolerance));
  EXPECT_TRUE(same("impulses", impulse(a), impulse(b), to.force() * to.time, tolerance));
  EXPECT_TRUE(same("losses", losses(a), losses(b), to.energy(), tolerance));
  EXPECT_TRUE(same("durations", times(a), times(b), to.time, tolerance));
}

void expect_same(const History& a, const History& b, const Units& to, double tolerance) {
  ASSERT_EQ(a.choice.steps, b.choice.steps);
  EXPECT_EQ(a.choice.scheme, b.choice.scheme);
  EXPECT_EQ(a.choice.warnings.size(), b.choice.warnings.size());
  EXPECT_EQ(a.report.counts.unconverged, b.report.counts.unconverged);
  const auto rates = [](const StepChoice& c) {
    return vector({c.contact_frequency, c.stick_frequency, c.damper_rate, c.explicit_rate, c.highest_mode,
                   c.excitation, 1.0 / c.step});
  };
  EXPECT_TRUE(same("rates of the step rule", rates(a.choice), rates(b.choice), 1.0 / to.time, tolerance));
  EXPECT_TRUE(same("instants", a.time, b.time, to.time, tolerance));
  EXPECT_TRUE(same("displacements", a.q, b.q, to.coordinate(), tolerance));
  EXPECT_TRUE(same("velocities", a.v, b.v, to.coordinate() / to.time, tolerance));
  EXPECT_TRUE(same("normal forces", a.normal, b.normal, to.force(), tolerance));
  EXPECT_TRUE(same("friction along x", a.along_x, b.along_x, to.force(), tolerance));
  EXPECT_TRUE(same("friction along t", a.along_t, b.along_t, to.force(), tolerance));
  const auto energies = [](const Energy& e) {
    return vector(
        {e.initial, e.load_work, e.stored, e.modal_damping, e.contact_damping, e.friction, e.scale});
  };
  EXPECT_TRUE(same("energies", energies(a.report.energy), energies(b.report.energy), to.energy(), tolerance));
  // a small difference of those: to the tolerance of their size
  EXPECT_NEAR(a.report.residual_relative, b.report.residual_relative, tolerance);
  for (std::size_t c = 0; c < b.statistics.size(); ++c)
    expect_same_statistics(a.statistics[c], b.statistics[c], to, tolerance);
}

/// Six corners, none on an axis.
contact::Profile hexagon(double radius) {
  std::vector<contact::PolarPoint> points;
  for (int i = 0; i < 6; ++i)
    points.push_back({0.2 + i * std::numbers::pi / 3.0, radius * (1.0 + 0.1 * i)});
  return contact::Profile(points);
}

/// Every kind of obstacle, damper, friction memory, load and mode: rattling, with more kinds.
Scene everything() {
  constexpr double duration = 0.25, gap = 1e-4;
  constexpr int contacts = 8, modes = 12;
  Scene s = rattling(contacts, modes, duration);
  s.system.stiffness(10) = 0.0; // a rigid mode ...
  s.system.damping(10) = 0.0;
  s.system.damping(11) *= 300.0; // ... and an overdamped one
  s.contacts[4].support.obstacle = contact::RoundPair{1e-3};
  s.contacts[4].rest = Vec3(0.0, 1e-3 + gap, 0.0);
  s.contacts[5].support.obstacle = contact::FacingPlanes{2e-3, PlaneAxis::z, -1.0};
  s.contacts[5].rest = Vec3(0.0, 0.0, -2e-3 - gap);
  s.contacts[6].support.obstacle = hexagon(2.0 * gap);
  s.contacts[6].support.friction.kind = FrictionMemoryKind::reference;
  s.contacts[7].support.obstacle = contact::Circle{gap};
  s.contacts[7].support.normal = {2e5, 0.0, 0.5};
  s.contacts[0].support.friction.kind = FrictionMemoryKind::reference;
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(modes);
  s.loads.push_back({Table{{0.0, 0.1, 0.1, 0.2}, {0.0, 2.0, -1.0, 0.5}}, all});
  s.loads.push_back({Random{2.0, 10.0, 100.0, 3}, all});
  s.v0 = 0.02 * all;
  return s;
}

void expect_all_met(const History& run) {
  EXPECT_EQ(run.report.outcome, Outcome::done);
  for (std::size_t c = 0; c < run.statistics.size(); ++c) {
    EXPECT_GT(run.statistics[c].impacts, 0) << "contact " << c;
    EXPECT_EQ(run.statistics[c].friction_power > 0.0, c != 4) << "contact " << c; // which has no friction
  }
}

/// Powers of two; of four for the mass, whose square root scales the coordinates.
constexpr Units exact[] = {{1024.0, 1.0, 1.0},
                           {1.0, 0x1p-20, 1.0},
                           {1.0, 1.0, 4096.0},
                           {0x1p-20, 0x1p+12, 0x1p-10},
                           {0x1p+30, 0x1p-30, 0x1p+20}};
constexpr Units millimetres_and_tonnes{1e3, 1e-3, 1.0};

const StepOptions schemes[] = {splitting(), euler(), splitting(2e-5), euler(1e-5)};

} // namespace

TEST(Units, ThatDifferByPowersOfTwoGiveTheSameBytes) {
  // in_units(..., {1, 1, 1}): the corners of the profile make the same way through polar points
  const Scene scene = everything(), same_way = in_units(scene, {1.0, 1.0, 1.0});
  constexpr double every = 1e-3, from = 0.05;
  for (const StepOptions& options : schemes) {
    const History run = simulate(same_way, options, every, from);
    expect_all_met(run);
    for (const Units& to : exact) {
      SCOPED_TRACE(testing::Message() << to.length << " " << to.mass << " " << to.time);
      expect_same(simulate(in_units(scene, to), in_units(options, to), every * to.time, from * to.time), run,
                  to, 0.0);
    }
  }
}

TEST(Units, OfMillimetresAndTonnesGiveTheSameImpact) {
  // round-off grown by one impact; with splitting it may let an interval be cut once more or less where the contact opens
  constexpr double one_impact = 3e-5;
  for (const FrictionMemoryKind kind : {FrictionMemoryKind::return_map, FrictionMemoryKind::reference}) {
    Scene scene = mass_point(1.0, Vec3(50.0, 2e3, 1e3), 0.007);
    start(scene, 1.0, Vec3(0, 0.9e-3, 0.2e-3), Vec3(0.05, 0.2, 0.15));
    contact::FrictionLaw law{5e5, 200.0, 0.4, 0.3};
    law.kind = kind;
    scene.contacts = {contact_of(1.0, {contact::Circle{1e-3}, {1e6, 100.0}, law})};
    for (const StepOptions& options : schemes) {
      const History run = simulate(scene, options, 1e-3);
      EXPECT_EQ(run.statistics[0].impacts, 1);
      EXPECT_GT(run.statistics[0].friction_power, 0.0);
      expect_same(simulate(in_units(scene, millimetres_and_tonnes), options, 1e-3), run,
                  millimetres_and_tonnes, one_impact);
    }
  }
}

} // namespace scaling_test
