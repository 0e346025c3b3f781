// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "hand_made.hpp"

namespace fretwork::flow::profile_test {
namespace {

using tests::constant;
using tests::liquid_zone;
using tests::pi;

constexpr double round_off = 1e-13;
constexpr double printed = 0.5e-6; ///< six decimals

TubePoint straight(double s) {
  return {.s = s, .position = {0, 0, s}, .tangent = Vec3::UnitZ(), .outer_diameter = 0.01905};
}

TwoPhase mixture(std::variant<GivenVoidFraction, Quality> content) {
  return {{740.0, 36.5, 9.1e-5 / 740.0, 5.2e-7, 0.0176}, std::move(content)};
}

TEST(FlowProfile, HasTheNormalDirectionsOfABend) {
  Zone zone = liquid_zone("bend", 0.0, pi, 740.0, 0.0);
  zone.velocity = VectorVelocity{Table<Vec3>::constant({0, 0, 2.0})};
  const Profile profile({zone}, pi);
  for (const double angle : {pi / 6.0, 1.0, pi / 2.0, 2.5}) {
    const TubePoint point{
        .s = angle, .tangent = {std::sin(angle), 0, std::cos(angle)}, .outer_diameter = 0.02};
    const FlowPoint flow = profile.at(point);
    EXPECT_NEAR(flow.velocity, 2.0 * std::sin(angle), round_off);
    EXPECT_LT((flow.drag - Vec3(-std::cos(angle), 0, std::sin(angle))).norm(), round_off);
    EXPECT_LT((flow.lift - Vec3(0, -1, 0)).norm(), round_off);
  }
  const FlowPoint printed_one =
      profile.at({.s = pi / 6, .tangent = {0.5, 0, std::sqrt(0.75)}, .outer_diameter = 0.02});
  EXPECT_NEAR(printed_one.drag.x(), -0.866025, printed);
  EXPECT_NEAR(printed_one.drag.z(), 0.5, printed);
}

TEST(FlowProfile, OfFlowAlongTheTubeActsNot) {
  Zone zone = liquid_zone("leg", 0.0, 1.0, 740.0, 0.0);
  zone.velocity = VectorVelocity{{{0.0, 1.0}, {Vec3(0, 0, 3.0), Vec3(0.3, 0, 3.0)}}};
  const Profile profile({zone}, 1.0);
  const FlowPoint along = profile.at(straight(0.0)), across = profile.at(straight(0.5));
  EXPECT_EQ(along.velocity, 0.0);
  EXPECT_EQ(along.drag, Vec3::Zero());
  EXPECT_EQ(along.density, 740.0) << "still fluid there all the same";
  EXPECT_NEAR(across.velocity, 0.15, round_off);
  EXPECT_EQ(across.drag, Vec3::UnitX());
  EXPECT_EQ(profile.at(straight(1e-6)).velocity, 0.0) << "3e-7 m/s of 3 m/s has no direction";
}

TEST(FlowProfile, TakesAScalarVelocityAsNormal) {
  Zone zone = liquid_zone("leg", 0.2, 0.8, 740.0, 1.5);
  std::get<ScalarVelocity>(zone.velocity).direction = Vec3(1, 0, 1);
  const FlowPoint flow = Profile({zone}, 1.0).at(straight(0.5));
  EXPECT_EQ(flow.velocity, 1.5) << "its direction does not shorten it";
  EXPECT_LT((flow.drag - Vec3::UnitX()).norm(), round_off);
  EXPECT_LT((flow.lift - Vec3::UnitY()).norm(), round_off);
  std::get<ScalarVelocity>(zone.velocity).direction.reset();
  const FlowPoint plain = Profile({zone}, 1.0).at(straight(0.5));
  EXPECT_EQ(plain.velocity, 1.5);
  EXPECT_EQ(plain.drag, Vec3::Zero());
}

TEST(FlowProfile, IsNothingOutsideItsZones) {
  const Profile profile({liquid_zone("b", 0.5, 0.8, 700.0, 2.0), liquid_zone("a", 0.2, 0.5, 740.0, 1.5)},
                        1.0);
  for (const double s : {0.1, 0.9}) {
    const FlowPoint flow = profile.at(straight(s));
    EXPECT_EQ(flow.zone, -1);
    EXPECT_EQ(flow.phase, Phase::none);
    EXPECT_EQ(flow.velocity, 0.0);
    EXPECT_EQ(flow.density, 0.0);
  }
  EXPECT_EQ(profile.zone_at(0.3), 1) << "zones keep the order in which they are given";
  EXPECT_EQ(profile.zone_at(0.5), 0) << "the zone that begins there";
  EXPECT_EQ(profile.zone_at(0.8), 0);
  EXPECT_EQ(profile.zone_at(0.2), 1);
}

TEST(FlowProfile, HasDensityAndViscosityOfTheMixture) {
  Zone zone = liquid_zone("top", 0.0, 1.0, 0.0, 1.0);
  zone.fluid = mixture(GivenVoidFraction{{{0.0, 1.0}, {0.4, 0.6}}});
  const FlowPoint given = Profile({zone}, 1.0).at(straight(0.5));
  EXPECT_EQ(given.phase, Phase::two_phase);
  EXPECT_NEAR(given.void_fraction, 0.5, round_off);
  EXPECT_NEAR(given.density, 388.25, 388.25 * round_off);
  EXPECT_EQ(given.liquid_density, 740.0);
  const double nu_l = 9.1e-5 / 740.0;
  EXPECT_NEAR(given.viscosity, nu_l / (1.0 + 0.5 * (nu_l / 5.2e-7 - 1.0)), 1e-20);

  zone.fluid = mixture(Quality{constant(0.15)});
  const FlowPoint homogeneous = Profile({zone}, 1.0).at(straight(0.5));
  EXPECT_NEAR(homogeneous.void_fraction, 0.781553, printed);
  zone.fluid = mixture(Quality{constant(0.15), constant(400.0)});
  zone.bundle = {Arrangement::square, 1.44 * 0.01905};
  const FlowPoint slip = Profile({zone}, 1.0).at(straight(0.5));
  EXPECT_NEAR(slip.void_fraction, 0.636890, printed);
  EXPECT_NEAR(slip.homogeneous_void_fraction, 0.781553, printed);
}

TEST(FlowProfile, NamesItsBreaks) {
  Zone a = liquid_zone("a", 0.2, 0.5, 740.0, 1.5), b = liquid_zone("b", 0.5, 0.8, 740.0, 1.5);
  a.velocity = ScalarVelocity{{{0.1, 0.3, 0.6}, {1, 2, 3}}};
  a.inner_density = {{0.2, 0.4, 0.5}, {700, 710, 720}};
  b.fluid =
      mixture(Quality{{{0.5, 0.7, 0.8}, {0.1, 0.2, 0.2}}, Table<double>{{0.5, 0.6, 0.8}, {400, 300, 300}}});
  b.bundle = {Arrangement::square, 0.03};
  b.velocity = VectorVelocity{{{0.5, 0.65, 0.8}, {Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitX()}}};
  EXPECT_EQ(Profile({a, b}, 1.0).breaks(), (std::vector<double>{0.2, 0.3, 0.4, 0.5, 0.6, 0.65, 0.7, 0.8}));
}

void expect_refused(const Zone& zone, const std::vector<std::string>& parts) {
  tests::expect_error([&] { (void)Profile({zone}, 2.0); }, parts);
}

TEST(FlowProfile, RefusesZonesThatOverlapOrLeaveTheTube) {
  tests::expect_error(
      [] {
        (void)Profile({liquid_zone("b", 0.5, 1.0, 1, 1), liquid_zone("a", 0.0, 0.6, 1, 1)}, 2.0);
      },
      {"zone \"a\" ends at s = 0.6 m, after zone \"b\" has begun at 0.5 m"});
  const auto beside_dry = [](double from, double to) {
    return [from, to] { (void)Profile({liquid_zone("a", 0.0, 0.6, 1, 1)}, 2.0, {{"dry", from, to}}); };
  };
  tests::expect_error(beside_dry(0.5, 2.0), {"zone \"a\" ends at s = 0.6 m, after zone \"dry\" has begun"});
  tests::expect_error(beside_dry(0.6, 2.02), {"zone \"dry\" goes from s = 0.6 to 2.02 m, off the tube"});
  EXPECT_NO_THROW(beside_dry(0.6, 2.0)());
  expect_refused(liquid_zone("a", 0.5, 0.5, 1, 1),
                 {"zone \"a\" goes from s = 0.5 to 0.5 m", "beyond its beginning"});
  expect_refused(liquid_zone("a", 0.5, 2.02, 1, 1), {"from s = 0.5 to 2.02 m, off the tube", "0 to 2 m"});
  expect_refused(liquid_zone("a", -0.02, 1.0, 1, 1), {"off the tube"});
  EXPECT_NO_THROW(Profile({liquid_zone("a", -0.009, 2.009, 1, 1)}, 2.0)) << "within 0.5 % of the length";
}

TEST(FlowProfile, HasNoFluidInDryZones) {
  const Profile profile({liquid_zone("a", 0.0, 0.6, 740.0, 1.0)}, 2.0, {{"dry", 0.6, 2.0}});
  EXPECT_EQ(profile.zones().size(), 1u);
  ASSERT_EQ(profile.dry().size(), 1u);
  EXPECT_EQ(profile.dry()[0].from, 0.6);
  EXPECT_EQ(profile.zone_at(1.0), -1);
}

TEST(FlowProfile, RefusesTablesThatEndEarly) {
  Zone zone = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
  zone.velocity = ScalarVelocity{{{0.0, 1.98}, {1.0, 2.0}}};
  expect_refused(zone, {"zone \"a\": velocity", "from s = 0 to 1.98 m", "the zone from 0 to 2 m", "0.5 %"});
  zone.velocity = ScalarVelocity{{{0.02, 2.0}, {1.0, 2.0}}};
  expect_refused(zone, {"from s = 0.02 to 2 m"});
  zone.velocity = ScalarVelocity{{{0.009, 1.991}, {1.0, 2.0}}};
  EXPECT_EQ(Profile({zone}, 2.0).at(straight(2.0)).velocity, 2.0) << "the last value is kept";
  zone.velocity = VectorVelocity{{{0.0, 1.9}, {Vec3::UnitX(), Vec3::UnitX()}}};
  expect_refused(zone, {"zone \"a\": velocity", "to 1.9 m"});
  zone = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
  zone.inner_density = {{0.0, 1.0}, {700, 700}};
  expect_refused(zone, {"zone \"a\": inner density", "to 1 m"});
}

TEST(FlowProfile, RefusesFluidsWithoutSense) {
  Zone zone = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
  zone.fluid = SinglePhase{Phase::two_phase, constant(740.0), 1e-7};
  expect_refused(zone, {"zone \"a\": a single phase is liquid or gas"});
  zone.fluid = tests::liquid(-1.0);
  expect_refused(zone, {"zone \"a\": density", "value -1", ">= 0"});
  zone.fluid = tests::liquid(740.0, 0.0);
  expect_refused(zone, {"zone \"a\": viscosity = 0 m2/s"});
  zone.fluid = mixture(GivenVoidFraction{constant(1.2)});
  expect_refused(zone, {"zone \"a\": void fraction", "value 1.2", "from 0 to 1"});
  zone.fluid = mixture(Quality{constant(-0.2)});
  expect_refused(zone, {"zone \"a\": steam quality", "value -0.2"});
  zone.fluid = mixture(Quality{constant(0.2), constant(400.0)});
  expect_refused(zone, {"zone \"a\": Feenstra's void fraction needs a bundle", "leave out the mass flux"});
  zone.fluid = mixture(Quality{constant(0.2), constant(0.0)});
  expect_refused(zone, {"zone \"a\": mass flux = 0 kg/m2/s"});
  const auto broken = [](auto change) {
    TwoPhase fluid = mixture(Quality{constant(0.2), constant(400.0)});
    change(fluid.phases);
    Zone out = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
    out.fluid = fluid;
    return out;
  };
  expect_refused(broken([](Phases& p) { p.liquid_density = 30.0; }),
                 {"liquid density = 30 kg/m3 is not above gas density = 36.5 kg/m3"});
  expect_refused(broken([](Phases& p) { p.gas_density = 0.0; }), {"gas density = 0"});
  expect_refused(broken([](Phases& p) { p.liquid_viscosity = 0.0; }), {"liquid viscosity = 0"});
  expect_refused(broken([](Phases& p) { p.gas_viscosity = 0.0; }), {"gas viscosity = 0"});
  expect_refused(broken([](Phases& p) { p.surface_tension = 0.0; }),
                 {"surface tension (of Feenstra's void fraction) = 0"});
  expect_refused(broken([](Phases& p) { p.gravity = 0.0; }), {"gravity = 0"});
}

TEST(FlowProfile, RefusesVelocitiesAndBundlesWithoutSense) {
  Zone zone = liquid_zone("a", 0.0, 2.0, 740.0, -1.0);
  expect_refused(zone, {"zone \"a\": velocity", "value -1"});
  zone = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
  std::get<ScalarVelocity>(zone.velocity).direction = Vec3::Zero();
  expect_refused(zone, {"zone \"a\": direction (0, 0, 0) is no direction"});
  std::get<ScalarVelocity>(zone.velocity).direction = Vec3::UnitZ();
  tests::expect_error([&] { (void)Profile({zone}, 2.0).at(straight(0.5)); },
                      {"zone \"a\": direction (0, 0, 1) is along the tube at s = 0.5 m"});
  zone = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
  zone.connors_constants = {3.0, 0.0};
  expect_refused(zone, {"zone \"a\": Connors constant = 0"});
  zone = liquid_zone("a", 0.0, 2.0, 740.0, 1.0);
  zone.bundle = {Arrangement::square, 0.0195};
  tests::expect_error([&] { (void)Profile({zone}, 2.0).at(straight(0.5)); },
                      {"P/D = 1.02", "above 1.05 diameters"});
}

} // namespace
} // namespace fretwork::flow::profile_test
