// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/sectors.hpp"
#include <limits>
#include <random>

namespace sectors_test {

using namespace fretwork;
using namespace fretwork::wear;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double round_off = 1e-12; ///< of sums of 1e5 terms

} // namespace

TEST(SectorWork, PutsAnglesWhereTheyBelong) {
  const SectorWork four(4); // -180..-90..0..90..180
  EXPECT_EQ(four.sector_of(-pi), 0u);
  EXPECT_EQ(four.sector_of(-135.0 * degree), 0u);
  EXPECT_EQ(four.sector_of(-0.5 * pi), 1u); // the lower limit belongs to the sector
  EXPECT_EQ(four.sector_of(-1e-12), 1u);
  EXPECT_EQ(four.sector_of(0.0), 2u);
  EXPECT_EQ(four.sector_of(135.0 * degree), 3u);
  EXPECT_EQ(four.sector_of(pi), 3u);
  EXPECT_EQ(four.sector_of(225.0 * degree), 0u); // beyond the turn
  EXPECT_EQ(four.sector_of(-3.0 * pi + 0.1), 0u);
  EXPECT_EQ(SectorWork(1).sector_of(2.0), 0u);
  const SectorWork many(SectorWork::most);
  EXPECT_EQ(many.sector_of(std::nextafter(pi, 0.0)), many.size() - 1);
}

TEST(SectorWork, HasTheMiddleOfEachSectorInIt) {
  for (const int n : {1, 3, 7, 36, 3600}) {
    const SectorWork sectors(n);
    for (std::size_t k = 0; k < sectors.size(); ++k) {
      EXPECT_EQ(sectors.sector_of(sectors.middle(k)), k);
      EXPECT_LE(std::abs(sectors.middle(k)), pi);
    }
    EXPECT_NEAR(sectors.width() * n, 2.0 * pi, round_off);
  }
}

TEST(SectorWork, SumsToTheTotal) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> angle(-pi, pi), work(0.0, 1e-6);
  SectorWork sectors(36);
  double total = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double w = work(generator);
    sectors.add(angle(generator), w);
    total += w;
  }
  EXPECT_NEAR(sectors.total() / total, 1.0, round_off);
  double rates = 0.0;
  for (const double rate : sectors.rates(4.0))
    rates += rate;
  EXPECT_NEAR(rates * 4.0 / total, 1.0, round_off);
  // alike all round: each sector has its share, to some deviations of a sum of n uniform numbers
  const double share = total / 36.0, deviation = share * std::sqrt((1.0 + 1.0 / 3.0) / (100000.0 / 36.0));
  for (const double w : sectors.work())
    EXPECT_NEAR(w, share, 4.0 * deviation);
}

TEST(SectorWork, CountsOnlyWork) {
  SectorWork sectors(4);
  sectors.add(std::numeric_limits<double>::quiet_NaN(), 0.0); // an open contact has no angle
  sectors.add(0.1, 2.0);
  EXPECT_EQ(sectors.total(), 2.0);
  EXPECT_EQ(sectors.work()[2], 2.0);
}

TEST(SectorWork, LiesOppositeToTheNormal) {
  EXPECT_NEAR(contact_angle(-1.0, 0.0), 0.0, 1e-15); // a circle touched on the side of y_loc
  EXPECT_NEAR(contact_angle(0.0, -1.0), 0.5 * pi, 1e-15);
  EXPECT_NEAR(std::abs(contact_angle(1.0, 0.0)), pi, 1e-15);
}

TEST(SectorWork, IsSavedAndRestored) {
  SectorWork sectors(5), restored(5);
  sectors.add(1.0, 3.0);
  core::StateArchive saved;
  sectors.visit(saved);
  core::StateArchive reader(std::move(saved).bytes());
  restored.visit(reader);
  reader.end();
  EXPECT_EQ(restored.work()[3], 3.0);
}

TEST(SectorWork, RefusesWhatMakesNoSense) {
  expect_refused([] { SectorWork(0); }, {"0 sectors", "from 1 to 3600"});
  expect_refused([] { SectorWork(3601); }, {"3601 sectors"});
  expect_refused([] { (void)SectorWork(4).rates(0.0); }, {"length of the window = 0 s"});
}

} // namespace sectors_test
