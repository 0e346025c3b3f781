// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts between two nodes: action and reaction, sides that are kept, nodes at one place, overlap, a second
// node that does not move.
#include "scenes.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace two_node_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::Circle;
using contact::FacingPlanes;
using contact::FrictionLaw;
using contact::PlaneAxis;
using contact::RoundPair;

namespace {

constexpr double first_mass = 2.0, second_mass = 3.0;
/// Sums of momenta over thousands of steps.
constexpr double round_off = 1e-12;

const FrictionLaw rough{5e5, 200.0, 0.4, 0.3};
const StepOptions schemes[] = {splitting(1e-5), euler(1e-5), collocation(1e-5)};

/// Modes 0 to 2 move the first mass, 3 to 5 the second. `apart`: the first from the second at q = 0.
Scene two_masses(const contact::Support& support, const Vec3& apart, double duration) {
  Scene s;
  s.system.stiffness = s.system.damping = Eigen::VectorXd::Zero(6);
  s.q0 = s.v0 = Eigen::VectorXd::Zero(6);
  s.duration = duration;
  ContactPoint point{"contact", support, apart, Eigen::MatrixXd(3, 6)};
  point.b << Eigen::Matrix3d::Identity() / std::sqrt(first_mass),
      -Eigen::Matrix3d::Identity() / std::sqrt(second_mass);
  s.contacts = {point};
  return s;
}

void throw_at(Scene& scene, const Vec3& first, const Vec3& second) {
  scene.v0 << std::sqrt(first_mass) * first, std::sqrt(second_mass) * second;
}

Vec3 of_first(const Eigen::VectorXd& q) { return q.head<3>() / std::sqrt(first_mass); }
Vec3 of_second(const Eigen::VectorXd& q) { return q.tail<3>() / std::sqrt(second_mass); }
Vec3 momentum(const Eigen::VectorXd& v) { return first_mass * of_first(v) + second_mass * of_second(v); }

/// About the second node's place at q = 0, along x_loc: what forces along the line of centres cannot change.
double spin(const Vec3& apart, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  return first_mass * (apart + of_first(q)).cross(of_first(v)).x() +
         second_mass * of_second(q).cross(of_second(v)).x();
}

/// Three pairs of bodies that meet obliquely: two round ones, one in the other's ring, two flat ones.
struct Meeting {
  contact::Obstacle obstacle;
  Vec3 apart, approach; ///< m; m/s, of the first
};
const Meeting meetings[] = {
    {RoundPair{0.01}, Vec3(0, 0.0105, 0.002), Vec3(0.1, -0.4, 0.1)},
    {Circle{1e-3}, Vec3(0, 0.8e-3, 0.2e-3), Vec3(0.1, 0.3, 0.2)},
    {FacingPlanes{0.01, PlaneAxis::z, 1.0}, Vec3(0, 0, 0.0105), Vec3(0.1, 0.3, -0.4)},
    {FacingPlanes{0.01, PlaneAxis::y, -1.0}, Vec3(0, -0.0105, 0), Vec3(0.1, 0.4, 0.3)}};

History run_meeting(const Meeting& meeting, const FrictionLaw& friction, double damping,
                    const StepOptions& options) {
  Scene s = two_masses({meeting.obstacle, {1e6, damping}, friction}, meeting.apart, 0.01);
  throw_at(s, meeting.approach, Vec3(0, 0.05, 0.02));
  return simulate(s, options, 1e-4);
}

double apart_at_most(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

} // namespace

TEST(TwoNodes, KeepTheirMomentumWhateverTheContactDoes) {
  for (const StepOptions& options : schemes)
    for (const Meeting& meeting : meetings) {
      const History run = run_meeting(meeting, rough, 100.0, options);
      const Vec3 before = momentum(run.v.col(0));
      EXPECT_GT(run.statistics[0].impacts, 0);
      EXPECT_GT(run.report.energy.friction, 0.0);
      EXPECT_GT((of_first(run.v.rightCols<1>()) - meeting.approach).norm(), 0.1); // they do push each other
      for (Eigen::Index j = 0; j < run.time.size(); ++j)
        EXPECT_LT((momentum(run.v.col(j)) - before).norm(), round_off * before.norm())
            << "at " << run.time(j);
    }
}

TEST(TwoNodes, WithoutFrictionKeepTheirSpin) {
  // round bodies push along the line of centres; outputs between steps are interpolated: the last record's are not
  for (const StepOptions& options : schemes)
    for (const Meeting& meeting : {meetings[0], meetings[1]}) {
      const History run = run_meeting(meeting, {}, 100.0, options);
      const Eigen::Index last = run.time.size() - 1;
      const double before = spin(meeting.apart, run.q.col(0), run.v.col(0));
      EXPECT_GT(run.statistics[0].impacts, 0);
      EXPECT_EQ(run.normal(0, last), 0.0); // apart again: the interpolation is free flight
      // splitting pushes along the normal in the middle of an interval: of order 2
      const double tolerance = run.choice.scheme == SchemeKind::splitting ? 1e-6 : round_off;
      EXPECT_NEAR(spin(meeting.apart, run.q.col(last), run.v.col(last)) / before, 1.0, tolerance);
    }
}

TEST(TwoNodes, AtOnePlaceGiveFiniteForces) {
  for (const StepOptions& options : schemes)
    for (const contact::Obstacle& obstacle :
         {contact::Obstacle(RoundPair{1e-3}), contact::Obstacle(Circle{1e-3}), contact::Obstacle(Circle{0.0}),
          contact::Obstacle(FacingPlanes{1e-3, PlaneAxis::y, 1.0}),
          contact::Obstacle(FacingPlanes{0.0, PlaneAxis::z, -1.0})})
      for (const Vec3& speed : {Vec3(0, 0, 0), Vec3(0, 0.1, 0), Vec3(0.1, 0, 0)}) {
        Scene s = two_masses({obstacle, {1e6, 100.0}, rough}, Vec3::Zero(), 0.005);
        throw_at(s, speed, Vec3::Zero());
        const History run = simulate(s, options, 1e-4);
        EXPECT_EQ(run.report.outcome, Outcome::done);
        EXPECT_TRUE(run.q.allFinite() && run.v.allFinite() && run.normal.allFinite() &&
                    run.along_t.allFinite() && run.along_x.allFinite());
      }
}

TEST(OneNode, AtTheCentreOfItsHoleGivesFiniteForces) {
  for (const StepOptions& options : schemes)
    for (const double gap : {0.0, 1e-3})
      for (const Vec3& speed : {Vec3(0, 0, 0), Vec3(0, 0.1, 0)}) {
        Scene s = mass_point(1.0, Vec3(1e3, 1e3, 1e3), 0.005);
        start(s, 1.0, Vec3::Zero(), speed);
        s.contacts = {contact_of(1.0, {Circle{gap}, {1e6, 100.0}, rough})};
        const History run = simulate(s, options, 1e-4);
        EXPECT_EQ(run.report.outcome, Outcome::done);
        EXPECT_TRUE(run.q.allFinite() && run.v.allFinite() && run.normal.allFinite());
        EXPECT_EQ(run.q.cwiseAbs().maxCoeff() > 0.0,
                  !speed.isZero()); // nothing pushes a tube at rest in the middle
      }
}

TEST(FacingBodies, KeepTheirSideWhenAStepTakesThemThroughEachOther) {
  constexpr double step = 1e-3, speed = 20.0, apart = 1e-3; // 20 mm a step, w_c h = 0.18
  constexpr double of_resolution = 0.02;                    // (w_c h)^2 and the phase of the first touch
  for (const SchemeKind scheme : {SchemeKind::splitting, SchemeKind::euler, SchemeKind::collocation})
    for (const double side : {1.0, -1.0}) {
      Scene s = two_masses({FacingPlanes{5e-3, PlaneAxis::y, side}, {4e4}, {}},
                           Vec3(0, side * (5e-3 + apart), 0), 0.1);
      throw_at(s, Vec3(0, -side * speed, 0), Vec3::Zero());
      const History run = simulate(s, {scheme, step}, step);
      const auto place = [&](Eigen::Index j) {
        return side * (s.contacts[0].rest + of_first(run.q.col(j)) - of_second(run.q.col(j))).y();
      };
      double deepest = 0.0;
      for (Eigen::Index j = 0; j < run.time.size(); ++j)
        deepest = std::min(deepest, place(j));
      EXPECT_LT(deepest, -5e-3); // the first has been right through the second
      const Eigen::Index last = run.time.size() - 1;
      EXPECT_GT(place(last), 5e-3);
      const double after = side * (of_first(run.v.col(last)) - of_second(run.v.col(last))).y();
      EXPECT_NEAR(after / speed, 1.0, of_resolution);
    }
}

TEST(TwoNodes, ThatOverlapAtTheStartArePushedApartByTheStoredEnergy) {
  constexpr double stiffness = 1e6, overlap = 1e-4, second_order = 1e-4, first_order = 1e-2;
  for (const StepOptions& options : schemes)
    for (const auto& [obstacle, apart] :
         {std::pair<contact::Obstacle, Vec3>(RoundPair{0.01}, Vec3(0, 0, 0.01 - overlap)),
          {FacingPlanes{0.01, PlaneAxis::z, 1.0}, Vec3(0, 0, 0.01 - overlap)},
          {Circle{1e-3}, Vec3(0, 0, -1e-3 - overlap)}}) {
      const Scene s = two_masses({obstacle, {stiffness}, {}}, apart, 0.004);
      const History run = simulate(s, options, 1e-4);
      const double energy = 0.5 * stiffness * overlap * overlap;
      EXPECT_EQ(run.report.outcome, Outcome::done);
      // of the overlap's round-off; Euler's energy balance starts h/2 away in the velocity
      EXPECT_NEAR(run.report.energy.initial / energy, 1.0,
                  options.scheme == SchemeKind::euler ? second_order : 1e-10);
      EXPECT_NEAR(run.normal(0, 0) / (stiffness * overlap), 1.0,
                  first_order); // the first record: half a step later
      const Eigen::Index last = run.time.size() - 1;
      const Vec3 leaving = of_first(run.v.col(last)) - of_second(run.v.col(last));
      const double reduced = first_mass * second_mass / (first_mass + second_mass);
      EXPECT_NEAR(leaving.z() / std::sqrt(2.0 * energy / reduced), 1.0,
                  options.scheme == SchemeKind::euler ? first_order : second_order);
    }
}

TEST(TwoNodes, OfWhichTheSecondIsFixedAreAOneNodeContactBitForBit) {
  constexpr double gap = 1e-3;
  const std::pair<contact::Obstacle, Vec3> two[] = {{FacingPlanes{0.0, PlaneAxis::y, -1.0}, Vec3(0, -gap, 0)},
                                                    {Circle{gap}, Vec3::Zero()}};
  const contact::Obstacle one[] = {contact::Stop{gap, PlaneAxis::y}, Circle{gap}};
  for (const StepOptions& options : schemes)
    for (const auto kind : {contact::FrictionMemoryKind::return_map, contact::FrictionMemoryKind::reference})
      for (std::size_t i = 0; i < 2; ++i) {
        FrictionLaw law = rough;
        law.kind = kind;
        Scene single = mass_point(1.0, Vec3(50.0, 2e3, 1e3), 0.1);
        start(single, 1.0, Vec3(0, 0.9e-3, 0.2e-3), Vec3(0.05, 0.2, 0.15));
        Scene pair = single;
        single.contacts = {contact_of(1.0, {one[i], {1e6, 100.0}, law})};
        pair.contacts = {contact_of(1.0, {two[i].first, {1e6, 100.0}, law}, two[i].second)};
        const History a = simulate(single, options, 1e-3), b = simulate(pair, options, 1e-3);
        EXPECT_GT(a.statistics[0].impacts, 1);
        EXPECT_EQ(a.q, b.q);
        EXPECT_EQ(a.v, b.v);
        EXPECT_EQ(a.normal, b.normal);
        EXPECT_EQ(a.along_t, b.along_t);
        EXPECT_EQ(a.report.energy.friction, b.report.energy.friction);
      }
}

TEST(TwoNodes, OfWhichTheSecondIsHugeTendToAOneNodeContact) {
  constexpr double huge = 1e12, one_impact = 1e-9; // the share of the mass, round-off grown by one impact
  for (const StepOptions& options : schemes) {
    Scene single = mass_point(first_mass, Vec3::Zero(), 0.004);
    start(single, first_mass, Vec3(0, 0.9e-3, 0.2e-3), Vec3(0.05, 0.2, 0.15));
    single.contacts = {contact_of(first_mass, {Circle{1e-3}, {1e6, 100.0}, rough})};
    Scene pair = two_masses(single.contacts[0].support, Vec3::Zero(), single.duration);
    pair.contacts[0].b.rightCols<3>() = -Eigen::Matrix3d::Identity() / std::sqrt(huge);
    pair.q0.head<3>() = single.q0;
    pair.v0.head<3>() = single.v0;
    const History a = simulate(single, options, 1e-4), b = simulate(pair, options, 1e-4);
    EXPECT_EQ(a.statistics[0].impacts, 1);
    EXPECT_LT(apart_at_most(b.q.topRows<3>(), a.q), one_impact);
    EXPECT_LT(apart_at_most(b.v.topRows<3>(), a.v), one_impact);
    EXPECT_LT(apart_at_most(b.normal, a.normal), one_impact);
  }
}

TEST(TwoNodes, ExchangedGiveTheSameMotion) {
  // the contact of the second with the first: its local axes turned by half a turn about x_loc
  for (const StepOptions& options : schemes)
    for (const double side : {1.0, -1.0}) {
      const Meeting meeting = side > 0.0 ? meetings[2] : meetings[3];
      Scene s = two_masses({meeting.obstacle, {1e6, 100.0}, rough}, meeting.apart, 0.01);
      throw_at(s, meeting.approach, Vec3(0, 0.05, 0.02));
      Scene exchanged = s;
      ContactPoint& point = exchanged.contacts[0];
      auto& planes = std::get<FacingPlanes>(point.support.obstacle);
      planes.side = -planes.side;
      point.rest = -point.rest;
      point.b = -point.b;
      const History a = simulate(s, options, 1e-4), b = simulate(exchanged, options, 1e-4);
      EXPECT_GT(a.statistics[0].impacts, 0);
      EXPECT_LT(apart_at_most(b.q, a.q), round_off);
      EXPECT_LT(apart_at_most(b.v, a.v), round_off);
      EXPECT_LT(apart_at_most(b.normal, a.normal), round_off);
    }
}

} // namespace two_node_test
