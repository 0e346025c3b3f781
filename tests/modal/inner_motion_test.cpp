// SPDX-License-Identifier: GPL-3.0-or-later
// Traction and torsion of order 4 whatever joins the beams: closed forms, and fine meshes where there are none.
#include "../fem/model_builder.hpp"
#include "fem/fields.hpp"
#include "fem/inner_motion.hpp"
#include "solve.hpp"
#include <functional>
#include <gtest/gtest.h>

namespace inner_motion_test {

using namespace fretwork;
using namespace fretwork::tests;
using std::numbers::pi;

namespace {

constexpr double length = 2.0; // m

fem::BeamProperty rod(double diameter = 0.03) {
  return {{2.1e11, 0.3, 7800.0}, fem::circle_section(diameter)};
}

/// Traction or torsion of a rod, without its bending.
struct Kind {
  const char* name;
  unsigned held;
  int dof;
  [[nodiscard]] double stiffness(const fem::BeamProperty& p) const {
    return dof == 0 ? p.material.young_modulus * p.section.area
                    : p.material.young_modulus / (2.0 * (1.0 + p.material.poisson_ratio)) *
                          p.section.torsion_constant;
  }
  [[nodiscard]] double mass(const fem::BeamProperty& p) const {
    return p.material.density * (dof == 0 ? p.section.area : p.section.polar_inertia);
  }
  [[nodiscard]] double speed() const { return std::sqrt(stiffness(rod()) / mass(rod())); }
};

const std::array<Kind, 2> kinds{
    {{"traction", uy | uz | rx | ry | rz, 0}, {"torsion", ux | uy | uz | ry | rz, 3}}};

/// The lowest root of f between a and b, f changing its sign once.
double root(const std::function<double(double)>& f, double a, double b) {
  const bool rising = f(a) < 0.0;
  for (int i = 0; i < 200; ++i) {
    const double c = 0.5 * (a + b);
    ((f(c) < 0.0) == rising ? a : b) = c;
  }
  return 0.5 * (a + b);
}

/// Errors of the elastic frequencies that `exact` lists (rad/s).
template <std::size_t n>
std::array<double, n> errors(const fem::Model& model, const std::array<double, n>& exact) {
  const modal::Basis basis = solve(model, static_cast<int>(n));
  std::array<double, n> result{};
  for (std::size_t i = 0; i < n; ++i)
    result[i] = basis.omega[static_cast<Eigen::Index>(i)] / exact[i] - 1.0;
  return result;
}

/// Order of convergence from 32 to 64 elements, for each frequency.
template <std::size_t n>
void expect_order_four(const std::string& what, const std::function<fem::Model(int)>& model,
                       const std::array<double, n>& exact) {
  const auto coarse = errors(model(32), exact), fine = errors(model(64), exact);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(std::log2(std::abs(coarse[i] / fine[i])), 4.0, 0.3) << what << " mode " << i + 1;
  }
}

/// A rod held at one end; the tip as `add` makes it.
fem::Model held_rod(const Kind& kind, int n, const std::function<void(fem::Model&, Index)>& add) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, n, b.property(rod()));
  b.fix_everywhere(kind.held);
  b.fix(nodes.front(), all);
  add(b.model, nodes.back());
  return b.model;
}

} // namespace

TEST(InnerMotion, MakesTractionAndTorsionOfOrderFourAtATipMass) {
  for (const Kind& kind : kinds) {
    const double share = 0.8, mass = kind.mass(rod()) * length / share; // x tan x = share
    std::array<double, 3> exact{};
    for (std::size_t i = 0; i < 3; ++i)
      exact[i] = kind.speed() / length *
                 root([&](double x) { return x * std::sin(x) - share * std::cos(x); },
                      static_cast<double>(i) * pi, (static_cast<double>(i) + 0.5) * pi);
    expect_order_four(
        kind.name + std::string(" with a tip mass"),
        [&](int n) {
          return held_rod(kind, n, [&](fem::Model& model, Index tip) {
            model.masses.push_back(kind.dof == 0 ? fem::LumpedMass{tip, mass}
                                                 : fem::LumpedMass{tip, 0.0, Vec3(mass, 0, 0)});
          });
        },
        exact);
  }
}

TEST(InnerMotion, MakesThemOfOrderFourAtASpring) {
  for (const Kind& kind : kinds) {
    const double share = 3.0, stiffness = share * kind.stiffness(rod()) / length; // x cot x = -share
    std::array<double, 3> exact{};
    for (std::size_t i = 0; i < 3; ++i)
      exact[i] = kind.speed() / length *
                 root([&](double x) { return x * std::cos(x) + share * std::sin(x); },
                      (static_cast<double>(i) + 0.5) * pi, (static_cast<double>(i) + 1.0) * pi);
    expect_order_four(
        kind.name + std::string(" on a spring"),
        [&](int n) {
          return held_rod(kind, n, [&](fem::Model& model, Index tip) {
            fem::Spring spring{tip};
            spring.stiffness[static_cast<std::size_t>(kind.dof)] = stiffness;
            model.springs.push_back(spring);
          });
        },
        exact);
  }
}

