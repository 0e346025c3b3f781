// SPDX-License-Identifier: GPL-3.0-or-later
// Printed values: Code_Aster's test ZZZZ405, and values derived independently of this code.
#include "kwu_counts.hpp"
#include "wear/life.hpp"
#include <array>
#include <gtest/gtest.h>
#include <numbers>

namespace reference_cases_test {

using namespace fretwork;
using namespace fretwork::wear;

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double month = 2628000.0; ///< s, a twelfth of a year

/// Half a unit of the last digit of a printed value with so many digits, relative.
constexpr double printed(int digits) {
  double out = 5.0;
  for (int k = 0; k < digits; ++k)
    out *= 0.1;
  return out;
}

void expect_printed(double ours, double reference, int digits) {
  EXPECT_NEAR(ours / reference, 1.0, printed(digits)) << ours << " against " << reference;
}

constexpr FlatBar bar{9.525e-3, 8e-3};
constexpr double wall = 1.09e-3;
constexpr double hole_clearance = 2e-4;

} // namespace

TEST(ReferenceCases, VolumeOfAFlatBarAtFortyPercentOfTheWall) {
  expect_printed(volume(bar, 0.4 * wall), 1.33107140e-8, 9);
  expect_printed(volume(bar, 0.4 * wall, Form::reference), 1.34031213e-8, 9);
}

TEST(ReferenceCases, LifeOnAFlatBarByArchard) {
  WornSupport place{SharedScar{bar}, Archard{2e-14}, wall};
  const OperatingState always{1.0, 2e-3};
  const BodyLives exact = time_to_limit(place, std::span(&always, 1));
  EXPECT_EQ(exact.tube.end, LifeEnd::reached);
  expect_printed(exact.tube.years(), 10.551999, 8);
  place.pairing = SharedScar{bar, Form::reference};
  expect_printed(time_to_limit(place, std::span(&always, 1)).tube.years(), 10.625255, 8);
}

TEST(ReferenceCases, VolumeOfAnInclinedFlatBar) {
  const FlatBar inclined{9.525e-3, 8e-3, 0.5 * degree};
  expect_printed(volume(inclined, 3e-5), 4.15676e-11, 6);
  expect_printed(volume(inclined, 3e-5, Form::reference), 4.15817e-11, 6);
  expect_printed(volume(inclined, 2e-4), 3.132113e-9, 7); // deeper than the inclination lifts the far end
  expect_printed(volume(inclined, 2e-4, Form::reference), 3.140473e-9, 7);
}

TEST(ReferenceCases, DepthSharedByTubeAndBar) {
  const auto shared = depths(SharedScar{bar, Form::reference}, 4e-9, 1e-9);
  ASSERT_TRUE(shared);
  expect_printed(shared->total(), 2.259414e-4, 7);
  expect_printed(shared->tube, 1.807531e-4, 7);
  expect_printed(shared->support, 4.518828e-5, 7);
}

TEST(ReferenceCases, VolumeAndScarOfADrilledHole) {
  const DrilledHole hole{9.525e-3, hole_clearance, 30e-3};
  const double p[] = {1e-5, 1e-4, 4.36e-4};
  const double v[] = {1.19091839e-9, 3.19865901e-8, 2.04120535e-7};
  const double half_angle[] = {17.5632, 47.5275, 69.8834};
  for (int k = 0; k < 3; ++k) {
    expect_printed(volume(hole, p[k]), v[k], 9);
    expect_printed(scar(hole, p[k]).half_angle / degree, half_angle[k], 6);
  }
}

TEST(ReferenceCases, AreaOfOneLand) {
  const double length = 30e-3;
  for (const auto& [half_angle, area] : {std::pair(10.0, 3.35833532e-7), std::pair(20.0, 6.39629233e-7)})
    expect_printed(volume(Lands{9.525e-3, hole_clearance, length, half_angle * degree}, 1e-4) / length, area,
                   9);
}

TEST(ReferenceCases, DepthsInASector) {
  const SectorPair pair{{9.525e-3, 30e-3, 36.0 * degree}, {9.725e-3, 30e-3, 36.0 * degree}};
  const auto shared = depths(pair, 2e-9, 2e-9);
  ASSERT_TRUE(shared);
  expect_printed(shared->tube, 1.11459750e-5, 9);
  expect_printed(shared->support, 1.09042513e-5, 9);
}

