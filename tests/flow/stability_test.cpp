// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "flow/stability.hpp"
#include "hand_made.hpp"

namespace fretwork::flow::stability_test {
namespace {

using tests::constant;
using tests::HandMade;
using tests::liquid_zone;
using tests::pi;

constexpr double printed = 0.5e-6;  ///< six decimals
constexpr double round_off = 1e-12; ///< relative, of sums of some thousand terms
constexpr double interpolated =
    2e-8; ///< relative: three half-waves by 200 Hermite cubics, (3 pi/200)^4/384 at most
constexpr double diameter = 0.01905;

/// The pinned tube of the reference case: 0.8 kg/m, 1 m.
HandMade reference_tube(int elements = 400, int modes = 3) {
  fem::BeamProperty property = tests::tube_property();
  property.material.density = 0.8 / property.section.area;
  std::vector<double> frequencies;
  for (int n = 1; n <= modes; ++n)
    frequencies.push_back(n * n * pi / 2.0 * std::sqrt(2e11 * property.section.iy / 0.8));
  return tests::pinned_tube(property, 1.0, elements, frequencies);
}
/// M_i of sin(n pi s): 0.8 kg/m times 1/2 m.
Eigen::VectorXd modal_mass(Eigen::Index modes) { return Eigen::VectorXd::Constant(modes, 0.4); }

Zone first_zone() {
  Zone zone = liquid_zone("riser", 0.0, 0.25, 388.25, 1.5);
  zone.connors_constants = {2.8544};
  return zone;
}
Zone second_zone() {
  Zone zone = liquid_zone("entry", 0.75, 1.0, 740.0, 0.75);
  zone.connors_constants = {4.0};
  return zone;
}

Stability stability_of(const HandMade& hand, const std::vector<Zone>& zones, const Component& component = {},
                       double xi = 0.02) {
  const Tube tube = hand.tube();
  const Profile profile(zones, tube.length());
  const Eigen::Index modes = hand.basis.size();
  return stability(profile, sample(tube, profile, hand.basis, modal_mass(modes)),
                   Eigen::VectorXd::Constant(modes, xi), component);
}

TEST(Stability, HasTheReferenceRatios) {
  const HandMade hand = reference_tube();
  const Stability one = stability_of(hand, {first_zone()}),
                  both = stability_of(hand, {first_zone(), second_zone()});
  struct Row {
    double frequency, one, both, critical;
  };
  const std::array<Row, 3> rows{Row{39.182390, 0.251188, 0.280009, 5.356972},
                                Row{156.729561, 0.104174, 0.116126, 12.916950},
                                Row{352.641513, 0.050976, 0.056825, 26.396976}};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    EXPECT_NEAR(one.modes[static_cast<std::size_t>(i)].frequency, row.frequency, printed);
    EXPECT_NEAR(one.cases[0].ratio(i), row.one, printed);
    EXPECT_NEAR(both.cases[0].ratio(i), row.both, printed);
    EXPECT_NEAR(1.5 * 1.0 / both.cases[0].ratio(i), row.critical, 2.0 * printed)
        << "critical velocity of zone 1";
  }
  EXPECT_EQ(both.cases[0].critical_mode, 0);
  EXPECT_NEAR(both.cases[0].margin().value(), 1.0 - 0.280009, printed);
  EXPECT_NEAR(1.5 * both.cases[0].critical_scale(), 5.356972, printed);
}

TEST(Stability, HasTheEnergiesOfSineModes) {
  const Stability found = stability_of(reference_tube(200), {first_zone(), second_zone()});
  const auto until = [](double s, int n) { return 0.5 * (s - std::sin(2 * n * pi * s) / (2 * n * pi)); };
  for (int n = 1; n <= 3; ++n) {
    const ModeInFlow& mode = found.modes[static_cast<std::size_t>(n - 1)];
    const double first = 388.25 * 2.25 * until(0.25, n),
                 second = 740.0 * 0.5625 * (until(1.0, n) - until(0.75, n));
    EXPECT_NEAR(mode.energies[0], first, 2.0 * interpolated * first);
    EXPECT_NEAR(mode.energies[1], second, 2.0 * interpolated * second);
    const double rho = 388.25 * until(0.25, n) + 740.0 * (until(1.0, n) - until(0.75, n));
    EXPECT_NEAR(mode.effective_velocity, std::sqrt((first + second) / rho), 4.0 * interpolated);
  }
}

TEST(Stability, OfUniformFlowIsTheClosedFormula) {
  Zone zone = first_zone();
  zone.to = 1.0;
  const Stability found = stability_of(reference_tube(), {zone});
  const double delta = 2.0 * pi * 0.02 / std::sqrt(1.0 - 4e-4);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double closed = 2.8544 * found.modes[static_cast<std::size_t>(i)].frequency * diameter *
                          std::sqrt(0.8 * delta / (388.25 * diameter * diameter));
    EXPECT_NEAR(found.cases[0].critical_velocity(i), closed, interpolated * closed);
  }
  EXPECT_NEAR(found.cases[0].critical_velocity(0), 1.799879, printed);
}