TEST(InnerMotion, MakesThemOfOrderFourWhereElementSizesChange) {
  for (const Kind& kind : kinds) {
    const double wave = 0.5 * pi * kind.speed() / length;
    expect_order_four(
        kind.name + std::string(" of two element sizes"),
        [&](int n) {
          ModelBuilder b;
          const Index number = b.property(rod());
          const auto coarse = b.line({0, 0, 0}, {length / 2, 0, 0}, n / 4, number);
          b.line_from(coarse.back(), {length, 0, 0}, 3 * n / 4, number);
          b.fix_everywhere(kind.held);
          b.fix(coarse.front(), all);
          return b.model;
        },
        std::array{wave, 3 * wave, 5 * wave});
  }
}

TEST(InnerMotion, MakesThemOfOrderFourAtAStepOfTheSection) {
  for (const Kind& kind : kinds) {
    const double ratio = kind.stiffness(rod(0.045)) / kind.stiffness(rod()); // tan^2 x, x of half the rod
    const double t = std::atan(std::sqrt(ratio)), unit = 2.0 * kind.speed() / length;
    expect_order_four(
        kind.name + std::string(" with a step"),
        [&](int n) {
          ModelBuilder b;
          const Index thick = b.property(rod(0.045)), thin = b.property(rod());
          const auto first = b.line({0, 0, 0}, {length / 2, 0, 0}, n / 4, thick); // and elements of two sizes
          b.line_from(first.back(), {length, 0, 0}, n / 2, thin);
          b.fix_everywhere(kind.held);
          b.fix(first.front(), all);
          return b.model;
        },
        std::array{unit * t, unit * (pi - t), unit * (pi + t)});
  }
}

namespace {

/// Against a mesh eight times as fine, whose error of order 4 is taken from it.
void expect_order_four_of_fine_meshes(const std::string& what, const std::function<fem::Model(int)>& model,
                                      int coarse, int count) {
  const Eigen::VectorXd one = solve(model(coarse), count).omega, two = solve(model(2 * coarse), count).omega,
                        fine = solve(model(8 * coarse), count).omega;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double exact = fine[i] - (two[i] - fine[i]) / 255.0;
    const double order = std::log2(std::abs((one[i] - exact) / (two[i] - exact)));
    EXPECT_NEAR(order, 4.0, 0.3) << what << " mode " << i + 1;
  }
}

} // namespace

TEST(InnerMotion, MakesAFrameOfOrderFourWhoseModesBendAndStretch) {
  expect_order_four_of_fine_meshes(
      "frame",
      [](int n) {
        ModelBuilder b;
        const Index number = b.property(rod(0.2));
        const auto up = b.line({0, 0, 0}, {0, length, 0}, n, number);
        const auto out = b.line_from(up.back(), {0.7 * length, length, 0}, n, number);
        b.fix_everywhere(uz | rx | ry);
        b.fix(up.front(), all);
        b.model.masses.push_back({out.back(), 200.0});
        return b.model;
      },
      8, 6);
}

namespace {

fem::Model quarter_ring(int n, const fem::BeamProperty& property) {
  ModelBuilder b;
  const Index first = b.node({1, 0, 0});
  b.fix(first, all);
  const auto nodes =
      b.arcs_from(first, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.0, pi / 2, n, b.property(property));
  b.model.masses.push_back({nodes.back(), 300.0, Vec3(1, 1, 1)});
  return b.model;
}

} // namespace

TEST(InnerMotion, MakesAnArcOfOrderFourThatEndsInAMass) {
  expect_order_four_of_fine_meshes(
      "arc", [](int n) { return quarter_ring(n, rod(0.2)); }, 8, 12);
}

// So stout that it matters how a section turns and bends while it moves along the arc.
TEST(InnerMotion, MakesAStoutArcOfOrderFourThatTurnsWithInertia) {
  auto stout = rod(1.0);
  stout.section.rotary_inertia = true;
  expect_order_four_of_fine_meshes(
      "stout arc", [&](int n) { return quarter_ring(n, stout); }, 8, 8);
}

