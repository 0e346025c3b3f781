// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "../fem/model_builder.hpp"
#include "modal/spans.hpp"

namespace spans_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

int longest(const fem::Model& model) {
  return modal::longest_span(model, fem::structures(model).at(0)).elements;
}

/// A clamped tube of n elements along a direction, some of its nodes held.
ModelBuilder tube(int n, const Vec3& direction = Vec3::UnitX()) {
  ModelBuilder b;
  b.line({0, 0, 0}, direction, n, b.property(tube_property()));
  b.fix(0, all);
  return b;
}

} // namespace

TEST(Spans, EndAtWhatHoldsTheTubeAcross) {
  auto b = tube(100);
  EXPECT_EQ(longest(b.model), 100);
  b.fix(40, uy); // one plane still passes
  EXPECT_EQ(longest(b.model), 100);
  b.fix(40, uz);
  EXPECT_EQ(longest(b.model), 60);
  b.model.springs.push_back({70, -1, {0.0, 1e6, 1e6}, {}});
  EXPECT_EQ(longest(b.model), 40);
  b.model.springs.push_back({20, -1, {}, {0.0, 1e6, 1e6}}); // a damper holds nothing
  EXPECT_EQ(longest(b.model), 40);
}

TEST(Spans, EndAtATieAcrossTheTube) {
  auto b = tube(100);
  const auto bar = b.line({0.4, 0, 0}, {0.4, 1, 0}, 10, 0);
  b.model.ties.push_back({40, bar.front(), ux | uy}); // a slide along z
  EXPECT_EQ(longest(b.model), 100);
  b.model.ties.push_back({40, bar.front(), uz});
  EXPECT_EQ(longest(b.model), 60);
  b.model.ties.push_back({bar[4], 70, uy | uz}); // the tube is the second of the two
  EXPECT_EQ(longest(b.model), 40);
}

TEST(Spans, OfAnObliqueTubeAreHeldByAllTranslations) {
  auto b = tube(60, {1, 1, 0});
  b.fix(20, uy | uz);
  EXPECT_EQ(longest(b.model), 60);
  b.fix(20, ux);
  EXPECT_EQ(longest(b.model), 40);
}

TEST(Spans, OfAPlaneModelAreHeldInThatPlane) {
  auto b = tube(50);
  b.fix_everywhere(ux | uz | rx | ry);
  EXPECT_EQ(longest(b.model), 50);
  b.fix(10, uy);
  EXPECT_EQ(longest(b.model), 40);
}

TEST(Spans, EndAtBranchesAndGoRoundARing) {
  auto b = tube(30);
  b.line_from(10, {0, 1, 0}, 25, 0);
  EXPECT_EQ(longest(b.model), 25);
  ModelBuilder ring;
  const Index p = ring.property(tube_property());
  ring.node({1, 0, 0});
  const auto nodes = ring.arc_from(0, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.0, 6.0, 31, p);
  ring.model.beams.push_back({nodes.back(), 0, p});
  EXPECT_EQ(longest(ring.model), 32);
  ring.fix(5, all); // one support: the span goes round from it to itself
  EXPECT_EQ(longest(ring.model), 32);
}

TEST(Spans, OfTooManyElementsAreToldOfOrRefused) {
  const auto warnings = [](int n) {
    const auto b = tube(n);
    return modal::check_spans(b.model, fem::structures(b.model));
  };
  EXPECT_TRUE(warnings(modal::many_elements).empty());
  ASSERT_EQ(warnings(modal::many_elements + 1).size(), 1u);
  EXPECT_NE(warnings(1001)[0].find("the span that starts at (0, 0, 0) has 1001 elements"), std::string::npos);
  EXPECT_EQ(warnings(modal::too_many_elements).size(), 1u);
  expect_error([&] { (void)warnings(modal::too_many_elements + 1); },
               {"(0, 0, 0) has 3001 elements", "mesh it more coarsely"});
}

TEST(Spans, HaveTheLengthBetweenWhatHoldsTheTube) {
  constexpr double round_off = 1e-14;
  auto b = tube(10); // clamped at 0, 1 m long
  b.fix(4, uy | uz);
  b.fix(6, uy); // one plane still passes
  const auto lengths = modal::span_lengths(b.model, fem::structures(b.model).at(0), {2, 4, 6, 7, 10});
  const double expected[] = {0.4, 0.4, 0.6, 0.6, 0.6}; // where spans meet the shorter one
  for (std::size_t i = 0; i < lengths.size(); ++i)
    EXPECT_NEAR(lengths[i], expected[i], round_off) << i;
}

} // namespace spans_test
