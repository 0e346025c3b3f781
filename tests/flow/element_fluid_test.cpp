// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "fem/beam_constants.hpp"
#include "flow/element_fluid.hpp"
#include "flow/vortex_shedding.hpp"
#include "hand_made.hpp"

namespace fretwork::flow::element_fluid_test {
namespace {

using tests::HandMade;
using tests::pi;

constexpr double round_off = 1e-13;

TEST(ElementFluid, IsThatOfTheMiddleOfEachElement) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 2.0, 40, {40.0});
  Zone zone = tests::liquid_zone("z", 0.5, 1.5, 0.0, 1.0);
  zone.fluid = SinglePhase{Phase::liquid, {{0.5, 1.5}, {700.0, 800.0}}, 1e-7};
  zone.inner_density = {{0.5, 1.5}, {650.0, 750.0}};
  zone.bundle = {Arrangement::square, 1.44 * 0.01905};
  const TubeFluid found = fluid_of_elements(hand.tube(), Profile({zone}, 2.0));
  ASSERT_EQ(found.elements.size(), 40u);
  EXPECT_TRUE(found.limits.empty());
  const double displaced = pi / 4.0 * std::pow(0.01905, 2), bore = pi / 4.0 * std::pow(0.01905 - 0.00218, 2),
               tube = 8000.0 * (displaced - bore);
  for (std::size_t k = 0; k < 40; ++k) {
    const ElementFluid& it = found.elements[k];
    const double s = 0.05 * (static_cast<double>(k) + 0.5);
    const bool wet = s > 0.5 && s < 1.5;
    const double outer = wet ? 700.0 + 100.0 * (s - 0.5) : 0.0, inner = wet ? 650.0 + 100.0 * (s - 0.5) : 0.0;
    EXPECT_EQ(it.beam, static_cast<Index>(k));
    EXPECT_NEAR(it.s, s, round_off);
    EXPECT_NEAR(it.added_mass, 1.317415 * outer * displaced, 0.5e-6 * 800.0 * displaced)
        << "C_m to six decimals";
    EXPECT_NEAR(it.inner_mass, inner * bore, round_off);
    EXPECT_NEAR(it.submerged_mass, tube + inner * bore - outer * displaced, round_off);
  }
}

TEST(ElementFluid, GivesTheBeamThatMass) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 1, {40.0});
  Zone zone = tests::liquid_zone("z", 0.0, 1.0, 740.0, 1.0);
  zone.inner_density = tests::constant(700.0);
  zone.bundle = {Arrangement::triangle, 1.5 * 0.01905};
  const TubeFluid found = fluid_of_elements(hand.tube(), Profile({zone}, 1.0));
  const fem::BeamProperty dry = tests::tube_property();
  fem::BeamProperty wet = dry;
  wet.fluid = found.elements[0].fluid;
  EXPECT_NEAR(fem::beam_constants(wet).mass_transverse - fem::beam_constants(dry).mass_transverse,
              found.elements[0].added_mass + found.elements[0].inner_mass, round_off);
}

TEST(ElementFluid, TellsOfFewElementsAndOfThePitch) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 20, {40.0});
  Zone narrow = tests::liquid_zone("n", 0.0, 0.5, 740.0, 1.0),
       wide = tests::liquid_zone("w", 0.5, 0.7, 740.0, 1.0);
  narrow.bundle = {Arrangement::square, 1.1 * 0.01905};
  wide.bundle = {Arrangement::square, 2.5 * 0.01905};
  const Limits limits = fluid_of_elements(hand.tube(), Profile({narrow, wide}, 1.0)).limits;
  ASSERT_EQ(limits.size(), 3u);
  EXPECT_EQ(limits[0].kind, LimitKind::pitch_ratio);
  EXPECT_EQ(limits[0].zone, 0);
  EXPECT_NEAR(limits[0].value, 1.1, round_off);
  EXPECT_EQ(limits[0].bound, 1.2);
  EXPECT_EQ(limits[1].bound, 2.0);
  EXPECT_EQ(limits[2].kind, LimitKind::elements_of_zone);
  EXPECT_EQ(limits[2].zone, 1);
  EXPECT_EQ(limits[2].value, 4.0);
}

TEST(ElementFluid, RefusesTubesThatNearlyTouch) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 20, {40.0});
  Zone zone = tests::liquid_zone("n", 0.0, 1.0, 740.0, 1.0);
  zone.bundle = {Arrangement::square, 0.01905};
  tests::expect_error([&] { (void)fluid_of_elements(hand.tube(), Profile({zone}, 1.0)); }, {"P/D = 1,"});
}

TEST(VortexShedding, IsFoundWithinAFifthInLiquid) {
  // St V/D = 0.2 V/0.01905: 31.496 Hz at 3 m/s
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 20, {25.0, 31.5, 38.0, 60.0, 0.0});
  const auto found = [&](const Zone& zone) {
    return shedding_coincidences(sample(hand.tube(), Profile({zone}, 1.0), hand.basis), 0.2);
  };
  Zone zone = tests::liquid_zone("z", 0.2, 0.8, 740.0, 3.0);
  const auto uniform = found(zone);
  ASSERT_EQ(uniform.size(), 1u) << "25 and 38 Hz are 20.6 % away";
  EXPECT_EQ(uniform[0].mode, 1);
  EXPECT_EQ(uniform[0].zone, 0);
  EXPECT_NEAR(uniform[0].frequency, 0.2 * 3.0 / 0.01905, 1e-9);
  zone.velocity = ScalarVelocity{{{0.2, 0.8}, {2.0, 4.0}}}; // 21.0 to 42.0 Hz
  const auto ramp = found(zone);
  ASSERT_EQ(ramp.size(), 3u);
  EXPECT_NEAR(ramp[2].velocity, 38.0 * 0.01905 / 0.2, 0.02) << "the nearest station";
  zone.fluid = SinglePhase{Phase::gas, tests::constant(36.5), 5e-7};
  EXPECT_TRUE(found(zone).empty());
  tests::expect_error(
      [&] { (void)shedding_coincidences(sample(hand.tube(), Profile({}, 1.0), hand.basis), 0.0); },
      {"Strouhal number = 0", "> 0"});
}

} // namespace
} // namespace fretwork::flow::element_fluid_test