namespace {

/// @param mass  at the tip @param added_mass  per length there, none at the held end
fem::Model tapered_rod(const Kind& kind, int n, double mass, double added_mass) {
  ModelBuilder b;
  auto p = rod(0.06);
  p.taper = fem::Taper{fem::circle_section(0.03)};
  p.added_mass_direction = fem::AddedMass::all;
  p.taper->added_mass = added_mass;
  const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, n, b.property(p));
  for (int i = 0; i < n; ++i)
    b.model.beams[static_cast<std::size_t>(i)].along = {static_cast<double>(i) / n, (i + 1.0) / n};
  b.fix_everywhere(kind.held);
  b.fix(nodes.front(), all);
  b.model.masses.push_back({nodes.back(), mass, Vec3(0.002, 0, 0)});
  return b.model;
}

} // namespace

TEST(InnerMotion, MakesATaperedRodOfOrderFourThatEndsInAMass) {
  for (const Kind& kind : kinds)
    expect_order_four_of_fine_meshes(
        "taper", [&](int n) { return tapered_rod(kind, n, 20.0, 0.0); }, 16, 3);
}

// A straight beam is the closed form however it is computed: as one that tapers from a section to the same section.
TEST(InnerMotion, IsTheSameOnAStraightUniformAxisByGaussPoints) {
  const auto model = [](bool by_points) {
    ModelBuilder b;
    auto p = rod(0.1);
    if (by_points)
      p.taper = fem::Taper{p.section};
    const Index number = b.property(p);
    const auto up = b.line({0, 0, 0}, {0.3, length, 0.1}, 10, number);
    const auto out = b.line_from(up.back(), {length, length, 0}, 7, number);
    b.fix(up.front(), all);
    b.model.masses.push_back({out.back(), 50.0, Vec3(1, 2, 3)});
    return b.model;
  };
  const auto closed = solve(model(false), 20), by_points = solve(model(true), 20);
  for (Eigen::Index i = 0; i < 20; ++i)
    EXPECT_NEAR(by_points.omega[i] / closed.omega[i], 1.0, 1e-11) << i; // round-off of the Gauss points
}

namespace {

/// Rods side by side: some on springs, whose frequencies the matrices have 0.13 % too high, and one with a mass, 0.03 %
/// too low. The mass is the faster by 0.05 %, but by the matrices the slower.
struct TwoOrders {
  ModelBuilder b;
  Index with_mass = -1; ///< its tip
  double omega = 0.0;   ///< of the rod on the softest spring

  explicit TwoOrders(int springs) {
    constexpr int n = 8;
    const Kind& kind = kinds.front();
    const double x_spring = root([](double x) { return x * std::cos(x) + 3.0 * std::sin(x); }, pi / 2, pi),
                 x_mass = root([](double x) { return x * std::sin(x) - 0.8 * std::cos(x); }, 0.0, pi / 2);
    const Index number = b.property(rod());
    Index before = -1;
    const auto add = [&](double l, double y) {
      const auto nodes = b.line({0, y, 0}, {l, y, 0}, n, number);
      for (const Index node : nodes)
        b.fix(node, kind.held);
      b.fix(nodes.front(), all);
      if (before >= 0) // one structure
        b.model.springs.push_back({before, nodes.back(), {}, {1e-3}});
      return before = nodes.back();
    };
    for (int i = 0; i < springs; ++i) {
      add(length, 0.1 * i);
      b.model.springs.push_back(
          {before, -1, {3.0 * (1.0 + 2e-5 * i) * kind.stiffness(rod()) / length}}); // no two equal
    }
    omega = x_spring * kind.speed() / length;
    const double l = length * x_mass / (1.0005 * x_spring);
    with_mass = add(l, -0.1);
    b.model.masses.push_back({before, kind.mass(rod()) * l / 0.8});
  }
};

} // namespace

TEST(InnerMotion, PutsModesInOrder) {
  const TwoOrders rods(1);
  for (const int dense_up_to : {0, 1000}) {
    modal::Wanted wanted{2, std::nullopt};
    wanted.dense_up_to = dense_up_to;
    const auto basis =
        modal::solve_modes(MPI_COMM_SELF, rods.b.model, fem::structures(rods.b.model).at(0), wanted);
    const Eigen::Index mass = basis.row_of(rods.with_mass);
    EXPECT_NEAR(basis.omega[0] / rods.omega, 1.0, 2e-5);
    EXPECT_NEAR(basis.omega[1] / rods.omega, 1.0005, 2e-5);
    EXPECT_LT(std::abs(basis.shapes(mass, 0)), 1e-6 * std::abs(basis.shapes(mass, 1)));
    EXPECT_LT(basis.residuals.maxCoeff(), 1e-9); // of each its own lambda
  }
}