/// rows + 1 rows of 4 top s (1 - s)
Table<double> parabola(double top, int rows) {
  Table<double> out;
  for (int k = 0; k <= rows; ++k) {
    const double s = static_cast<double>(k) / rows;
    out.s.push_back(s);
    out.values.push_back(4.0 * top * s * (1.0 - s));
  }
  return out;
}

TEST(Stability, OfAParabolicProfileHasTheReferenceVelocity) {
  constexpr int rows = 4000;
  constexpr double of_rows = 4.0 / rows / rows; // chords below the parabola by 1/rows^2, twice V0_c
  Zone zone = first_zone();
  zone.to = 1.0;
  zone.velocity = ScalarVelocity{parabola(1.0, rows)};
  const Stability found = stability_of(reference_tube(100, 1), {zone});
  EXPECT_NEAR(found.cases[0].critical_scale(), 2.038332, printed + of_rows);
}

/// Case SDLL152a of the validation manual of Code_Aster: a clamped tube in a parabolic flow of water. Its formula takes
/// the mass of a tube of 2500 kg/m3, its frequency that of one of 7800 kg/m3 with shear.
TEST(Stability, HasTheCriticalVelocityOfSDLL152a) {
  constexpr double published = 1e-6; // relative: its frequencies have six digits
  constexpr double root = 4.730040744862704, with_shear = 226.391 / 230.952;
  fem::BeamProperty property{{2.1e11, 0.3, 7800.0}, fem::pipe_section(0.04, 0.005)};
  const double added = 0.8, inner = 1000.0 * pi * 0.03 * 0.03 / 4.0;
  property.added_mass = added + inner;
  const double wet = 7800.0 * property.section.area + added + inner,
               in_formula = 2500.0 * property.section.area + added + inner;
  HandMade hand = tests::pinned_tube(
      property, 1.0, 200,
      {with_shear * root * root / (2.0 * pi) * std::sqrt(2.1e11 * property.section.iy / wet)});
  const double sigma = (std::cosh(root) - std::cos(root)) / (std::sinh(root) - std::sin(root));
  for (const Index node : hand.nodes) {
    const double x = root * hand.builder.model.nodes[static_cast<std::size_t>(node)].z();
    const double shape = std::cosh(x) - std::cos(x) - sigma * (std::sinh(x) - std::sin(x)),
                 slope = root * (std::sinh(x) + std::sin(x) - sigma * (std::cosh(x) - std::cos(x)));
    hand.set_shape(0, node, {shape, 0, 0}, {0, slope, 0});
  }
  Zone zone = liquid_zone("water", 0.0, 1.0, 1000.0, 0.0);
  zone.velocity = ScalarVelocity{parabola(1.0, 100)};
  zone.connors_constants = {4.5};
  const Tube tube = hand.tube();
  const Profile profile({zone}, 1.0);
  const double moved = transverse_share(sample(tube, profile, hand.basis))(0) / wet; // int phi^2 ds
  const Stability found =
      stability(profile, sample(tube, profile, hand.basis, Eigen::VectorXd::Constant(1, in_formula * moved)),
                Eigen::VectorXd::Constant(1, 0.0015));
  EXPECT_NEAR(found.cases[0].critical_velocity(0), 4.566805, 4.566805 * published);
}

TEST(Stability, DoesNotChangeWithTheScaleOfShapes) {
  HandMade hand = reference_tube(100);
  const Stability before = stability_of(hand, {first_zone(), second_zone()});
  const Eigen::Vector3d scale(100.0, 0.003, -1.0);
  hand.basis.shapes *= scale.asDiagonal();
  const Tube tube = hand.tube();
  const Profile profile({first_zone(), second_zone()}, 1.0);
  const Eigen::VectorXd mass = modal_mass(3).cwiseProduct(scale.cwiseAbs2());
  const Stability after =
      stability(profile, sample(tube, profile, hand.basis, mass), Eigen::VectorXd::Constant(3, 0.02));
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(after.cases[0].ratio(i), before.cases[0].ratio(i), round_off);
    EXPECT_NEAR(after.cases[0].critical_velocity(i), before.cases[0].critical_velocity(i), 100.0 * round_off);
  }
}

