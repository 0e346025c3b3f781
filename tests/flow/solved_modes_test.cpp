// SPDX-License-Identifier: GPL-3.0-or-later
// From a dry tube and its flow to wet modes, damping and stability.
#include "../modal/solve.hpp"
#include "flow/damping.hpp"
#include "flow/element_fluid.hpp"
#include "flow/stability.hpp"
#include "hand_made.hpp"

namespace fretwork::flow::solved_modes_test {
namespace {

using tests::ModelBuilder;
using tests::pi;

/// Gives each beam of a tube a property of its own, with its fluid.
void fill(fem::Model& model, const TubeFluid& fluid) {
  for (const ElementFluid& element : fluid.elements) {
    fem::Beam& beam = model.beams[static_cast<std::size_t>(element.beam)];
    fem::BeamProperty wet = model.properties[static_cast<std::size_t>(beam.property)];
    wet.fluid = element.fluid;
    beam.property = static_cast<Index>(model.properties.size());
    model.properties.push_back(wet);
  }
}

std::vector<Index> all_beams(const fem::Model& model) {
  std::vector<Index> out(model.beams.size());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

Zone water(double length) {
  Zone zone = tests::liquid_zone("water", 0.0, length, 740.0, 1.5);
  zone.inner_density = tests::constant(700.0);
  zone.bundle = {Arrangement::square, 1.44 * 0.01905};
  return zone;
}

TEST(SolvedModes, OfAPinnedTubeInUniformFlowHaveTheClosedFormula) {
  constexpr int elements = 80;
  constexpr double of_mesh = 2e-7; // relative: (3 pi/80)^4/1440 of the third frequency
  ModelBuilder builder;
  const Index number = builder.property(tests::tube_property());
  const auto nodes = builder.line({0, 0, 0}, {0, 0, 1}, elements, number);
  builder.fix_everywhere(tests::uy | tests::uz | tests::rx | tests::rz);
  builder.fix(nodes.front(), tests::ux);
  builder.fix(nodes.back(), tests::ux);
  const std::vector<Index> beams = all_beams(builder.model);
  const Profile profile({water(1.0)}, 1.0);
  fill(builder.model, fluid_of_elements(Tube(builder.model, beams, nodes.front(), "T1"), profile));
  const Tube tube(builder.model, beams, nodes.front(), "T1");
  const Sampling sampling = sample(tube, profile, tests::solve(builder.model, 3));
  const double d = 0.01905, di = d - 2 * 0.00109, q = (1.07 + 0.56 * 1.44) * 1.44,
               mass = pi / 4.0 *
                      (8000.0 * (d * d - di * di) + 700.0 * di * di +
                       740.0 * d * d * (q * q + 1.0) / (q * q - 1.0));
  EXPECT_NEAR(tube.at(0.5).mass, mass, 1e-12 * mass);
  EXPECT_LT((transverse_share(sampling) - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 1e-10)
      << "M-orthonormal modes across the tube";
  const Damping damped = damping(tube, profile, sampling, {});
  const Stability found = stability(profile, sampling, damped.stability());
  for (Eigen::Index n = 0; n < 3; ++n) {
    const double wave = static_cast<double>(n + 1) * pi,
                 f = wave * wave / (2.0 * pi) * std::sqrt(2e11 * tests::tube_property().section.iy / mass);
    const double xi = std::max(
        0.006, viscous_damping(740.0 * d * d / mass, stokes_number(f, d, 1.23e-7), viscous_confinement(q)));
    const double delta = 2.0 * pi * xi / std::sqrt(1.0 - xi * xi);
    const double closed = 2.8544 * f * d * std::sqrt(mass * delta / (740.0 * d * d));
    EXPECT_NEAR(sampling.frequency(n), f, of_mesh * f);
    EXPECT_NEAR(found.cases[0].critical_velocity(n), closed, of_mesh * closed);
  }
}

/// The tube of case SDNL112 in water.
TEST(SolvedModes, OfAUTubeMoveNoMoreThanTheirMass) {
  ModelBuilder builder;
  const Index number = builder.property({{2.02e11, 0.3, 8330.0}, fem::pipe_section(0.02222, 0.00127)});
  constexpr double leg = 0.2504, radius = 0.412947;
  auto nodes = builder.line({-radius, 0, 0}, {-radius, 0, leg}, 10, number);
  const Index foot = nodes.front();
  nodes = builder.arcs_from(nodes.back(), {0, 0, leg}, {-radius, 0, 0}, {0, 0, radius}, 0.0, pi, 24, number);
  nodes = builder.line_from(nodes.back(), {radius, 0, 0}, 10, number);
  builder.fix(foot, tests::all);
  builder.fix(nodes.back(), tests::all);
  const std::vector<Index> beams = all_beams(builder.model);
  const double length = Tube(builder.model, beams, foot, "T1").length();
  Zone zone = water(length);
  zone.bundle.pitch = 1.44 * 0.02222;
  zone.velocity = VectorVelocity{Table<Vec3>::constant({0, 0, 1.0})};
  const Profile profile({zone}, length);
  fill(builder.model, fluid_of_elements(Tube(builder.model, beams, foot, "T1"), profile));
  const Tube tube(builder.model, beams, foot, "T1");
  const Sampling sampling = sample(tube, profile, tests::solve(builder.model, 6));
  const Eigen::VectorXd share = transverse_share(sampling);
  const Stability lift = stability(profile, sampling, Eigen::VectorXd::Constant(6, 0.01),
                                   {Component::Kind::lift}),
                  drag = stability(profile, sampling, Eigen::VectorXd::Constant(6, 0.01),
                                   {Component::Kind::drag}),
                  both = stability(profile, sampling, Eigen::VectorXd::Constant(6, 0.01));
  constexpr double rounding = 1e-12;
  constexpr double of_torsion =
      2e-3;                     // of the mass: sections that turn about their axis, some (D/(2 R))^2 = 7e-4
  constexpr double none = 1e-6; // of R: what round-off leaves of the motion in the other direction
  int out_of_plane = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double along_lift = lift.cases[0].ratio(i), along_drag = drag.cases[0].ratio(i);
    EXPECT_NEAR(along_lift * along_lift + along_drag * along_drag, std::pow(both.cases[0].ratio(i), 2),
                rounding);
    EXPECT_LT(std::min(along_lift, along_drag), none) << "in the plane or out of it";
    EXPECT_LT(share(i), 1.0 + rounding);
    EXPECT_GT(share(i), along_drag < none ? 1.0 - of_torsion : 0.5) << "the rest moves along the axis";
    out_of_plane += along_drag < none;
  }
  EXPECT_EQ(out_of_plane, 3) << "every second one, as published for this tube";
  EXPECT_LT(share(1), 0.9) << "sway in the plane moves the bend along its axis";
}

} // namespace
} // namespace fretwork::flow::solved_modes_test
