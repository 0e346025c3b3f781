// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "flow/damping.hpp"
#include "hand_made.hpp"

namespace fretwork::flow::damping_test {
namespace {

using tests::constant;
using tests::HandMade;
using tests::pi;

constexpr double printed = 0.5e-6;  ///< six decimals, per cent
constexpr double round_off = 1e-12; ///< relative, of sums of some hundred terms
constexpr double interpolated =
    1e-8; ///< relative: sines of up to 2 half-waves by 100 Hermite cubics, (2 pi/100)^4/384 twice
constexpr double percent = 100.0;
constexpr double diameter = 0.01905;
const Bundle bundle{Arrangement::square, 1.44 * diameter};
const TwoPhase mixture{{740.0, 36.5, 1.23e-7, 5.2e-7}, GivenVoidFraction{constant(0.5)}};

/// 0.8 kg/m in its fluid.
fem::BeamProperty property() {
  fem::BeamProperty out = tests::tube_property();
  out.material.density = 0.8 / out.section.area;
  return out;
}

HandMade tube_of(const std::vector<double>& frequencies) {
  return tests::pinned_tube(property(), 9.0, 100, frequencies);
}

Zone zone(double from, double to, OuterFluid fluid) {
  Zone out{{"z", from, to}, ScalarVelocity{constant(1.0)}, std::move(fluid)};
  out.bundle = bundle;
  return out;
}

/// Eight supports, 30 mm long, nine spans of 1 m.
std::vector<TubeSupport> supports() {
  std::vector<TubeSupport> out;
  for (int k = 1; k < 9; ++k)
    out.push_back({static_cast<double>(k), 0.03, false});
  return out;
}

Damping damping_of(const HandMade& hand, const std::vector<Zone>& zones, const std::vector<TubeSupport>& at,
                   const DampingOptions& options = {}) {
  const Tube tube = hand.tube();
  const Profile profile(zones, tube.length());
  return damping(tube, profile, sample(tube, profile, hand.basis), at, options);
}

TEST(FlowDamping, OfAUniformFluidHasTheReferenceTotals) {
  const HandMade hand = tube_of({40.0});
  struct Case {
    OuterFluid fluid;
    double total;
  };
  TwoPhase thin = mixture;
  thin.content = GivenVoidFraction{constant(0.85)};
  for (const Case& it : {Case{tests::liquid(740.0), 2.085535}, Case{mixture, 3.042363}, Case{thin, 1.425674},
                         Case{SinglePhase{Phase::gas, constant(36.5), 5.2e-7}, 0.769800}}) {
    const Damping found = damping_of(hand, {zone(0, 9, it.fluid)}, supports());
    EXPECT_EQ(found.layout.spans, 9);
    EXPECT_NEAR(found.layout.mean_span, 1.0, round_off);
    EXPECT_NEAR(percent * found.modes[0].stability, it.total, printed);
    EXPECT_NEAR(percent * found.modes[0].transient, it.total + 0.2, printed);
    EXPECT_TRUE(found.limits.empty());
    EXPECT_EQ(found.stability()(0), found.modes[0].stability);
    EXPECT_EQ(found.transient()(0), found.modes[0].transient);
  }
}

TEST(FlowDamping, WeighsDistributedTermsByTheMode) {
  const HandMade hand = tube_of({40.0, 80.0});
  const auto whole = damping_of(hand, {zone(0, 9, mixture)}, {});
  const auto part = damping_of(hand, {zone(0, 9.0 / 3.0, mixture)}, {});
  for (std::size_t i = 0; i < 2; ++i) {
    const double wave = 2.0 * static_cast<double>(i + 1) * pi,
                 share = 1.0 / 3.0 - std::sin(wave / 3.0) / wave;
    EXPECT_NEAR(part.modes[i].sum.viscous, share * whole.modes[i].sum.viscous,
                interpolated * whole.modes[i].sum.viscous);
    EXPECT_NEAR(part.modes[i].sum.two_phase, share * whole.modes[i].sum.two_phase,
                interpolated * whole.modes[i].sum.two_phase);
  }
}

TEST(FlowDamping, OfAZoneSplitInTwoIsTheSame) {
  const HandMade hand = tube_of({40.0, 80.0});
  const auto whole = damping_of(hand, {zone(1, 8, mixture)}, supports());
  const auto split = damping_of(hand, {zone(1, 3.21, mixture), zone(3.21, 8, mixture)}, supports());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(split.modes[i].stability, whole.modes[i].stability, round_off);
    EXPECT_NEAR(split.modes[i].transient, whole.modes[i].transient, round_off);
    EXPECT_NEAR(split.modes[i].zones[0].total() + split.modes[i].zones[1].total(), whole.modes[i].sum.total(),
                round_off);
  }
}

TEST(FlowDamping, DoesNotChangeWithTheScaleOfShapes) {
  HandMade hand = tube_of({40.0, 80.0});
  const Tube tube = hand.tube();
  const Profile profile({zone(1, 5, tests::liquid(740.0))}, 9.0);
  const Eigen::Vector2d mass(3.6, 3.6), scale(7.0, 0.02);
  const Damping before = damping(tube, profile, sample(tube, profile, hand.basis, mass), supports());
  hand.basis.shapes *= scale.asDiagonal();
  const Damping after =
      damping(tube, profile, sample(tube, profile, hand.basis, mass.cwiseProduct(scale).cwiseProduct(scale)),
              supports());
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(after.modes[i].sum.total(), before.modes[i].sum.total(),
                round_off * before.modes[i].sum.total());
}

TEST(FlowDamping, OfSupportsIsTheirMeanInTheirFluids) {
  const HandMade hand = tube_of({40.0});
  const auto found = damping_of(
      hand,
      {zone(0, 4.5, tests::liquid(740.0)), zone(4.5, 6.5, SinglePhase{Phase::gas, constant(36.5), 5.2e-7})},
      supports());
  // supports at 1..4 in liquid, 5 and 6 in gas, 7 and 8 in none
  const double c = support_factor({9, 1.0}, 0.03);
  EXPECT_NEAR(found.modes[0].zones[0].friction, 4.0 / 8.0 * 0.005 * c, round_off);
  EXPECT_NEAR(percent * found.modes[0].zones[0].squeeze_film, 0.5 * 1.886395, printed);
  EXPECT_NEAR(found.modes[0].zones[1].gas, 2.0 / 8.0 * 0.05 * c, round_off);
  EXPECT_EQ(found.modes[0].zones[1].viscous, 0.0);
  ASSERT_EQ(found.limits.size(), 2u);
  EXPECT_EQ(found.limits[0].kind, LimitKind::support_in_no_fluid);
  EXPECT_EQ(found.limits[0].value, 6.0);
  EXPECT_EQ(found.limits[1].value, 7.0);
}

TEST(FlowDamping, LeavesSupportsModelledAsContactsOutOfTheTransient) {
  const HandMade hand = tube_of({40.0});
  std::vector<TubeSupport> at = supports();
  const Damping none = damping_of(hand, {zone(0, 9, mixture)}, at);
  at[2].contact = at[5].contact = true;
  const Damping two = damping_of(hand, {zone(0, 9, mixture)}, at);
  for (TubeSupport& support : at)
    support.contact = true;
  const Damping all = damping_of(hand, {zone(0, 9, mixture)}, at, {.structure = 0.003});
  const DampingTerms& terms = none.modes[0].sum;
  EXPECT_NEAR(two.modes[0].transient, 0.002 + terms.of_fluid() + 0.75 * terms.of_supports(), round_off);
  EXPECT_NEAR(two.modes[0].contacts.total(), 0.25 * terms.of_supports(), round_off);
  EXPECT_NEAR(all.modes[0].transient, 0.003 + terms.of_fluid(), round_off);
  EXPECT_EQ(all.modes[0].stability, none.modes[0].stability);
}

TEST(FlowDamping, TellsWhereFloorAndCeilingAct) {
  // 4000 Hz leave next to no squeeze film, 2 Hz a lot of it
  const HandMade hand = tube_of({2.0, 4000.0});
  const Damping found = damping_of(hand, {zone(0, 9, tests::liquid(740.0))}, supports());
  ASSERT_EQ(found.limits.size(), 2u);
  EXPECT_EQ(found.limits[0].kind, LimitKind::damping_ceiling);
  EXPECT_EQ(found.limits[0].mode, 0);
  EXPECT_EQ(found.limits[0].value, found.modes[0].sum.total());
  EXPECT_EQ(found.modes[0].stability, 0.05);
  EXPECT_EQ(found.limits[1].kind, LimitKind::damping_floor);
  EXPECT_EQ(found.limits[1].mode, 1);
  EXPECT_LT(found.limits[1].value, 0.006);
  EXPECT_EQ(found.modes[1].stability, 0.006);
  EXPECT_EQ(found.modes[1].transient, 0.002 + found.modes[1].sum.total()) << "no floor in the transient set";

  const Damping gas = damping_of(
      hand, {zone(0, 1, tests::liquid(740.0)), zone(1, 9, SinglePhase{Phase::gas, constant(1.2), 1.5e-5})},
      {{4.5, 1e-6, false}});
  EXPECT_LT(gas.modes[1].stability, 0.006) << "no floor in gas";
  EXPECT_EQ(damping_of(hand, {}, {}).modes[1].stability, 0.0) << "none without fluid";
}

TEST(FlowDamping, TellsWhichRangesAreLeft) {
  const HandMade hand = tube_of({40.0, 80.0});
  Zone thick = zone(0, 9, tests::liquid(740.0, 1e-5)), tight = zone(0, 9, tests::liquid(740.0));
  tight.bundle = {Arrangement::triangle, 1.2 * diameter};
  const Limits stokes = damping_of(hand, {thick}, supports()).limits;
  ASSERT_EQ(stokes.size(), 1u);
  EXPECT_EQ(stokes[0].kind, LimitKind::stokes_number);
  EXPECT_EQ(stokes[0].mode, 0);
  EXPECT_EQ(stokes[0].zone, 0);
  EXPECT_NEAR(stokes[0].value, pi * 40.0 * diameter * diameter / 2e-5, round_off * stokes[0].value);
  const Limits narrow = damping_of(hand, {tight}, supports()).limits;
  ASSERT_EQ(narrow.size(), 1u);
  EXPECT_EQ(narrow[0].kind, LimitKind::confinement);
  EXPECT_NEAR(narrow[0].value, (0.96 + 0.6) * 1.2, round_off);
}

TEST(FlowDamping, TakesTheVoidFractionThatIsAskedFor) {
  const HandMade hand = tube_of({40.0});
  TwoPhase fluid{{740.0, 36.5, 9.1e-5 / 740.0, 5.2e-7, 0.0176}, Quality{constant(0.05), constant(400.0)}};
  const Damping slip = damping_of(hand, {zone(0, 9, fluid)}, {}),
                homogeneous = damping_of(hand, {zone(0, 9, fluid)}, {},
                                         {.void_fraction = DampingVoidFraction::homogeneous});
  constexpr double six_digits = 2e-6; // of 0.374401
  EXPECT_NEAR(slip.modes[0].sum.two_phase / homogeneous.modes[0].sum.two_phase, 0.374401 / 0.4, six_digits)
      << "homogeneous 0.516: h = 1";
  EXPECT_EQ(slip.modes[0].sum.viscous, homogeneous.modes[0].sum.viscous);
}

TEST(FlowDamping, DoesNotAssessModesThatTheFluidDoesNotMeet) {
  HandMade hand = tests::pinned_tube(property(), 9.0, 20, {40.0}, Vec3::UnitZ()); // along the tube
  const Damping along = damping_of(hand, {zone(0, 9, mixture)}, supports());
  EXPECT_FALSE(along.modes[0].assessed);
  EXPECT_EQ(along.modes[0].stability, 0.0);
  EXPECT_EQ(along.modes[0].transient, 0.002);
  hand = tube_of({0.0, 40.0});
  const Damping rigid = damping_of(hand, {zone(0, 9, mixture)}, supports());
  EXPECT_FALSE(rigid.modes[0].assessed);
  EXPECT_TRUE(rigid.modes[1].assessed);
}

TEST(FlowDamping, RefusesWrongSupportsAndOptions) {
  const HandMade hand = tube_of({40.0});
  const auto with = [&](const std::vector<TubeSupport>& at, const DampingOptions& options) {
    return [&hand, at, options] { (void)damping_of(hand, {zone(0, 9, mixture)}, at, options); };
  };
  tests::expect_error(with({{9.5, 0.03, false}}, {}), {"support at s = 9.5 m is not on the tube", "9 m"});
  tests::expect_error(with({{4.5, -0.03, false}}, {}), {"support at s = 4.5 m: length = -0.03 m", ">= 0"});
  tests::expect_error(with({}, {.structure = -0.01}), {"structural damping = -0.01", "from 0 to below 1"});
  tests::expect_error(with({}, {.layout = SpanLayout{0, 1.0}}), {"0 spans of mean length 1 m"});
  tests::expect_error(with({}, {.layout = SpanLayout{3, 0.0}}), {"3 spans of mean length 0 m", "length > 0"});
}

} // namespace
} // namespace fretwork::flow::damping_test
