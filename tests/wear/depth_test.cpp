// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/cross_section.hpp"
#include "wear/depth.hpp"
#include <cmath>
#include <limits>
#include <numbers>

namespace depth_test {

using namespace fretwork::wear;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double radius = 9.525e-3, clearance = 2e-4, length = 8e-3, slope = 0.5 * degree;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr double round_off = 1e-14;
constexpr double quadrature = 1e-12; ///< of integrals along the scar
/// Of a depth from its volume: the bracket ends at some ulps of ln p, the volume has the digits that the crescent
/// loses to c/R.
constexpr double round_trip = 1e-11;

/// Every geometry, straight and inclined.
std::vector<Geometry> geometries() {
  return {FlatBar{radius, length},
          FlatBar{radius, length, slope},
          DrilledHole{radius, clearance, length},
          DrilledHole{radius, clearance, length, slope},
          Lands{radius, clearance, length, 10.0 * degree},
          Lands{radius, clearance, length, 10.0 * degree, 3},
          Lands{radius, clearance, length, 10.0 * degree, 4, slope},
          Lands{radius, clearance, length, 10.0 * degree, 4, 0.0, {5.0 * degree, 40.0 * degree}},
          Ring{radius, length},
          TubeOnTube{radius, 7.0 * degree},
          TubeSector{radius, length, 36.0 * degree},
          SupportSector{radius + clearance, length, 36.0 * degree}};
}

Geometry scaled(const Geometry& geometry, double factor) {
  return std::visit(
      [=](auto g) -> Geometry {
        if constexpr (requires { g.radius; })
          g.radius *= factor;
        else
          g.hole_radius *= factor;
        if constexpr (requires { g.length; })
          g.length *= factor;
        if constexpr (requires { g.clearance; })
          g.clearance *= factor;
        return g;
      },
      geometry);
}

} // namespace

TEST(Depth, IsTheInverseOfTheVolumeOverDecades) {
  for (const Form form : {Form::exact, Form::reference})
    for (const auto& geometry : geometries())
      for (double p = 1e-12; p < 0.9 * largest_depth(geometry, form); p *= 7.0) {
        const auto back = depth(geometry, volume(geometry, p, form), form);
        ASSERT_TRUE(back) << name_of(geometry) << " " << p;
        EXPECT_NEAR(*back / p, 1.0, round_trip) << name_of(geometry) << " " << p;
      }
}

TEST(Depth, HasTheVolumeItWasAskedForOverDecades) {
  for (const Form form : {Form::exact, Form::reference})
    for (const auto& geometry : geometries()) {
      const double most = volume(geometry, largest_depth(geometry, form), form);
      for (double v = 1e-25; v < most; v *= 10.0)
        EXPECT_NEAR(volume(geometry, *depth(geometry, v, form), form) / v, 1.0, 3.0 * round_trip)
            << name_of(geometry) << " " << v; // V goes with p^2.5 at most
    }
}

TEST(Depth, GrowsWithTheVolume) {
  for (const Form form : {Form::exact, Form::reference})
    for (const auto& geometry : geometries()) {
      const double most = volume(geometry, largest_depth(geometry, form), form);
      double before = 0.0;
      for (double v = 1e-20; v < most; v *= 2.0) {
        const double p = *depth(geometry, v, form);
        EXPECT_GT(p, before) << name_of(geometry) << " " << v;
        before = p;
      }
    }
}

TEST(Depth, OfNoVolumeIsZeroAndOfTooMuchIsNone) {
  for (const Form form : {Form::exact, Form::reference})
    for (const auto& geometry : geometries()) {
      EXPECT_EQ(depth(geometry, 0.0, form), 0.0);
      EXPECT_EQ(volume(geometry, 0.0, form), 0.0);
      const double most = largest_depth(geometry, form), v = volume(geometry, most, form);
      EXPECT_EQ(depth(geometry, v, form), most) << name_of(geometry);
      EXPECT_FALSE(depth(geometry, v * (1.0 + 1e-9), form)) << name_of(geometry);
    }
  EXPECT_EQ(largest_depth(DrilledHole{radius, clearance, length, slope}, Form::reference), length * slope);
  EXPECT_EQ(largest_depth(DrilledHole{radius, clearance, length, slope}), radius);
}

