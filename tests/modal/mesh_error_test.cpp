// SPDX-License-Identifier: GPL-3.0-or-later
// The estimated error of a frequency against the true one.
#include "../fem/model_builder.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace mesh_error_test {

using namespace fretwork;
using namespace fretwork::tests;
using std::numbers::pi;

namespace {

struct Ends {
  const char* name;
  unsigned left, right;
  std::array<double, 4> roots;
};

const std::array<Ends, 5> spans{{
    {"clamped_free", all, 0, {1.8751040687119611, 4.694091132974175, 7.854757438237613, 10.995540734875467}},
    {"clamped_clamped",
     all,
     all,
     {4.730040744862704, 7.853204624095838, 10.995607838001671, 14.137165491257464}},
    {"free_free", 0, 0, {4.730040744862704, 7.853204624095838, 10.995607838001671, 14.137165491257464}},
    {"clamped_pinned",
     all,
     uy,
     {3.926602312047919, 7.068582745628732, 10.210176122813031, 13.351768777754093}},
    {"pinned_pinned", uy, uy, {pi, 2 * pi, 3 * pi, 4 * pi}},
}};

/// A span in one plane, its elements of equal or of unequal lengths.
fem::Model span(const Ends& ends, int n, double jitter) {
  ModelBuilder b;
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i)
    points.emplace_back((i + (i % n ? jitter * std::sin(7.0 * i) : 0.0)) / n, 0.0, 0.0);
  const auto nodes = b.chain(points, b.property(tube_property()));
  b.fix_everywhere(ux | uz | rx | ry);
  b.fix(nodes.front(), ends.left);
  b.fix(nodes.back(), ends.right);
  return b.model;
}

double bending_omega(double root) {
  const auto p = tube_property();
  return root * root *
         std::sqrt(p.material.young_modulus * p.section.iz / (p.material.density * p.section.area));
}

/// Estimate over true error of the elastic modes that `exact` lists.
template <std::size_t n>
std::array<double, n> ratios(const modal::Basis& basis, const std::array<double, n>& exact) {
  Eigen::Index rigid = 0;
  while (basis.omega[rigid] == 0.0)
    ++rigid;
  std::array<double, n> result{};
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Index j = rigid + static_cast<Eigen::Index>(i);
    result[i] = basis.error[j] / std::abs(basis.omega[j] / exact[i] - 1.0);
  }
  return result;
}

} // namespace

TEST(MeshError, OfASpanIsTheTrueOneAsTheMeshIsRefined) {
  for (const Ends& ends : spans)
    for (const double jitter : {0.0, 0.3}) {
      std::array<double, 4> exact{};
      for (std::size_t i = 0; i < 4; ++i)
        exact[i] = bending_omega(ends.roots[i]);
      const auto coarse = ratios(solve(span(ends, 8, jitter), 6), exact),
                 fine = ratios(solve(span(ends, 32, jitter), 6), exact);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_GT(coarse[i], 0.5) << ends.name << " mode " << i; // from two elements a half wave on
        EXPECT_LT(coarse[i], 2.0) << ends.name << " mode " << i;
        EXPECT_NEAR(fine[i], 1.0, 0.05) << ends.name << " mode " << i; // the next order: (k L)^2
      }
    }
}

TEST(MeshError, OfTractionAndTorsionToo) {
  const auto p = tube_property();
  const double shear = p.material.young_modulus / (2 * (1 + p.material.poisson_ratio));
  const double traction_speed = std::sqrt(p.material.young_modulus / p.material.density);
  const double torsion_speed =
      std::sqrt(shear * p.section.torsion_constant / (p.material.density * p.section.polar_inertia));
  for (const bool torsion : {false, true}) {
    constexpr double length = 3.0;
    ModelBuilder b;
    constexpr int elements = 6;
    b.line({0, 0, 0}, {length, 0, 0}, elements, b.property(p));
    b.fix_everywhere(uy | uz | ry | rz | (torsion ? ux : rx));
    b.fix(0, all);
    const double wave = pi / length * (torsion ? torsion_speed : traction_speed);
    const std::array exact{0.5 * wave, 1.5 * wave, 2.5 * wave}; // down to 2.4 elements a half wave
    for (const double ratio : ratios(solve(b.model, 3), exact))
      EXPECT_NEAR(ratio, 1.0, 0.05);
  }
}

