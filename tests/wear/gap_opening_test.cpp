// SPDX-License-Identifier: GPL-3.0-or-later
// The advance against one law without feedback, and against the differential equation with it.
#include "refusal.hpp"
#include "wear/gap_opening.hpp"
#include "wear/sectors.hpp"
#include <array>
#include <cmath>
#include <numbers>

namespace gap_opening_test {

using namespace fretwork;
using namespace fretwork::wear;

namespace {

constexpr double radius = 9.525e-3, clearance = 2e-4, length = 8e-3, wall = 1.09e-3;
constexpr double horizon = 60.0 * year;
constexpr double bracketed = 1e-9; ///< of times and depths from roots: some times the 1e-11 of a depth

Place hole_place(double gap = clearance) {
  return {{SharedScar{DrilledHole{radius, clearance, length}}, Archard{2e-14}, wall, Archard{1e-14}}, gap};
}
Place sector_place() {
  const double angle = 2.0 * std::numbers::pi / 36.0;
  return {{SectorPair{{radius, length, angle}, {radius + clearance, length, angle}}, Archard{2e-14}, wall,
           Archard{1e-14}},
          clearance};
}

/// Advances until it ends; work rates from the gap.
template <class WorkRateOf>
std::pair<PlaceState, double> worn_to_the_end(const Place& place, AdvanceOptions options,
                                              WorkRateOf work_rate_of, int& advances) {
  PlaceState state = new_place(place);
  double time = 0.0;
  for (advances = 0; advances < 10000; ++advances) {
    const Advance next =
        advance(std::array{place}, std::array{state}, std::array{work_rate_of(state.gap)}, options);
    state = next.states[0];
    time += next.time;
    options.horizon -= next.time;
    if (next.progress != Progress::go_on)
      break;
  }
  return {state, time};
}

} // namespace

TEST(GapOpening, GoesUpToItsShareOfTheGapOrTheWall) {
  const auto first = [](const Place& place, AdvanceOptions options) {
    return advance(std::array{place}, std::array{new_place(place)}, std::array{2e-3}, options);
  };
  const Advance by_gap = first(hole_place(), {horizon});
  EXPECT_EQ(by_gap.limit, AdvanceLimit::gap);
  EXPECT_EQ(by_gap.progress, Progress::go_on);
  EXPECT_NEAR(by_gap.states[0].depth.total() / (0.1 * clearance), 1.0, bracketed);
  EXPECT_NEAR(by_gap.states[0].gap, 1.1 * clearance, bracketed * clearance);
  const Advance by_wall = first(hole_place(1e-3), {horizon});
  EXPECT_EQ(by_wall.limit, AdvanceLimit::wall);
  EXPECT_NEAR(by_wall.states[0].depth.total() / (0.05 * wall), 1.0, bracketed);
  const Advance least = first(hole_place(0.0), {horizon});
  EXPECT_EQ(least.limit, AdvanceLimit::least);
  EXPECT_NEAR(least.states[0].depth.total() / (0.005 * wall), 1.0, bracketed);
  const Advance others = first(hole_place(), {horizon, 0.02, 0.05, 1e-4});
  EXPECT_NEAR(others.states[0].depth.total() / (0.02 * clearance), 1.0, bracketed);
}

TEST(GapOpening, SumsToTheLawWithoutFeedback) {
  for (const Law& law : {Law(Archard{2e-14}), Law(EdfMz{})}) {
    Place place = hole_place();
    place.support.tube = law;
    int advances = 0;
    const auto [state, time] = worn_to_the_end(
        place, {horizon}, [](double) { return 5e-3; }, advances);
    EXPECT_GT(advances, 5);
    const std::array states{OperatingState{1.0, 5e-3}};
    const auto lives = time_to_limit(place.support, states);
    EXPECT_NEAR(time / lives.tube.time, 1.0, bracketed) << name_of(law);
    const auto depth = depth_history(place.support, states, std::array{time})[0];
    EXPECT_NEAR(state.tube_volume / depth.tube_volume, 1.0, bracketed);
    EXPECT_NEAR(state.support_volume / depth.support_volume, 1.0, bracketed);
    EXPECT_NEAR(state.depth.tube / (0.4 * wall), 1.0, bracketed);
    EXPECT_NEAR(state.age / time, 1.0, bracketed);
    EXPECT_NEAR(state.gap, clearance + depth.depth->total(), bracketed * wall);
  }
}

// Given gaps are those of the worn tube: they open by what it goes on to lose.
TEST(GapOpening, GoesOnFromInitialWear) {
  Place place = hole_place();
  place.support.initial_depth = 0.2 * wall;
  const std::vector<OperatingState> loads{{1.0, 5e-3}};
  const PlaceState start = place_at_start(place, loads);
  EXPECT_NEAR(start.depth.tube / (0.2 * wall), 1.0, bracketed);
  EXPECT_NEAR(start.depth.support / (0.1 * wall), 1.0, bracketed);
  EXPECT_EQ(start.gap, clearance);
  EXPECT_NEAR(time_to_limit(place, start, loads) / time_to_limit(place.support, loads).tube.time, 1.0,
              bracketed);
  const PlaceState same = place_of_age(place, loads, start.age);
  EXPECT_EQ(same.depth.tube, start.depth.tube);
  EXPECT_EQ(same.gap, clearance);
  const Advance next = advance(std::array{place}, std::array{start}, std::array{loads}, {horizon});
  EXPECT_EQ(next.limit, AdvanceLimit::gap);
  EXPECT_NEAR(next.states[0].gap / clearance, 1.1, bracketed);
  EXPECT_NEAR(next.states[0].opened / (0.1 * clearance), 1.0, bracketed * wall / clearance);
  EXPECT_NEAR(next.states[0].depth.total(), start.depth.total() + 0.1 * clearance, bracketed * wall);
}

TEST(GapOpening, ConvergesWithTheFirstPowerOfTheShares) {
  // A sector, linear in V to p/R: W = W0 (g0/g)^2, dp/dt = k W, so that g^3 = g0^3 + 3 k W0 g0^2 t.
  Place place = sector_place();
  place.support.tube = Archard{2e-15};
  place.support.support = Archard{0.0};
  const double w0 = 2e-3, angle = std::get<SectorPair>(place.support.pairing).tube.angle;
  const auto slower = [=](double gap) { return w0 * (clearance / gap) * (clearance / gap); };
  // integral of dV/W from 0 to the limit, V = B psi p (2 R - p)/2, by Simpson's rule: the cubic is exact
  const auto integrand = [=](double p) {
    return length * angle * (radius - p) / (2e-15 * slower(clearance + p));
  };
  const double end = 0.4 * wall;
  const double exact = end / 6.0 * (integrand(0.0) + 4.0 * integrand(0.5 * end) + integrand(end));
  double error = 0.0;
  for (const double share : {0.1, 0.05, 0.025, 0.0125, 0.00625}) {
    int advances = 0;
    const auto [state, time] =
        worn_to_the_end(place, {1e6 * year, share, 0.5 * share, 1e-3 * share}, slower, advances);
    EXPECT_NEAR(state.depth.tube / end, 1.0, bracketed);
    const double here =
        exact - time; // the work rate of the start of each advance is the larger: too short a life
    EXPECT_GT(here, 0.0);
    if (error > 0.0) {
      constexpr double order = 0.1; // the last advance is cut short by the limit
      EXPECT_NEAR(std::log2(error / here), 1.0, order) << share;
    }
    error = here;
  }
  EXPECT_LT(error, 0.01 * exact);
}

TEST(GapOpening, EndsWhereTheGeometryStands) {
  const Place place = hole_place();
  const Advance idle = advance(std::array{place}, std::array{new_place(place)}, std::array{0.0}, {horizon});
  EXPECT_EQ(idle.progress, Progress::geometry_stands);
  EXPECT_EQ(idle.states[0].gap, clearance);
  // contacts that lose touch as the gap opens
  int advances = 0;
  const auto [state, time] = worn_to_the_end(
      place, {horizon}, [](double gap) { return gap < 1.5 * clearance ? 2e-3 : 0.0; }, advances);
  EXPECT_GE(state.gap, 1.5 * clearance);
  EXPECT_LT(state.gap, 1.5 * 1.1 * clearance);
  EXPECT_NEAR(time, horizon, 1.0); // s: the rest of it at rest
}

TEST(GapOpening, EndsAtTheHorizonOrTheLimit) {
  const Place place = hole_place();
  const Advance last = advance(std::array{place}, std::array{new_place(place)}, std::array{2e-3}, {1.0});
  EXPECT_EQ(last.progress, Progress::horizon_reached);
  EXPECT_EQ(last.limit, AdvanceLimit::horizon);
  EXPECT_EQ(last.time, 1.0);
  int advances = 0;
  const auto [state, time] = worn_to_the_end(
      place, {1e6 * year}, [](double) { return 2e-3; }, advances);
  const Advance again = advance(std::array{place}, std::array{state}, std::array{2e-3}, {horizon});
  EXPECT_EQ(again.progress, Progress::life_reached); // and stays there
  EXPECT_EQ(again.limit, AdvanceLimit::life);
  EXPECT_LT(again.time, bracketed * time);
  EXPECT_EQ(advance(std::array{place}, std::array{state}, std::array{0.0}, {horizon}).progress,
            Progress::life_reached);
}

TEST(GapOpening, IsSetByThePlaceThatWearsFastest) {
  const std::array places{hole_place(), hole_place(), hole_place()};
  const std::array states{new_place(places[0]), new_place(places[1]), new_place(places[2])};
  const Advance next = advance(places, states, std::array{1e-3, 4e-3, 2e-3}, {horizon});
  EXPECT_EQ(next.place, 1u);
  EXPECT_EQ(next.limit, AdvanceLimit::gap);
  EXPECT_NEAR(next.states[1].depth.total() / (0.1 * clearance), 1.0, bracketed);
  EXPECT_NEAR(next.states[1].tube_volume / next.states[0].tube_volume, 4.0, bracketed);
  const Advance alone =
      advance(std::span(places).subspan(1, 1), std::span(states).subspan(1, 1), std::array{4e-3}, {horizon});
  EXPECT_NEAR(alone.time / next.time, 1.0, bracketed);
}

TEST(GapOpening, TakesSeveralOperatingStates) {
  const std::array place{hole_place()};
  const std::array state{new_place(place[0])};
  const std::vector<std::vector<OperatingState>> loads{{{0.5, 3e-3}, {0.5, 1e-3}}};
  EXPECT_NEAR(advance(place, state, loads, {horizon}).time /
                  advance(place, state, std::array{2e-3}, {horizon}).time,
              1.0, bracketed);
}

TEST(GapOpening, SaysWhereALawDoesNotApply) {
  std::array places{hole_place(), hole_place()};
  places[1].support.tube = EdfMz{};
  const std::array states{new_place(places[0]), new_place(places[1])};
  const Advance next = advance(places, states, std::array{2e-3, 2e-3}, {horizon});
  ASSERT_EQ(next.outside.size(), 1u);
  EXPECT_EQ(next.outside[0].place, 1u);
  EXPECT_EQ(next.outside[0].law.law, "edf_mz");
  EXPECT_EQ(next.states[1].tube_volume, 0.0);
  EXPECT_GT(next.states[1].support_volume, 0.0);
}

TEST(GapOpening, OfSectorsIsAProfile) {
  constexpr std::size_t n = 36;
  const std::vector<Place> places(n, sector_place());
  std::vector<PlaceState> states;
  for (const auto& place : places)
    states.push_back(new_place(place));
  std::vector<double> work_rates(n, 0.0);
  const SectorWork angles(n);
  work_rates[angles.sector_of(0.5)] = 2e-3;
  const Advance next = advance(places, states, work_rates, {horizon});
  const auto points = opened_profile(next.states);
  ASSERT_EQ(points.size(), n);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(points[k].angle, angles.middle(k));
    EXPECT_NEAR(points[k].radius, k == angles.sector_of(0.5) ? 1.1 * clearance : clearance,
                bracketed * clearance);
  }
  const contact::Profile profile(points);
  EXPECT_NEAR(profile.inscribed(), clearance * std::cos(std::numbers::pi / n), 1e-3 * clearance);
  expect_refused([&] { (void)opened_profile(std::span(states).subspan(0, 2)); },
                 {"2 sectors do not enclose a hole"});
}