TEST(Depth, OfAVolumeNearTheSmallestNumberIsFinite) {
  for (const auto& geometry : geometries())
    for (const double v : {std::numeric_limits<double>::denorm_min(), 1e-310, 1e-300}) {
      const double p = *depth(geometry, v);
      EXPECT_GT(p, 0.0) << name_of(geometry);
      EXPECT_LT(p, 1e-100) << name_of(geometry); // V goes with p^2.5 at most
    }
}

TEST(Depth, ScalesWithTheSize) {
  constexpr double factor = 1000.0; // m to mm
  for (const Form form : {Form::exact, Form::reference})
    for (const auto& geometry : geometries())
      EXPECT_NEAR(volume(scaled(geometry, factor), 5e-5 * factor, form) /
                      (volume(geometry, 5e-5, form) * factor * factor * factor),
                  1.0, quadrature)
          << name_of(geometry);
}

TEST(Volume, OfAnInclinedBarIsTheIntegralOfItsSegments) {
  // int A_s dp = R^3 (sin f - f cos f - sin^3 f/3), cos f = 1 - p/R
  const auto primitive = [](double p) {
    const double f = std::acos(1.0 - p / radius), s = std::sin(f);
    return radius * radius * radius * (s - f * std::cos(f) - s * s * s / 3.0);
  };
  constexpr double cancelled = 1e-9; // the primitive goes with f^5 and is made of terms of f^3
  for (const double p : {1e-3, 3e-3, 9e-3})
    for (const double theta : {2.0 * degree, 20.0 * degree}) {
      const double exact = (primitive(p) - primitive(std::max(0.0, p - length * theta))) / theta;
      EXPECT_NEAR(volume(FlatBar{radius, length, theta}, p) / exact, 1.0, cancelled) << p << " " << theta;
    }
}

TEST(Volume, TendsToThatWithoutInclination) {
  for (const auto& [flat, inclined] :
       {std::pair<Geometry, Geometry>{FlatBar{radius, length}, FlatBar{radius, length, 1e-12}},
        {DrilledHole{radius, clearance, length}, DrilledHole{radius, clearance, length, 1e-12}},
        {Lands{radius, clearance, length, 0.2}, Lands{radius, clearance, length, 0.2, 4, 1e-12}}})
    for (const double p : {1e-5, 4e-4}) {
      const double lost = 2.0 * length * 1e-12 / p; // of the depth at the far end, to the power 1.5
      EXPECT_NEAR(volume(inclined, p) / volume(flat, p), 1.0, lost + quadrature) << name_of(flat) << " " << p;
      if (std::holds_alternative<FlatBar>(flat)) { // a difference of powers over the inclination
        constexpr double differenced = 1e-3;       // 1e-16/(B theta/p) at p = 4e-4
        EXPECT_NEAR(volume(inclined, p, Form::reference) / volume(flat, p, Form::reference), 1.0,
                    5.0 * differenced);
      }
    }
}

TEST(Volume, OfAnInclinedScarThatEndsWithinTheSupportIgnoresItsLength) {
  for (const double p : {1e-6, 2e-5}) {
    ASSERT_LT(p, length * slope);
    for (const double longer : {2.0, 5.0})
      EXPECT_NEAR(volume(DrilledHole{radius, clearance, longer * length, slope}, p) /
                      volume(DrilledHole{radius, clearance, length, slope}, p),
                  1.0, round_off);
    // areas go with p^1.5 as p -> 0: V = (2/5) p A/theta
    if (p < 1e-5) {
      EXPECT_NEAR(volume(FlatBar{radius, length, slope}, p) / (0.4 * p * segment_area(radius, p) / slope),
                  1.0, p / radius);
      EXPECT_NEAR(volume(TubeOnTube{radius, slope}, p) / volume(FlatBar{radius, length, slope}, p), 1.0,
                  p / radius);
    }
  }
}