// More rods are slower than the mass than are searched for a single mode, and the matrices have all of them above the cut.
TEST(InnerMotion, MissesNoModeThatItPutsBelowTheCut) {
  constexpr int springs = 24;
  const TwoOrders rods(springs);
  const auto part = fem::structures(rods.b.model).at(0);
  for (const int dense_up_to : {0, 1000}) {
    modal::Wanted one{1, std::nullopt}, below{std::nullopt, 1.0002 * rods.omega / (2.0 * pi)};
    one.dense_up_to = below.dense_up_to = dense_up_to;
    const auto lowest = modal::solve_modes(MPI_COMM_SELF, rods.b.model, part, one);
    EXPECT_NEAR(lowest.omega[0] / rods.omega, 1.0, 1.2e-5) << dense_up_to;
    EXPECT_EQ(modal::solve_modes(MPI_COMM_SELF, rods.b.model, part, below).size(), springs) << dense_up_to;
  }
}

TEST(InnerMotion, MissesNoModeThatItPutsBelowTheCutWhereTheMatricesHaveNone) {
  const Kind& kind = kinds.front();
  const double x = root([](double y) { return y * std::cos(y) + 3.0 * std::sin(y); }, pi / 2, pi);
  const auto model = held_rod(kind, 40, [&](fem::Model& m, Index tip) {
    m.springs.push_back({tip, -1, {3.0 * kind.stiffness(rod()) / length}});
  });
  modal::Wanted wanted{std::nullopt, x * kind.speed() / length * (1.0 + 1e-5) / (2.0 * pi)};
  wanted.dense_up_to = 0; // K and M: 5.2e-5 above
  EXPECT_EQ(modal::solve_modes(MPI_COMM_SELF, model, fem::structures(model).at(0), wanted).size(), 1);
}

TEST(InnerMotion, ChangesNoFrequencyByMoreThanItsBound) {
  const auto stretched = [](int elements, double mass, double spring) {
    return held_rod(kinds.front(), elements, [&](fem::Model& m, Index tip) {
      m.masses.push_back({tip, mass});
      m.springs.push_back({tip, -1, {spring}});
    });
  };
  double nearest = 0.0;
  for (const auto& model :
       {stretched(1, 0.01, 0.0), stretched(3, 100.0, 1e3), stretched(4, 0.01, 1e12), stretched(8, 5.0, 1e8),
        quarter_ring(3, rod(0.2)), quarter_ring(6, rod(0.05)), tapered_rod(kinds.front(), 1, 3e4, 300.0),
        tapered_rod(kinds.front(), 2, 3e4, 300.0)}) {
    const auto part = fem::structures(model).at(0);
    const auto basis = solve_up_to(model, 1e6);
    const Eigen::VectorXd lambda = fem::twice_strain_energy(model, part, basis.shapes);
    const auto changed = fem::with_inner_motion(model, part, basis.shapes, lambda).lambda;
    const double scale = fem::inner_motion_scale(model, part);
    for (Eigen::Index i = 0; i < lambda.size(); ++i) {
      const double change = std::abs(changed[i] - lambda[i]);
      const double of_lambda = fem::largest_inner_change(scale, lambda[i]) * lambda[i],
                   of_changed = fem::largest_inner_change(scale, changed[i]) * changed[i];
      EXPECT_LE(change, of_lambda * (1.0 + 1e-9)) << i << ": " << changed[i] / lambda[i];
      EXPECT_LE(change, of_changed * (1.0 + 1e-9)) << i << ": " << changed[i] / lambda[i];
      nearest = std::max(nearest, change / of_lambda);
    }
  }
  EXPECT_GT(nearest, 0.8); // no wider than need be
}

// Bars of one element each, all of whose modes the motion inside may put before the tenth one: no Krylov space holds that many.
TEST(InnerMotion, TakesADenseSolveWhereItMayReorderNearlyAllModes) {
  constexpr int bars = 60;
  ModelBuilder b;
  const Index number = b.property(rod());
  for (int i = 0; i < bars; ++i) {
    const double y = 0.1 * i;
    const auto nodes = b.line({0, y, 0}, {1.0 + 5e-4 * i, y, 0}, 1, number);
    b.fix(nodes.front(), all);
    b.fix(nodes.back(), kinds.front().held);
    if (i > 0) // one structure
      b.model.springs.push_back({nodes.back() - 2, nodes.back(), {}, {1e-3}});
  }
  const auto part = fem::structures(b.model).at(0);
  modal::Wanted wanted{9, std::nullopt};
  wanted.dense_up_to = 0;
  const auto iterated = modal::solve_modes(MPI_COMM_SELF, b.model, part, wanted);
  wanted.dense_up_to = bars;
  const auto dense = modal::solve_modes(MPI_COMM_SELF, b.model, part, wanted);
  EXPECT_TRUE(iterated.omega == dense.omega);
}

} // namespace inner_motion_test
