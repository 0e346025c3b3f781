// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/coefficients.hpp"
#include <set>
#include <utility>

namespace coefficients_test {

using namespace fretwork::wear;

TEST(Coefficients, AreFoundByClassAndPair) {
  EXPECT_EQ(coefficient("flat_bar", "600_600").value, 120e-15);
  EXPECT_EQ(coefficient("flat_bar", "690_405").value, 0.41e-15);
  EXPECT_EQ(coefficient("drilled_hole", "600_600").value, 160e-15);
  EXPECT_EQ(coefficient("four_lands", "690_405").value, 7.8e-15);
  EXPECT_EQ(coefficient("three_lands", "690_Z10C13").value, 0.24e-15);
  EXPECT_EQ(coefficient("tube_on_tube", "690_690").value, 1e-12);
  EXPECT_EQ(coefficient("any", "690_304").value, 16.2e-15);
  EXPECT_EQ(coefficient("any", "690_304").source, "published abstract: tube on steel 304 in cold water");
  EXPECT_EQ(coefficient("flat_bar", "600_600").source, "Code_Aster 17, POST_USURE");
}

TEST(Coefficients, AreAllThereOnce) {
  constexpr std::size_t rows = 13 + 5 + 5 + 2 + 2 + 2; // by class
  EXPECT_EQ(coefficients().size(), rows);
  std::set<std::pair<std::string_view, std::string_view>> seen;
  for (const auto& row : coefficients()) {
    EXPECT_TRUE(seen.emplace(row.geometry, row.materials).second) << row.materials;
    EXPECT_GT(row.value, 1e-17); // m2/N, of the published range
    EXPECT_LE(row.value, 1e-12);
    EXPECT_FALSE(row.source.empty());
    EXPECT_EQ(&coefficient(row.geometry, row.materials), &row);
  }
}

TEST(Coefficients, ThatDoNotExistAreRefusedWithThoseThatDo) {
  expect_refused(
      [] { (void)coefficient("flat_barr", "600_600"); },
      {"no geometry class \"flat_barr\"", "did you mean \"flat_bar\"?", "\"drilled_hole\"", "\"any\""});
  expect_refused([] { (void)coefficient("drilled_hole", "690_405"); },
                 {"the class \"drilled_hole\" has no pair tube_support \"690_405\"",
                  "\"690_Z10C13\", \"600_600\"",
                  "the pair has a coefficient for \"flat_bar\", \"four_lands\"", "in m2/N"});
  const std::string message = message_of([] { (void)coefficient("tube_on_tube", "800_800"); });
  EXPECT_EQ(message.find("the pair has"), std::string::npos) << message;
}

TEST(Coefficients, HaveTheClassOfAGeometry) {
  EXPECT_EQ(coefficient_class(FlatBar{0.01, 0.01}), "flat_bar");
  EXPECT_EQ(coefficient_class(DrilledHole{0.01, 1e-4, 0.01}), "drilled_hole");
  EXPECT_EQ(coefficient_class(Ring{0.01, 0.01}), "drilled_hole");
  EXPECT_EQ(coefficient_class(Lands{0.01, 1e-4, 0.01, 0.1}), "four_lands");
  EXPECT_EQ(coefficient_class(Lands{0.01, 1e-4, 0.01, 0.1, 3}), "three_lands");
  EXPECT_EQ(coefficient_class(TubeOnTube{0.01, 0.1}), "tube_on_tube");
  expect_refused(
      [] {
        (void)coefficient_class(Lands{0.01, 1e-4, 0.01, 0.1, 6});
      },
      {"no class for 6 lands", "\"four_lands\""});
  expect_refused(
      [] {
        (void)coefficient_class(TubeSector{0.01, 0.01, 0.1});
      },
      {"no class for the geometry \"tube_sector\"", "in m2/N"});
}

} // namespace coefficients_test