TEST(MeshError, OfTractionWhereItsForceJumpsIsOfItsOrderOfMagnitude) {
  const auto held_rod = [](int n, bool spring) {
    ModelBuilder b;
    const auto p = tube_property();
    const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, n, b.property(p));
    b.fix_everywhere(uy | uz | rx | ry | rz);
    b.fix(nodes.front(), all);
    if (spring)
      b.model.springs.push_back({nodes.back(), -1, {3.0 * p.material.young_modulus * p.section.area}});
    else
      b.model.masses.push_back({nodes.back(), 1.25 * p.material.density * p.section.area});
    return solve(b.model, 3);
  };
  for (const bool spring : {false, true}) {
    const auto coarse = held_rod(16, spring), fine = held_rod(128, spring);
    for (Eigen::Index i = 0; i < 3; ++i) { // 0.46 (spring, mode 1) to 2.0 (mass, mode 2)
      const double ratio = coarse.error[i] / std::abs(coarse.omega[i] / fine.omega[i] - 1.0);
      EXPECT_GT(ratio, 0.4) << spring << " mode " << i;
      EXPECT_LT(ratio, 2.2) << spring << " mode " << i;
    }
    const auto unresolved = held_rod(4, spring);
    const double true_error = std::abs(unresolved.omega[2] / fine.omega[2] - 1.0);
    EXPECT_GT(true_error,
              0.015); // what the quotient would have changed counts: 4.3 times the true error on the mass
    EXPECT_GT(unresolved.error[2] / true_error, 0.4) << spring;
    EXPECT_LT(unresolved.error[2] / true_error, 4.6) << spring;
  }
}

TEST(MeshError, OfAFrameThatBendsAndStretchesToo) {
  const auto frame = [](int n) {
    ModelBuilder b;
    const Index number = b.property({{2.1e11, 0.3, 7800.0}, fem::circle_section(0.2)});
    const auto up = b.line({0, 0, 0}, {0, 2, 0}, n, number);
    const auto out = b.line_from(up.back(), {1.4, 2, 0}, n, number);
    b.fix_everywhere(uz | rx | ry);
    b.fix(up.front(), all);
    b.model.masses.push_back({out.back(), 200.0});
    return solve(b.model, 6);
  };
  const auto coarse = frame(16), fine = frame(128);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double ratio = coarse.error[i] / std::abs(coarse.omega[i] / fine.omega[i] - 1.0);
    EXPECT_GT(ratio, 0.7) << i;
    EXPECT_LT(ratio, 1.4) << i;
  }
}

TEST(MeshError, OfAnArcIsOfItsOrderOfMagnitude) {
  const auto half_ring = [](int elements) {
    ModelBuilder b;
    const Index number = b.property(tube_property());
    const auto at = [](double share) { return Vec3(std::cos(pi * share), std::sin(pi * share), 0); };
    b.node(at(0.0));
    for (int i = 0; i < elements; ++i) {
      b.node(at((i + 1.0) / elements));
      b.model.beams.push_back({i, i + 1, number, at((i + 0.5) / elements)});
    }
    b.fix(0, all);
    b.fix(elements, all);
    return solve(b.model, 6);
  };
  const auto coarse = half_ring(12), fine = half_ring(72);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double true_error = std::abs(coarse.omega[i] / fine.omega[i] - 1.0);
    EXPECT_GT(coarse.error[i] / true_error, 0.1) << i;
    EXPECT_LT(coarse.error[i] / true_error, 10.0) << i;
  }
}