TEST(Volume, OfAnInclinedScarIsTheSumOfItsSlices) {
  constexpr int slices = 4000;
  constexpr double summed = 1e-5; // midpoint rule on areas that end as u^1.5
  const auto straight = [](Geometry g) {
    std::visit(
        [](auto& one) {
          if constexpr (requires { one.inclination; })
            one.inclination = 0.0;
        },
        g);
    return g;
  };
  const Lands lands{radius, clearance, length, 10.0 * degree, 4, slope, {3.0 * degree, 40.0 * degree}};
  for (const Geometry& inclined : {Geometry(FlatBar{radius, length, slope}),
                                   Geometry(DrilledHole{radius, clearance, length, slope}), Geometry(lands)})
    for (const double p : {4e-5, 4e-4}) {
      const double touched = std::min(length, p / slope), ds = touched / slices;
      double sum = 0.0;
      for (int k = 0; k < slices; ++k)
        sum += volume(straight(inclined), p - slope * (k + 0.5) * ds) / length * ds;
      EXPECT_NEAR(volume(inclined, p) / sum, 1.0, summed) << name_of(inclined) << " " << p;
    }
}

TEST(Volume, OfLandsIsThatOfTheirParts) {
  const double p = 3e-4, b = 10.0 * degree;
  const Lands one{radius, clearance, length, b}, wide{radius, clearance, length, 80.0 * degree};
  EXPECT_NEAR(volume(wide, p) / volume(DrilledHole{radius, clearance, length}, p), 1.0, quadrature);
  Lands three = one;
  three.middles = {0.0, 2.0 * b, -2.0 * b}; // side by side
  EXPECT_NEAR(volume(three, p) / volume(Lands{radius, clearance, length, 3.0 * b}, p), 1.0, quadrature);
  Lands turned = one;
  turned.middles = {2.0 * pi};
  EXPECT_NEAR(volume(turned, p) / volume(one, p), 1.0, quadrature);
  Lands opposite = one;
  opposite.middles = {0.0, pi, 0.5 * pi, -0.5 * pi}; // the other three are beyond the scar
  EXPECT_EQ(volume(opposite, p), volume(one, p));
}

TEST(Volume, OfAllSectorsIsThatOfTheRing) {
  const double p = 2e-4;
  EXPECT_NEAR(10.0 * volume(TubeSector{radius, length, 36.0 * degree}, p) / volume(Ring{radius, length}, p),
              1.0, round_off);
  EXPECT_NEAR(*depth(SupportSector{radius, length, 2.0 * pi}, 1e-7),
              std::sqrt(radius * radius + 1e-7 / (pi * length)) - radius, 1e-17);
}

TEST(Volume, OfTheReferenceFormTendsToTheExactOne) {
  const double p = 1e-9; // p/R, p/c: below 1e-5
  constexpr double next_term = 1e-5;
  EXPECT_NEAR(volume(FlatBar{radius, length}, p) / volume(FlatBar{radius, length}, p, Form::reference), 1.0,
              next_term);
  EXPECT_NEAR(volume(FlatBar{radius, length, slope}, p) /
                  volume(FlatBar{radius, length, slope}, p, Form::reference),
              1.0, next_term);
  EXPECT_NEAR(volume(Ring{radius, length}, p) / volume(Ring{radius, length}, p, Form::reference), 1.0,
              next_term);
  // factors without geometric meaning
  const Geometry hole = DrilledHole{radius, clearance, length};
  EXPECT_NEAR(volume(hole, p, Form::reference) / volume(hole, p), 2.0, next_term);
  const Geometry four = Lands{radius, clearance, length, 0.2},
                 three = Lands{radius, clearance, length, 0.2, 3};
  EXPECT_NEAR(volume(four, p, Form::reference) / volume(four, p), 1.0,
              2.0 * std::sqrt(next_term)); // p^2 tan b
  EXPECT_NEAR(volume(four, p, Form::reference) / volume(three, p, Form::reference), 2.0, round_off);
  const Geometry inclined = DrilledHole{radius, clearance, length, slope};
  EXPECT_NEAR(volume(inclined, p, Form::reference) / volume(inclined, p), 5.0 / 3.0, next_term);
  const Geometry four_inclined = Lands{radius, clearance, length, 0.2, 4, slope},
                 three_inclined = Lands{radius, clearance, length, 0.2, 3, slope};
  const double area = crescent_area(radius, clearance, p) + p * p * std::tan(0.2);
  EXPECT_NEAR(volume(three_inclined, p, Form::reference) / (p * area / (6.0 * slope)), 1.0, round_off);
  EXPECT_NEAR(volume(four_inclined, p, Form::reference) / (p * area / (3.0 * slope)), 1.0, round_off);
}