TEST(Stability, OfAZoneSplitInTwoIsTheSame) {
  const HandMade hand = reference_tube(100);
  Zone whole = first_zone();
  whole.to = 0.9;
  Zone left = whole, right = whole;
  left.to = right.from = 0.3334;
  right.name = "right";
  const Stability one = stability_of(hand, {whole}), two = stability_of(hand, {left, right});
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(two.cases[0].ratio(i), one.cases[0].ratio(i), round_off);
    EXPECT_NEAR(two.cases[0].critical_velocity(i), one.cases[0].critical_velocity(i), 100.0 * round_off);
  }
}

TEST(Stability, TabulatesAllCombinationsOfConstants) {
  Zone first = first_zone(), second = second_zone();
  first.connors_constants = {2.0, 3.0};
  second.connors_constants = {4.0, 5.0, 6.0};
  const Stability found = stability_of(reference_tube(100, 1), {first, second});
  ASSERT_EQ(found.cases.size(), 6u);
  EXPECT_EQ(found.cases[1].constants, (std::vector<double>{2.0, 5.0}));
  EXPECT_EQ(found.cases[3].constants, (std::vector<double>{3.0, 4.0}));
  const auto& e = found.modes[0].energies;
  const ModeInFlow& mode = found.modes[0];
  for (const StabilityCase& it : found.cases) {
    const double sum = e[0] / std::pow(it.constants[0], 2) + e[1] / std::pow(it.constants[1], 2);
    EXPECT_NEAR(it.ratio(0), std::sqrt(sum / (std::pow(mode.frequency, 2) * mode.decrement * 0.4)),
                round_off);
  }
  first.connors_constants.assign(40, 3.0);
  second.connors_constants.assign(40, 3.0);
  tests::expect_error(
      [&] {
        (void)stability_of(reference_tube(10, 1), {first, second});
      },
      {"more than 1000 combinations", "fewer K"});
}

TEST(Stability, TakesTheConstantOfThePitch) {
  Zone zone = first_zone();
  zone.connors_constants.clear();
  zone.bundle = {Arrangement::square, 1.44 * diameter};
  const Zone still = liquid_zone("still", 0.5, 0.9, 740.0, 0.0);
  const Stability found = stability_of(reference_tube(100, 1), {zone, still});
  EXPECT_NEAR(found.cases[0].constants[0], 2.8544, round_off);
  EXPECT_EQ(found.cases[0].constants[1], 0.0) << "still fluid needs no constant";
  constexpr double of_table = 0.003; // the two branches meet to 2.997 and 3
  EXPECT_EQ(default_connors_constant({Arrangement::triangle, 0.0147}, 0.01), 3.0);
  EXPECT_NEAR(default_connors_constant({Arrangement::triangle, 0.01469999}, 0.01), 3.0, of_table);
  EXPECT_EQ(default_connors_constant({Arrangement::triangle, 0.02}, 0.01), 3.0);
}

TEST(Stability, SweepsTheVelocity) {
  const Stability found = stability_of(reference_tube(100), {first_zone()});
  const std::vector<double> factors{0.0, 1.0, 2.5};
  const Eigen::MatrixXd swept = velocity_sweep(found.cases[0], factors);
  EXPECT_EQ(swept.row(0).maxCoeff(), 0.0);
  Zone faster = first_zone();
  faster.velocity = ScalarVelocity{constant(2.5 * 1.5)};
  const Stability direct = stability_of(reference_tube(100), {faster});
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_EQ(swept(1, i), found.cases[0].ratio(i));
    EXPECT_NEAR(swept(2, i), direct.cases[0].ratio(i), round_off);
  }
  const std::vector<double> negative{-1.0};
  tests::expect_error([&] { (void)velocity_sweep(found.cases[0], negative); }, {"factor 1 = -1", ">= 0"});
}

