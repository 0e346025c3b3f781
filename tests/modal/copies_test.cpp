// SPDX-License-Identifier: GPL-3.0-or-later
// Equal structures are recognised, solved once, and get the same numbers.
#include "../fem/model_builder.hpp"
#include "modal/copies.hpp"
#include "modal/slepc_structures.hpp"
#include <functional>
#include <gtest/gtest.h>

namespace copies_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

using Numbers = std::vector<std::size_t>;

/// A tube bent by a right angle, with a mass, a spring to its own middle and a damper; the number of its
/// first node.
Index add_tube(ModelBuilder& b, const Vec3& place, Index property, double length = 1.0) {
  const auto leg = b.line(place, place + Vec3(0, 0, length), 20, property);
  const auto arm = b.line_from(leg.back(), place + Vec3(0.4, 0.1, length), 12, property);
  b.fix(leg.front(), all);
  b.fix(leg[10], ux | uy);
  b.model.masses.push_back({arm.back(), 0.7, Vec3(0.1, 0.2, 0.3), Vec3(0, 0, 0.05)});
  b.model.springs.push_back({arm.back(), leg[5], {1e3, 2e3}, {}});
  b.model.springs.push_back({arm[3], -1, {}, {0.0, 4.0}});
  return leg.front();
}

ModelBuilder tubes(int count) {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  for (int i = 0; i < count; ++i)
    add_tube(b, {0.3 * i, -0.1 * i, 0.7}, p);
  return b;
}

Numbers originals_of(const fem::Model& model) { return modal::originals(model, fem::structures(model)); }

/// What becomes of the second of two equal tubes when something of it is changed.
bool still_a_copy(const std::function<void(fem::Model&)>& change) {
  ModelBuilder b = tubes(2);
  change(b.model);
  return originals_of(b.model) == Numbers{0, 0};
}

/// The same with arm and leg of each tube tied somewhere.
bool still_a_copy_with_ties(const std::function<void(fem::Model&)>& change) {
  ModelBuilder b = tubes(2);
  for (const Index first : {0, 33})
    b.model.ties.push_back({first + 30, first + 12, ux | uy});
  change(b.model);
  return originals_of(b.model) == Numbers{0, 0};
}

constexpr std::size_t second = 33; // first node of the second tube

} // namespace

TEST(Copies, AreFoundWhereverTheyStand) {
  EXPECT_EQ(originals_of(tubes(4).model), (Numbers{0, 0, 0, 0}));
  ModelBuilder mixed;
  const Index p = mixed.property(tube_property());
  for (const double length : {1.0, 1.2, 1.0, 1.2, 1.3})
    add_tube(mixed, {length, 0.01 * static_cast<double>(mixed.model.nodes.size()), 0}, p, length);
  EXPECT_EQ(originals_of(mixed.model), (Numbers{0, 1, 0, 1, 4}));
}

TEST(Copies, MayHaveTheirOwnEntryOfEqualProperties) {
  ModelBuilder b = tubes(1);
  add_tube(b, {3, 0, 0}, b.property(tube_property()));
  EXPECT_EQ(originals_of(b.model), (Numbers{0, 0}));
}

TEST(Copies, AreNoneWhereAnythingDiffers) {
  EXPECT_TRUE(still_a_copy([](fem::Model&) {}));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.fixed[second + 10] |= uz; }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.masses[1].mass = std::nextafter(0.7, 1.0); }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.masses[1].arm.z() *= -1.0; }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.springs[2].stiffness[1] = std::nextafter(2e3, 1e4); }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.springs[3].damping[1] = 4.5; }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.springs[2].other += 1; }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { std::swap(m.beams.back().a, m.beams.back().b); }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) {
    m.properties.push_back(m.properties[0]);
    m.properties[1].material.young_modulus = std::nextafter(2e11, 3e11);
    m.beams.back().property = 1;
  }));
  EXPECT_FALSE(still_a_copy([](fem::Model& m) { m.beams.back().along[1] = 0.9; }));
  EXPECT_TRUE(still_a_copy([](fem::Model& m) { m.beams.back().along[1] = std::nextafter(1.0, 0.0); }));
  EXPECT_TRUE(still_a_copy_with_ties([](fem::Model&) {}));
  EXPECT_FALSE(still_a_copy_with_ties([](fem::Model& m) { m.ties[1].dofs = ux; }));
  EXPECT_FALSE(still_a_copy_with_ties([](fem::Model& m) { m.ties[1].other += 1; }));
  EXPECT_FALSE(still_a_copy_with_ties([](fem::Model& m) { m.ties.pop_back(); }));
}

TEST(Copies, MayMissTheirPlaceByRoundOffOnly) {
  const auto moved = [](double distance) {
    return still_a_copy([&](fem::Model& m) { m.nodes[second + 7].z() += distance; });
  };
  const double size = Vec3(0.4, 0.1, 1.0).norm();
  EXPECT_TRUE(moved(0.5 * modal::same_place * size));
  EXPECT_FALSE(moved(2.0 * modal::same_place * size));
}

TEST(Copies, MayHaveArcs) {
  const auto bent = [](double second_middle) {
    ModelBuilder b = tubes(2);
    for (const std::size_t first : {std::size_t{0}, second}) {
      fem::Beam& beam = b.model.beams[first == 0 ? 3 : 35];
      beam.middle = 0.5 * (b.model.nodes[first + 3] + b.model.nodes[first + 4]) + Vec3(1e-3, 0, 0);
    }
    b.model.beams[35].middle->x() += second_middle;
    return originals_of(b.model);
  };
  EXPECT_EQ(bent(0.0), (Numbers{0, 0}));
  EXPECT_EQ(bent(1e-6), (Numbers{0, 1}));
}

TEST(Copies, HaveTheSameBytes) {
  const auto model = tubes(3).model;
  const auto parts = fem::structures(model);
  const auto bases = modal::solve_structures(MPI_COMM_WORLD, model, parts, {8, std::nullopt});
  for (std::size_t s = 0; s < parts.size(); ++s) {
    EXPECT_EQ(bases[s].nodes, parts[s].nodes);
    EXPECT_TRUE(bases[s].shapes == bases[0].shapes);
    EXPECT_TRUE(bases[s].omega == bases[0].omega);
    EXPECT_TRUE(bases[s].damping_matrix == bases[0].damping_matrix);
    EXPECT_TRUE(bases[s].residuals == bases[0].residuals);
  }
}

TEST(Copies, HaveTheModesOfAnOwnSolve) {
  const auto model = tubes(3).model;
  const auto parts = fem::structures(model);
  const auto bases = modal::solve_structures(MPI_COMM_SELF, model, parts, {8, std::nullopt});
  const auto own = modal::solve_modes(MPI_COMM_SELF, model, parts[2], {8, std::nullopt});
  EXPECT_EQ(bases[2].nodes, own.nodes);
  EXPECT_LT((bases[2].omega.array() / own.omega.array() - 1.0).abs().maxCoeff(), 2.0 * modal::same_place);
  EXPECT_LT((bases[2].shapes - own.shapes).cwiseAbs().maxCoeff(), 1e-8 * own.shapes.cwiseAbs().maxCoeff());
}

} // namespace copies_test