TEST(Depths, AreSharedAsTheVolumes) {
  const SharedScar scar_of_both{DrilledHole{radius, clearance, length}};
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    const double v = 1e-9;
    const auto shared = depths(scar_of_both, share * v, v - share * v);
    ASSERT_TRUE(shared);
    EXPECT_NEAR(shared->total(), *depth(scar_of_both.geometry, v), 1e-18);
    EXPECT_NEAR(shared->tube, share * shared->total(), 1e-18);
  }
  EXPECT_EQ(depths(scar_of_both, 0.0, 0.0)->total(), 0.0);
  EXPECT_FALSE(depths(scar_of_both, 1.0, 1.0));
  const SectorPair sectors{{radius, length, 0.5}, {radius + clearance, length, 0.5}};
  EXPECT_EQ(depths(sectors, 1e-9, 0.0)->support, 0.0);
  EXPECT_EQ(depths(sectors, 1e-9, 1e-8)->tube, depths(sectors, 1e-9, 0.0)->tube);
  EXPECT_FALSE(depths(sectors, 1.0, 0.0));
  EXPECT_FALSE(depths(sectors, 0.0, 1.0));
  EXPECT_EQ(largest_depth(sectors), radius);
}

TEST(Scar, HasItsWidthAndLength) {
  const double p = 2e-5;
  const double chord = 2.0 * std::sqrt(2.0 * radius * p - p * p);
  EXPECT_NEAR(scar(FlatBar{radius, length}, p).width, chord, round_off * chord);
  EXPECT_EQ(scar(FlatBar{radius, length}, p).length, length);
  EXPECT_EQ(scar(FlatBar{radius, length, slope}, p).length, p / slope);
  EXPECT_EQ(scar(FlatBar{radius, length, slope}, 1e-4).length, length);
  EXPECT_NEAR(radius * std::sin(scar(FlatBar{radius, length}, p).half_angle), 0.5 * chord, round_off);
  const Scar in_hole = scar(DrilledHole{radius, clearance, length}, p);
  EXPECT_EQ(in_hole.width, 2.0 * (radius + clearance) * in_hole.half_angle);
  const Lands lands{radius, clearance, length, 10.0 * degree};
  EXPECT_NEAR(scar(lands, 1e-4).width, (radius + clearance) * 20.0 * degree, round_off); // the whole land
  EXPECT_NEAR(scar(lands, 1e-7).width, scar(DrilledHole{radius, clearance, length}, 1e-7).width, round_off);
  EXPECT_EQ(scar(Ring{radius, length}, p).width, 2.0 * pi * radius);
  EXPECT_EQ(scar(TubeOnTube{radius, slope}, p).length, p / slope);
  EXPECT_EQ(scar(TubeSector{radius, length, 0.5}, p).width, 0.5 * radius);
  EXPECT_EQ(scar(SupportSector{radius, length, 0.5}, p).length, length);
  EXPECT_EQ(scar(FlatBar{radius, length}, 0.0).width, 0.0);
}