// An inclined scar of the reference form is described up to B theta = 0.3 mm for both bodies together, the limit of the tube alone is 0.28 mm.
TEST(GapOpening, LifeIsReachedAtTheLimitOnly) {
  constexpr double thin = 7e-4, limit = 0.4 * thin, deepest = 0.03 * 0.01;
  int reached = 0, beyond = 0;
  for (int k = 0; k < 60; ++k) {
    const double tube = 1e-14 * std::pow(1.2, k), support = 3e-14;
    const Place place{{SharedScar{DrilledHole{radius, clearance, 0.03, 0.01}, Form::reference}, Archard{tube},
                       thin, Archard{support}},
                      clearance};
    const std::vector<OperatingState> loads{{1.0, 5e-3}};
    const double time = time_to_limit(place, new_place(place), loads);
    if (limit * (tube + support) / tube > deepest) { // p_t = p K_t/(K_t + K_s)
      EXPECT_TRUE(std::isnan(time)) << tube << ": " << time / year << " years";
      ++beyond;
      continue;
    }
    ++reached;
    const auto then = state_after(place, new_place(place), loads, time);
    ASSERT_TRUE(then) << tube;
    EXPECT_NEAR(then->depth.tube / limit, 1.0, bracketed) << tube;
  }
  EXPECT_GT(beyond, 10);
  EXPECT_GT(reached, 10);
}