TEST(Stability, OfABendHasTheReferenceEnergy) {
  constexpr double radius = 0.7, rho = 740.0, speed = 1.3;
  constexpr int arcs = 200;
  constexpr double of_arcs =
      1e-7; // relative: two half-waves by 200 elements, (2 pi/200)^4/384, and a margin for arcs
  HandMade hand;
  const Index start = hand.builder.node({-radius, 0, 0});
  hand.nodes = hand.builder.arcs_from(start, Vec3::Zero(), -radius * Vec3::UnitX(), radius * Vec3::UnitZ(),
                                      0.0, pi, arcs, hand.builder.property(tests::tube_property()));
  hand.set_frequencies({40.0});
  for (std::size_t k = 0; k < hand.nodes.size(); ++k) {
    const double angle = pi * static_cast<double>(k) / arcs;
    const Vec3 tangent(std::sin(angle), 0, std::cos(angle));
    hand.set_shape(0, hand.nodes[k], std::pow(std::sin(angle), 2) * Vec3::UnitY(),
                   tangent.cross(std::sin(2.0 * angle) / radius * Vec3::UnitY()));
  }
  Zone zone = liquid_zone("bend", 0.0, pi * radius, rho, 0.0);
  zone.velocity = VectorVelocity{Table<Vec3>::constant({0, 0, speed})};
  zone.connors_constants = {3.0};
  const double expected = rho * speed * speed * radius * 5.0 * pi / 16.0;
  const auto energy = [&](const Component& component) {
    return stability_of(hand, {zone}, component).modes[0].energies[0];
  };
  EXPECT_NEAR(energy({}), expected, of_arcs * expected);
  EXPECT_NEAR(energy({Component::Kind::lift}), expected, of_arcs * expected)
      << "the motion is along e_L = -e_y";
  EXPECT_NEAR(energy({Component::Kind::drag}), 0.0, of_arcs * expected);
  EXPECT_NEAR(energy({Component::Kind::axis, {0, 2.0, 0}}), expected, of_arcs * expected);
  EXPECT_NEAR(energy({Component::Kind::axis, {0, 1.0, 1.0}}), 0.5 * expected, of_arcs * expected);
}

TEST(Stability, SkipsModesThatTheFlowDoesNotMeet) {
  // along the tube, without damping
  const HandMade along = tests::pinned_tube(tests::tube_property(), 1.0, 20, {40.0}, Vec3::UnitZ());
  const Stability none = stability_of(along, {first_zone()}, {}, 0.0);
  EXPECT_EQ(none.cases[0].ratio(0), 0.0);
  EXPECT_EQ(none.cases[0].critical_velocity(0), 0.0);
  EXPECT_TRUE(std::isinf(none.cases[0].critical_scale()));
  EXPECT_EQ(none.cases[0].margin(), std::nullopt);
  // a rigid-body mode has no critical velocity
  const Stability rigid =
      stability_of(tests::pinned_tube(tests::tube_property(), 1.0, 20, {0.0}), {first_zone()}, {}, 0.0);
  EXPECT_TRUE(std::isinf(rigid.cases[0].ratio(0)));
  EXPECT_EQ(rigid.cases[0].critical_velocity(0), 0.0);
  const std::vector<double> off{0.0};
  EXPECT_EQ(velocity_sweep(rigid.cases[0], off)(0, 0), 0.0);
}

TEST(Stability, RefusesWhatCannotBeAssessed) {
  const HandMade hand = reference_tube(20, 2);
  for (const double xi : {0.0, 1.0, -0.1, std::nan("")})
    tests::expect_error([&] { (void)stability_of(hand, {first_zone()}, {}, xi); },
                        {"mode 1 at 39.18", "damping ratio = ", "above 0 and below 1"});
  const Profile profile({first_zone()}, 1.0);
  tests::expect_error(
      [&] { (void)stability(profile, sample(hand.tube(), profile, hand.basis), Eigen::VectorXd::Ones(3)); },
      {"3 damping ratios for 2 modes"});
  Zone zone = first_zone();
  zone.connors_constants.clear();
  tests::expect_error(
      [&] { (void)stability_of(hand, {zone}); },
      {"zone \"riser\": no Connors constant", "a single tube", "give its connors_constant (K)"});
  zone.bundle = {Arrangement::square, 1.44 * diameter};
  zone.fluid = SinglePhase{Phase::gas, constant(36.5), 5e-7};
  tests::expect_error([&] { (void)stability_of(hand, {zone}); }, {"no Connors constant", "not for gas"});
  zone = first_zone();
  std::get<ScalarVelocity>(zone.velocity).direction.reset();
  EXPECT_NO_THROW((void)stability_of(hand, {zone}));
  tests::expect_error([&] { (void)stability_of(hand, {zone}, {Component::Kind::drag}); },
                      {"zone \"riser\": drag and lift need the direction"});
  tests::expect_error([&] { (void)stability_of(hand, {zone}, {Component::Kind::axis}); },
                      {"axis (0, 0, 0) is no direction"});
}

} // namespace
} // namespace fretwork::flow::stability_test
