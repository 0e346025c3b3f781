// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/weight.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace weight_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double round_off = 1e-12; // relative, of sums over a few elements
constexpr double pi = std::numbers::pi, outer = 0.02, wall = 0.001, bore = outer - 2.0 * wall;
const double bore_area = pi / 4.0 * bore * bore, displaced = pi / 4.0 * outer * outer;
const Vec3 gravity(0.0, 0.3, -9.81);

fem::BeamProperty tube_in(double inside, double outside, double confinement) {
  fem::BeamProperty property{{2e11, 0.3, 8000.0}, fem::pipe_section(outer, wall)};
  property.fluid = {inside, outside, confinement};
  return property;
}

/// Of all nodes, N.
Vec3 resultant(const Eigen::VectorXd& forces) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index row = 0; row < forces.size(); row += 6)
    sum += forces.segment<3>(row);
  return sum;
}

fem::Model line_of(const fem::BeamProperty& property, const Vec3& end) {
  ModelBuilder b;
  b.line(Vec3::Zero(), end, 4, b.property(property));
  return b.model;
}

} // namespace

TEST(Weight, IsThatOfTubeAndInnerFluidLessTheDisplacedOne) {
  for (const Vec3& end : {Vec3(2.0, 0.0, 0.0), Vec3(0.0, 0.0, 2.0), Vec3(1.2, 0.0, 1.6)}) {
    const Vec3 found = resultant(fem::weight(line_of(tube_in(900.0, 1000.0, 2.3), end), gravity));
    const double mass = 8000.0 * (displaced - bore_area) + 900.0 * bore_area - 1000.0 * displaced;
    EXPECT_LT((found - 2.0 * mass * gravity).norm(), round_off * 2.0 * mass * gravity.norm())
        << "hydrodynamic mass has no weight, whatever the confinement and the axis";
  }
}

TEST(Weight, OfAnElementIsALineForce) {
  const fem::BeamProperty wet = tube_in(900.0, 1000.0, 2.3);
  fem::BeamProperty solid = tube_in(0.0, 0.0, 1.0);
  const fem::Model in_water = line_of(wet, {2.0, 0.0, 0.0}), in_air = line_of(solid, {2.0, 0.0, 0.0});
  const std::vector<Index> beams{0, 1, 2, 3};
  const double extra = 900.0 * bore_area - 1000.0 * displaced;
  const Eigen::VectorXd expected =
      fem::weight(in_air, gravity) + fem::line_forces(in_water, beams, extra * gravity);
  EXPECT_LT((fem::weight(in_water, gravity) - expected).norm(), round_off * expected.norm());
}

TEST(Weight, OfBeamsAddsUp) {
  ModelBuilder b;
  const auto wet = b.property(tube_in(900.0, 1000.0, 2.3)), dry = b.property(tube_in(0.0, 0.0, 1.0));
  b.line({0, 0, 0}, {0.0, 0.0, 2.0}, 2, wet);
  b.line({1, 0, 0}, {1.0, 2.0, 0.0}, 1, dry);
  b.model.beams[1].middle = Vec3(0.1, 0.0, 1.5); // an arc
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(b.model.nodes.size()));
  for (const fem::Beam& beam : b.model.beams) {
    const fem::Vector12 of = fem::weight(b.model, beam, gravity);
    sum.segment<6>(6 * Eigen::Index{beam.a}) += of.head<6>();
    sum.segment<6>(6 * Eigen::Index{beam.b}) += of.tail<6>();
  }
  EXPECT_LT((sum - fem::weight(b.model, gravity)).norm(), round_off * sum.norm());
}

TEST(Weight, InAirIsMassTimesGravity) {
  ModelBuilder b;
  fem::BeamProperty property = tube_in(0.0, 0.0, 1.0);
  property.added_mass = 0.4;
  const auto nodes = b.line({0, 0, 0}, {0.5, 1.0, 1.0}, 3, b.property(property));
  b.model.masses.push_back({nodes[1], 2.0, Vec3(0.1, 0.2, 0.3), Vec3(0.0, 0.1, 0.0)});
  const Eigen::VectorXd before = fem::mass_times(b.model, fem::translation_field(b.model, gravity));
  EXPECT_EQ(fem::weight(b.model, gravity), before) << "bit for bit";
}

TEST(Weight, FollowsAFluidThatChangesAlongTheBeams) {
  fem::BeamProperty property = tube_in(0.0, 500.0, 1.4);
  property.taper = fem::Taper{property.section, 0.0, {800.0, 1000.0, 1.4}};
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {2.0, 0, 0}, 4, b.property(property));
  for (std::size_t i = 0; i < 4; ++i)
    b.model.beams[i].along = {0.25 * static_cast<double>(i), 0.25 * static_cast<double>(i + 1)};
  const double mass = 8000.0 * (displaced - bore_area) + 400.0 * bore_area - 750.0 * displaced;
  const Vec3 found = resultant(fem::weight(b.model, gravity));
  EXPECT_LT((found - 2.0 * mass * gravity).norm(), round_off * 2.0 * std::abs(mass) * gravity.norm());
}

TEST(Weight, OfABendIsItsLengthTimesTheWeightPerLength) {
  constexpr double of_quadrature = 1e-9; // 8 points on arcs of 1/12 of a turn
  ModelBuilder b;
  const Index first = b.node({-0.3, 0, 0});
  b.arcs_from(first, Vec3::Zero(), {-0.3, 0, 0}, {0, 0, 0.3}, 0.0, pi, 6,
              b.property(tube_in(900.0, 1000.0, 2.3)));
  const double mass = 8000.0 * (displaced - bore_area) + 900.0 * bore_area - 1000.0 * displaced;
  const Vec3 expected = 0.3 * pi * mass * gravity;
  EXPECT_LT((resultant(fem::weight(b.model, gravity)) - expected).norm(), of_quadrature * expected.norm());
}

} // namespace weight_test