TEST(ReferenceCases, VolumesAndLifeByEdfMz) {
  const WornVolume worn = *worn_volume(EdfMz{}, 5e-3).volume;
  expect_printed(worn.at(year), 4.89926788e-9, 9);
  expect_printed(worn.at(5.0 * year), 2.03534430e-8, 9);
  expect_printed(worn.at(20.0 * year), 7.43318422e-8, 9);
  const OperatingState always{1.0, 5e-3};
  const auto life = time_to_limit(WornSupport{SharedScar{bar}, EdfMz{}, wall}, std::span(&always, 1));
  expect_printed(life.tube.years(), 3.089330, 7);
  expect_printed(least_work_rate(EdfMz{}), 3.527e-3, 4);
  EXPECT_TRUE(worn_volume(EdfMz{}, 2e-3).outside);
  const std::array states{OperatingState{0.7, 5e-3}, OperatingState{0.3, 2e-2}};
  expect_printed(worn_volume(EdfMz{}, states).volume->at(10.0 * year), 4.74901858e-8, 9);
}

TEST(ReferenceCases, Zzzz405EdfMzOnAFlatBar) {
  const WornVolume worn = *worn_volume(EdfMz{}, 0.5).volume;
  const double v[] = {9.58595507705e-7, 1.6131418113e-6, 1.75925778387e-6, 1.7962621362e-6};
  const int digits[] = {12, 11, 12, 11};
  for (int k = 0; k < 4; ++k)
    expect_printed(worn.at((2 * k + 1) * year), v[k], digits[k]);
  const double p[] = {1.77037693409e-5, 2.01981942451e-5, 2.07572004243e-5};
  for (int k = 0; k < 3; ++k)
    expect_printed(*depth(FlatBar{1.0, 10.0}, worn.at((2 * k + 2) * year), Form::reference), p[k], 12);
}

TEST(ReferenceCases, Zzzz405ArchardOnAnInclinedFlatBar) {
  const WornVolume worn = *worn_volume(Archard{7.1e-15}, 0.5).volume;
  const double v[] = {2.239056e-7, 4.478112e-7, 6.717168e-7};
  for (int k = 0; k < 3; ++k)
    expect_printed(worn.at((24 * k + 24) * month), v[k], 7);
  const double p[] = {3.67586404898e-4, 5.70437335472e-4, 6.99757307502e-4, 8.00568792779e-4};
  for (int k = 0; k < 4; ++k)
    expect_printed(*depth(FlatBar{1.0, 10.0, degree}, worn.at((24 * k + 12) * month), Form::reference), p[k],
                   12);
}

TEST(ReferenceCases, Zzzz405TubeOnTube) {
  const WornVolume worn = *worn_volume(Archard{1.8e-13}, 0.5).volume;
  const double p[] = {2.91745602948e-3, 4.52744122643e-3, 5.55382666154e-3, 6.35394622974e-3};
  for (int k = 0; k < 4; ++k)
    expect_printed(*depth(TubeOnTube{1.0, 7.0 * degree}, worn.at((2 * k + 1) * year)), p[k], 12);
}

TEST(ReferenceCases, Zzzz405FourLands) {
  const double worn = worn_volume(Archard{6.5e-14}, 0.5).volume->at(365.0 * 86400.0);
  expect_printed(*depth(Lands{1.0, 1.0, 10.0, 3.0 * degree, 4}, worn, Form::reference), 1.138842e-5, 7);
}

TEST(ReferenceCases, KwuEpri) {
  const std::array forces{0.0, 2.0, 9.0, 18.0, 27.0, 36.0, 45.0, 50.0, 12.0, 6.0};
  const std::array speeds{.01, .002, .004, .03, .05, .01, .001, .02, .045, .048};
  const ImpactSliding indices = counted(forces, speeds).indices({4.0, 40.0});
  expect_printed(indices.impact, 298.333333, 9);
  expect_printed(indices.sliding, 0.492777778, 9);
  expect_printed(combined_index(indices), 8.12612852e-4, 9);
}

} // namespace reference_cases_test