TEST(GapOpening, HasNoLifeWhereTheTubeDoesNotWear) {
  Place place = hole_place();
  place.support.tube = Archard{0.0};
  const std::vector<OperatingState> loads{{1.0, 5e-3}};
  EXPECT_TRUE(std::isinf(time_to_limit(place, new_place(place), loads)));
  EXPECT_TRUE(std::isinf(
      time_to_limit(hole_place(), new_place(hole_place()), std::vector<OperatingState>{{1.0, 0.0}})));
}

TEST(GapOpening, RefusesWhatMakesNoSense) {
  const std::array place{hole_place()};
  const std::array state{new_place(place[0])};
  const auto refused = [&](AdvanceOptions options, std::initializer_list<const char*> parts) {
    expect_refused([&] { (void)advance(place, state, std::array{1e-3}, options); }, parts);
  };
  refused({0.0}, {"gap opening: horizon = 0 s"});
  refused({1.0, 0.0}, {"gap_share = 0 "});
  refused({1.0, 0.1, -1.0}, {"wall_share = -1"});
  refused({1.0, 0.1, 0.05, 0.0}, {"least_wall_share = 0"});
  refused({1.0, 0.1, 0.05, 0.1}, {"least_wall_share = 0.1 is above wall_share = 0.05"});
  expect_refused(
      [&] {
        (void)advance(place, state, std::array{1e-3, 1e-3}, {1.0});
      },
      {"1 places, 1 states and 2 lists of work rates"});
  expect_refused([&] { (void)advance(place, state, std::array{-1.0}, {1.0}); },
                 {"place 1: ", "work rate = -1 W"});
  std::array thin{hole_place(), hole_place()};
  thin[1].support.wall = 0.0;
  expect_refused(
      [&] {
        (void)advance(thin, std::array{state[0], state[0]}, std::array{1.0, 1.0}, {1.0});
      },
      {"place 2: wear: wall thickness"});
  expect_refused([] { (void)new_place(hole_place(-1.0)); }, {"initial gap = -1 m"});
  // the support alone wears past what an inclined scar of the reference form describes
  Place inclined = hole_place(1.0);
  inclined.support = {SharedScar{DrilledHole{radius, clearance, length, 0.01}, Form::reference}, Archard{0.0},
                      wall, Archard{1e-10}, 0.01};
  expect_refused(
      [&] {
        PlaceState at = new_place(inclined);
        for (int k = 0; k < 5; ++k)
          at = advance(std::array{inclined}, std::array{at}, std::array{1.0}, {horizon}).states[0];
      },
      {"place 1: wear leaves what its geometry describes (depth 8e-05 m)", "exact form"});
}

} // namespace gap_opening_test