// Two arcs in a ring, both held where they begin: each turns by half a circle, a bit less, or more.
TEST(MeshError, OfArcsOfHalfACircleAndMoreIsLikeThatOfSmallerOnes) {
  const auto errors = [](double turn) {
    ModelBuilder b;
    const Index number = b.property(tube_property());
    const auto at = [](double t) { return Vec3(std::cos(t), std::sin(t), 0); };
    for (int i = 0; i <= 2; ++i)
      b.node(at(i * turn));
    for (int i = 0; i < 2; ++i)
      b.model.beams.push_back({i, i + 1, number, at((i + 0.5) * turn)});
    b.fix(0, all);
    b.fix(2, all);
    return solve(b.model, 4).error;
  };
  const Eigen::VectorXd less = errors(0.98 * pi), half = errors(pi), more = errors(1.02 * pi);
  for (Eigen::Index i = 0; i < 4; ++i) { // a smooth function of the angle
    EXPECT_GT(half[i], 0.0);
    EXPECT_NEAR(half[i] / (0.5 * (less[i] + more[i])), 1.0, 0.02) << i;
  }
}

TEST(MeshError, OfBeamsThatShearOrAreUnderTensionToo) {
  const auto errors = [](const fem::BeamProperty& p, int n) {
    ModelBuilder b;
    const auto nodes = b.line({0, 0, 0}, {2, 0, 0}, n, b.property(p));
    b.fix_everywhere(ux | uz | rx | ry);
    b.fix(nodes.front(), all);
    b.fix(nodes.back(), uy);
    return solve(b.model, 3);
  };
  auto shearing = tube_property();
  shearing.section = fem::pipe_section(0.2, 0.02);
  shearing.section.shear = fem::ShapeShear{};
  shearing.section.rotary_inertia = true;
  auto taut = tube_property();
  taut.axial_force = 5e3; // some times what it buckles under
  for (const auto& p :
       {shearing, taut}) { // mode 3 has eight elements a half wave, of which the next order is felt
    const auto coarse = errors(p, 24), exact = errors(p, 192);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double true_error = (coarse.omega[i] / exact.omega[i] - 1.0) / (1.0 - 1.0 / 64.0);
      EXPECT_NEAR(coarse.error[i] / true_error, 1.0, 0.15) << p.axial_force << " mode " << i;
    }
  }
}

TEST(MeshError, OfARingOfChordsIsThatOfTheSamePolygon) {
  const auto ring = [](int per_chord) {
    constexpr int chords = 24;
    ModelBuilder b;
    const Index number = b.property(tube_property());
    const auto corner = [](int k) {
      return Vec3(std::cos(2 * pi * k / chords), std::sin(2 * pi * k / chords), 0);
    };
    Index at = b.node(corner(0));
    for (int k = 1; k <= chords; ++k)
      at = b.line_from(at, corner(k), per_chord, number).back();
    b.model.beams.back().b = 0; // closes the ring: its last node falls away
    b.model.nodes.pop_back();
    b.model.fixed.pop_back();
    return solve(b.model, 18);
  };
  const auto coarse = ring(1), fine = ring(6);
  for (Eigen::Index i = 6; i < 18; ++i) {
    const double true_error = coarse.omega[i] / fine.omega[i] - 1.0;
    EXPECT_GT(coarse.error[i] / true_error, 0.5) << i;
    EXPECT_LT(coarse.error[i] / true_error, 2.0) << i;
  }
}

TEST(MeshError, OfARigidMotionIsNone) {
  ModelBuilder b;
  b.line({0, 0, 0}, {1, 0, 0}, 10, b.property(tube_property()));
  const auto basis = solve(b.model, 8);
  EXPECT_TRUE(basis.error.head(6).isZero(0.0));
  EXPECT_GT(basis.error[6], 0.0);
}

} // namespace mesh_error_test