TEST(Geometry, RefusesSizesThatMakeNoSense) {
  const auto refused = [](const Geometry& geometry, std::initializer_list<const char*> parts,
                          Form form = Form::exact) { expect_refused([&] { check(geometry, form); }, parts); };
  refused(FlatBar{0.0, length}, {"flat bar", "tube radius = 0 m", "> 0"});
  refused(FlatBar{not_a_number, length}, {"tube radius = nan m"});
  refused(FlatBar{radius, -1.0}, {"flat bar", "length of the support = -1 m"});
  refused(FlatBar{radius, length, -0.1}, {"inclination = -0.1 rad", ">= 0", "(90 degrees)"});
  refused(FlatBar{radius, length, 0.5 * pi}, {"inclination", "(90 degrees) makes no sense"});
  refused(FlatBar{radius, length, not_a_number}, {"inclination = nan"});
  refused(DrilledHole{radius, 0.0, length}, {"drilled hole", "clearance = 0 m", "\"ring\""});
  refused(DrilledHole{radius, -1e-4, length}, {"clearance = -0.0001 m"});
  refused(DrilledHole{-1.0, clearance, length}, {"drilled hole", "tube radius"});
  refused(DrilledHole{radius, clearance, length, 2.0}, {"drilled hole", "inclination"});
  refused(Lands{radius, clearance, length, 0.0}, {"lands", "half-angle of a land = 0 rad", "> 0"});
  refused(Lands{radius, 0.0, length, 0.1}, {"lands", "clearance = 0 m"});
  refused(Lands{radius, clearance, 0.0, 0.1}, {"lands", "length of the support"});
  refused(Lands{radius, clearance, length, 0.1, 4, -1.0}, {"lands", "inclination"});
  refused(Lands{radius, clearance, length, 0.1, 4, 0.0, {0.5, 1.0}},
          {"none of the 2 worn lands", "half-angle 5.7", "direction of penetration"});
  refused(Lands{radius, clearance, length, 0.1, 5}, {"3 and 4 lands, not 5", "exact"}, Form::reference);
  refused(Ring{radius, 0.0}, {"ring", "length of the support = 0 m"});
  refused(TubeOnTube{radius, 0.0},
          {"crossing angle = 0 degrees", "parallel tubes", "(inclination), > 0, or leave the contact out"});
  refused(TubeOnTube{0.0, 0.1}, {"tube on tube", "tube radius"});
  refused(TubeOnTube{radius, 2.0}, {"crossing angle = 2 rad"});
  refused(TubeSector{radius, length, 7.0}, {"tube sector", "angle = 7 rad", "360 degrees"});
  refused(SupportSector{0.0, length, 1.0}, {"support sector", "hole radius = 0 m"});
  refused(SupportSector{radius, length, 0.0}, {"support sector", "angle = 0 rad"});
  refused(SupportSector{radius, 0.0, 1.0}, {"support sector", "length"});
}

TEST(Depth, RefusesVolumesAndDepthsThatMakeNoSense) {
  const Geometry bar = FlatBar{radius, length};
  expect_refused([&] { (void)depth(bar, -1e-9); }, {"flat_bar", "worn volume = -1e-09 m3", ">= 0"});
  expect_refused([&] { (void)depth(bar, not_a_number); }, {"worn volume = nan"});
  expect_refused([&] { (void)volume(bar, -1e-6); }, {"flat_bar", "depth = -1e-06 m"});
  expect_refused([&] { (void)volume(bar, 0.01); }, {"depth = 0.01 m is beyond", "at most 0.009525 m"});
  expect_refused([&] { (void)scar(bar, 0.01); }, {"beyond"});
  expect_refused([&] { (void)depths(SharedScar{bar}, -1.0, 0.0); }, {"worn volume of the tube"});
  expect_refused([&] { (void)depths(SharedScar{bar}, 0.0, -1.0); }, {"worn volume of the support"});
  expect_refused(
      [&] {
        check(Pairing(SectorPair{{radius, length, 1.0}, {0.0, length, 1.0}}));
      },
      {"support sector"});
  expect_refused([&] { check(Pairing(SharedScar{FlatBar{0.0, length}})); }, {"flat bar"});
}

} // namespace depth_test
