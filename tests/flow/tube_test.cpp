// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "hand_made.hpp"

namespace fretwork::flow::tube_test {
namespace {

using tests::HandMade;
using tests::ModelBuilder;
using tests::pi;

constexpr double round_off = 1e-13; ///< of lengths and sums of order 1

/// A U: a straight leg along z, half a circle of radius 0.5, a leg down again.
struct UTube {
  ModelBuilder builder;
  std::vector<Index> nodes;
  double leg = 1.2, radius = 0.5;

  explicit UTube(int arcs = 8) {
    const Index number = builder.property(tests::tube_property());
    nodes = builder.line({-radius, 0, 0}, {-radius, 0, leg}, 4, number);
    const auto bend = builder.arcs_from(nodes.back(), {0, 0, leg}, -radius * Vec3::UnitX(),
                                        radius * Vec3::UnitZ(), 0.0, pi, arcs, number);
    nodes.insert(nodes.end(), bend.begin() + 1, bend.end());
    const auto down = builder.line_from(nodes.back(), {radius, 0, 0}, 3, number);
    nodes.insert(nodes.end(), down.begin() + 1, down.end());
  }
  [[nodiscard]] std::vector<Index> beams() const {
    std::vector<Index> out(builder.model.beams.size());
    std::iota(out.begin(), out.end(), 0);
    return out;
  }
};

TEST(Tube, HasTheArcLengthOfItsBend) {
  const UTube u;
  const Tube tube(u.builder.model, u.beams(), u.nodes.front(), "T1");
  EXPECT_NEAR(tube.length(), 2.4 + 0.5 * pi, round_off);
  const double top = 1.2 + 0.25 * pi, angle = pi / 6.0;
  EXPECT_LT((tube.at(top).position - Vec3(0, 0, 1.7)).norm(), round_off);
  EXPECT_LT((tube.at(top).tangent - Vec3::UnitX()).norm(), round_off);
  const TubePoint point = tube.at(1.2 + 0.5 * angle);
  EXPECT_LT((point.position - Vec3(-0.5 * std::cos(angle), 0, 1.2 + 0.5 * std::sin(angle))).norm(),
            round_off);
  EXPECT_LT((point.tangent - Vec3(std::sin(angle), 0, std::cos(angle))).norm(), round_off);
  EXPECT_LT((tube.at(tube.length()).position - Vec3(0.5, 0, 0)).norm(), round_off);
  EXPECT_LT((tube.at(tube.length() - 0.1).tangent + Vec3::UnitZ()).norm(), round_off);
}

TEST(Tube, HasTheSizesAndMassOfItsSection) {
  const UTube u;
  const TubePoint point = Tube(u.builder.model, u.beams(), u.nodes.front(), "T1").at(0.7);
  EXPECT_NEAR(point.outer_diameter, 0.01905, round_off);
  EXPECT_NEAR(point.inner_diameter, 0.01905 - 2 * 0.00109, round_off);
  EXPECT_NEAR(point.mass, 8000.0 * pi * 0.00109 * (0.01905 - 0.00109), round_off);
  EXPECT_EQ(point.tube_mass, point.mass);
}

TEST(Tube, CountsFluidAndTaperInItsMass) {
  ModelBuilder builder;
  fem::BeamProperty property = tests::tube_property();
  property.added_mass = 0.3;
  property.taper = fem::Taper{fem::pipe_section(0.02905, 0.00109), 0.5, {}};
  const Index number = builder.property(property);
  const auto nodes = builder.line({0, 0, 0}, {1, 0, 0}, 2, number);
  builder.model.beams[0].along = {0.0, 0.5};
  builder.model.beams[1].along = {0.5, 1.0};
  const std::vector<Index> beams{0, 1};
  const Tube tube(builder.model, beams, nodes.front(), "T1");
  const TubePoint point = tube.at(0.75);
  EXPECT_NEAR(point.outer_diameter, 0.02655, round_off);
  EXPECT_NEAR(point.mass - point.tube_mass, 0.45, round_off);
  // from the other end
  EXPECT_NEAR(Tube(builder.model, beams, nodes.back(), "T1").at(0.25).mass, point.mass, round_off);
}

TEST(Tube, FollowsBeamsInAnyOrderAndDirection) {
  const UTube ordered;
  UTube mixed;
  for (std::size_t k = 0; k < mixed.builder.model.beams.size(); k += 2)
    std::swap(mixed.builder.model.beams[k].a, mixed.builder.model.beams[k].b);
  std::vector<Index> beams = mixed.beams();
  std::reverse(beams.begin(), beams.end());
  const Tube a(ordered.builder.model, ordered.beams(), ordered.nodes.front(), "T1"),
      b(mixed.builder.model, beams, mixed.nodes.front(), "T1");
  ASSERT_EQ(b.elements().size(), 15u);
  EXPECT_TRUE(b.elements()[0].reversed);
  EXPECT_EQ(b.elements()[3].first, mixed.nodes[3]);
  EXPECT_EQ(b.elements()[3].second, mixed.nodes[4]);
  for (double s = 0.01; s < a.length(); s += 0.1) {
    EXPECT_LT((a.at(s).position - b.at(s).position).norm(), round_off) << s;
    EXPECT_LT((a.at(s).tangent - b.at(s).tangent).norm(), round_off) << s;
  }
  // from its other end, all is the other way round
  const Tube back(ordered.builder.model, ordered.beams(), ordered.nodes.back(), "T1");
  for (double s = 0.01; s < a.length(); s += 0.1) {
    EXPECT_LT((a.at(s).position - back.at(a.length() - s).position).norm(), round_off) << s;
    EXPECT_LT((a.at(s).tangent + back.at(a.length() - s).tangent).norm(), round_off) << s;
  }
}

TEST(Tube, ShapesOfRigidMotionsAreRigid) {
  for (const bool turned : {false, true}) {
    UTube u;
    if (turned)
      for (fem::Beam& beam : u.builder.model.beams)
        std::swap(beam.a, beam.b);
    const Vec3 shift(0.3, -0.2, 0.5), turn(0.7, 0.1, -0.4);
    HandMade hand{u.builder, u.nodes, {}};
    hand.set_frequencies({1.0, 2.0});
    for (const Index node : u.nodes) {
      const Vec3 x = u.builder.model.nodes[static_cast<std::size_t>(node)];
      hand.set_shape(0, node, shift, Vec3::Zero());
      hand.set_shape(1, node, turn.cross(x), turn);
    }
    const Tube tube = hand.tube();
    for (double s = 0.0; s < tube.length(); s += 0.07) {
      const Eigen::Matrix3Xd found = tube.shapes(hand.basis, s);
      EXPECT_LT((found.col(0) - shift).norm(), round_off) << s;
      EXPECT_LT((found.col(1) - turn.cross(tube.at(s).position)).norm(), round_off) << s;
    }
  }
}

TEST(Tube, ShapesAreHermiteCubicsOnStraightBeams) {
  ModelBuilder builder;
  const auto nodes = builder.line({0, 0, 0}, {0, 0, 2.0}, 1, builder.property(tests::tube_property()));
  HandMade hand{builder, nodes, {}};
  hand.set_frequencies({1.0});
  hand.set_shape(0, nodes[0], {0.3, 0, 0}, {0, 0.7, 0}); // slope du/dz = ry
  hand.set_shape(0, nodes[1], {-0.2, 0, 0}, {0, 0.1, 0});
  for (const double s : {0.0, 0.3, 1.1, 2.0}) {
    const double z = s / 2.0;
    const double hermite = 0.3 * (1 - 3 * z * z + 2 * z * z * z) + 0.7 * 2.0 * (z - 2 * z * z + z * z * z) -
                           0.2 * (3 * z * z - 2 * z * z * z) + 0.1 * 2.0 * (z * z * z - z * z);
    EXPECT_NEAR(hand.tube().shapes(hand.basis, s)(0, 0), hermite, round_off) << s;
  }
}

TEST(Tube, MeanShapesAreThoseOfTheCubics) {
  ModelBuilder builder;
  const auto nodes = builder.line({0, 0, 0}, {0, 0, 2.0}, 2, builder.property(tests::tube_property()));
  HandMade hand{builder, nodes, {}};
  hand.set_frequencies({1.0});
  const auto at = [](double z) { return z * z * z - 2.0 * z; }; // one cubic over both beams
  const auto integral = [](double z) { return std::pow(z, 4) / 4.0 - z * z; };
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double z = static_cast<double>(k);
    hand.set_shape(0, nodes[k], {at(z), 0, 0}, {0, 3.0 * z * z - 2.0, 0});
  }
  const Tube tube = hand.tube();
  for (const auto& [from, to] :
       {std::pair(0.0, 2.0), std::pair(0.3, 0.4), std::pair(0.7, 1.0), std::pair(0.9, 1.6)})
    EXPECT_NEAR(tube.mean_shapes(hand.basis, from, to)(0, 0), (integral(to) - integral(from)) / (to - from),
                round_off)
        << from;
}

TEST(Tube, SaysWhichBeamsFormNoChain) {
  UTube u;
  const auto make = [&](std::vector<Index> beams, Index start) {
    return [&u, beams, start] { (void)Tube(u.builder.model, beams, start, "T7"); };
  };
  std::vector<Index> all = u.beams(), gap = all;
  gap.erase(gap.begin() + 6);
  tests::expect_error(
      make(gap, u.nodes.front()),
      {"tube \"T7\"", "no single chain", "6 of 14 beams are reached", "beam from", "merge the nodes"});
  tests::expect_error(
      make(all, u.nodes[3]),
      {"tube \"T7\"", "its start, the node at (-0.5, 0, 0.9), is inside it", "at one of its ends"});
  tests::expect_error(make({0, 1}, u.nodes[5]), {"no beam of it is at its start, the node at"});
  tests::expect_error(make({0, 1}, 999), {"node 999, which the model does not have"});
  tests::expect_error(make({}, u.nodes[0]), {"has no beams", "name a group"});
  tests::expect_error(make({0, 99}, u.nodes[0]), {"beam 99 is not one of the 15 of the model"});
  tests::expect_error(make({0, 1, 0}, u.nodes[0]),
                      {"beam from (-0.5, 0, 0) to (-0.5, 0, 0.3) is named twice"});
  const Index branch = u.builder.node({5, 0, 0});
  u.builder.model.beams.push_back({u.nodes[2], branch, 0});
  all.push_back(15);
  tests::expect_error(make(all, u.nodes.front()),
                      {"3 of its beams meet at the node at (-0.5, 0, 0.6)", "without branches"});
}

TEST(Tube, RefusesAClosedLoopAndSectionsThatAreNotRound) {
  ModelBuilder builder;
  const Index number = builder.property(tests::tube_property());
  const auto nodes = builder.line({0, 0, 0}, {1, 0, 0}, 2, number);
  const Index corner = builder.node({0, 1, 0});
  builder.model.beams.push_back({nodes[2], corner, number});
  builder.model.beams.push_back({corner, nodes[0], number});
  const std::vector<Index> loop{0, 1, 2, 3}, line{0, 1};
  tests::expect_error([&] { (void)Tube(builder.model, loop, nodes[0], "T7"); }, {"on a closed loop"});
  builder.model.properties[0].section = fem::rectangle_section(0.01, 0.01);
  tests::expect_error([&] { (void)Tube(builder.model, line, nodes[0], "T7"); },
                      {"tube \"T7\"", "neither a pipe nor a circle", "round shape"});
}

TEST(Tube, RefusesAbscissaeOffTheTubeAndModesOfOthers) {
  HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 4, {40.0});
  const Tube tube = hand.tube();
  tests::expect_error([&] { (void)tube.at(1.01); },
                      {"tube \"T1\": s = 1.01 m is not on it", "0 to its length, 1 m"});
  tests::expect_error([&] { (void)tube.shapes(hand.basis, -0.01); }, {"s = -0.01 m"});
  tests::expect_error([&] { (void)tube.at(std::nan("")); }, {"s = nan m"});
  EXPECT_NEAR(tube.at(1.0 + 1e-12).position.z(), 1.0, round_off) << "round-off of an abscissa";
  hand.basis.nodes.back() = 77;
  tests::expect_error([&] { (void)tube.shapes(hand.basis, 0.9); },
                      {"another structure", "the tube belongs to"});
}

} // namespace
} // namespace fretwork::flow::tube_test
