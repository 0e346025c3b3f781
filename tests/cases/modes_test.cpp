// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies of published and closed-form cases (doc/validation.md). Each comparison is also a recorded
// property of its test, so that the report of a test run is the table of validation.
#include "../fem/model_builder.hpp"
#include "frequencies.hpp"
#include <array>

namespace modes_test {

using namespace fretwork;
using namespace fretwork::tests;
using std::numbers::pi;

namespace {

/// References are printed with so many digits (5e-10 of the shortest number with ten digits, and so on).
constexpr double ten_digits = 2e-9;
constexpr double six_digits = 5e-6;
constexpr double five_digits = 2e-5;

struct Span {
  const char* name;
  unsigned left, right;
  int rigid;
  std::array<double, 5> roots;
};

const std::array<Span, 6> spans{{
    {"clamped_free", all, 0, 0, {1.8751040687, 4.6940911330, 7.8547574382, 10.9955407349, 14.1371683910}},
    {"clamped_clamped",
     all,
     all,
     0,
     {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574}},
    {"free_free", 0, 0, 2, {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574}},
    {"clamped_pinned", all, uy, 0, {3.9266023120, 7.0685827456, 10.2101761228, 13.3517687778, 16.4933614313}},
    {"pinned_free", uy, 0, 1, {3.9266023120, 7.0685827456, 10.2101761228, 13.3517687778, 16.4933614313}},
    {"pinned_pinned", uy, uy, 0, {pi, 2 * pi, 3 * pi, 4 * pi, 5 * pi}},
}};

/// Relative errors of the first five elastic frequencies of a span in one plane, n elements.
std::vector<double> span_errors(const Span& span, int n) {
  constexpr double length = 2.0;
  ModelBuilder b;
  const fem::BeamProperty p = tube_property();
  const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, n, b.property(p));
  b.fix_everywhere(ux | uz | rx | ry);
  b.fix(nodes.front(), span.left);
  b.fix(nodes.back(), span.right);
  const modal::Basis basis = modes(b.model, 5 + span.rigid);
  for (int i = 0; i < span.rigid; ++i)
    EXPECT_EQ(basis.omega[i], 0.0) << span.name;
  std::vector<double> errors;
  for (std::size_t i = 0; i < 5; ++i) {
    const double wave = span.roots[i] / length;
    const double exact =
        wave * wave *
        std::sqrt(p.material.young_modulus * p.section.iz / (p.material.density * p.section.area));
    errors.push_back(basis.omega[static_cast<Eigen::Index>(i) + span.rigid] / exact - 1.0);
  }
  return errors;
}

} // namespace

// Hermite elements with consistent mass: relative error of f = (beta L / n)^4 / 1440 + O(n^-6).
TEST(CaseD1, SpansConvergeAsTheTheoryOfTheElementSays) {
  constexpr double next_term = 0.05; // the O(n^-6) term at 8 elements, first mode
  for (const Span& span : spans)
    for (const int n : {8, 16}) {
      const double expected = std::pow(span.roots[0] / n, 4) / 1440.0;
      const double error = span_errors(span, n)[0];
      testing::Test::RecordProperty(std::string(span.name) + "_" + std::to_string(n),
                                    std::to_string(error / expected));
      EXPECT_NEAR(error / expected, 1.0, next_term) << span.name << " " << n;
    }
}

TEST(CaseD1, SpansConvergeWithOrderFour) {
  for (const Span& span : spans) {
    const auto coarse = span_errors(span, 16), fine = span_errors(span, 32);
    for (std::size_t i = 0; i < 5; ++i) {
      const double order = std::log2(coarse[i] / fine[i]);
      EXPECT_GT(order, 3.7) << span.name << " mode "
                            << i + 1; // the fifth mode has three elements a half wave
      EXPECT_LT(order, 4.3) << span.name << " mode " << i + 1;
    }
  }
}

TEST(CaseD1, ClampedFreeErrorsAreThePublishedOnes) {
  const std::array<std::array<double, 4>, 3> published{{{3.3e-5, 1.2e-3, 7.7e-3, 1.45e-2},
                                                        {2.1e-6, 8.0e-5, 6.1e-4, 2.2e-3},
                                                        {1.3e-7, 5.1e-6, 4.0e-5, 1.5e-4}}};
  constexpr double two_digits = 0.04; // as published
  for (std::size_t k = 0; k < 3; ++k) {
    const auto errors = span_errors(spans[0], 4 << k);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(errors[i] / published[k][i], 1.0, two_digits) << (4 << k) << " elements, mode " << i + 1;
  }
}

// (beta L / n)^4 / 1440 and the next term of the series, which a mesh of 64 elements gives: what is left is round-off.
TEST(CaseD1, FineMeshesKeepNineDigits) {
  constexpr double nine_digits = 1e-9;
  for (const Span& span : spans) {
    const auto coarse = span_errors(span, 64);
    double worst = 0.0;
    for (const int n : {100, 200, 500, 1000, 2000}) {
      const auto errors = span_errors(span, n);
      for (std::size_t i = 0; i < 3; ++i) {
        const double first = std::pow(span.roots[i], 4) / 1440.0,
                     next = (coarse[i] - first * std::pow(64, -4)) * std::pow(64, 6);
        const double left = errors[i] - first * std::pow(n, -4) - next * std::pow(n, -6);
        worst = std::max(worst, std::abs(left));
        EXPECT_LT(std::abs(left), nine_digits) << span.name << " " << n << " elements, mode " << i + 1;
      }
    }
    testing::Test::RecordProperty(span.name, std::to_string(worst * 1e9) + "e-9");
  }
}

TEST(CaseD2, CantileverFoldedBackOnItself) {
  ModelBuilder b;
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::rectangle_section(0.005, 0.05)};
  p.orientation = Vec3(0, 1, 0);
  const Index number = b.property(p);
  const auto out = b.line({0, 0, 0}, {0.5, 0, 0}, 10, number);
  b.line_from(out.back(), {0, 0, 0}, 10, number);
  b.fix_everywhere(uz | rx | ry);
  b.fix(out.front(), all);
  expect_frequencies(
      "D2", hertz(modes(b.model, 8)),
      {11.7641834, 11.7641834, 105.88113, 105.881204, 294.177995, 294.180626, 576.980227, 577.007934},
      2e-8); // the reference has eight to nine digits
}

namespace {

/// Frequencies of D4, a cantilever of length 10 m, with the mass at its tip or without it.
std::vector<double> cantilever_frequencies(int elements, double tip_mass) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {10, 0, 0}, elements,
                            b.property({{2.1e11, 0.3, 7800.0}, fem::pipe_section(0.35, 0.015)}));
  b.fix(nodes.front(), all);
  if (tip_mass > 0.0)
    b.model.masses.push_back({nodes.back(), tip_mass});
  return hertz(modes(b.model, 16));
}

/// sqrt(E/rho)/40 m and sqrt(G/rho)/40 m: a quarter of a wave over the bar.
constexpr double quarter_traction = 129.7186304156927, quarter_torsion = 80.44807947443034;

/// Relative error of the found frequency nearest to an exact one.
double nearest_error(const std::vector<double>& found, double exact) {
  double best = 1.0;
  for (const double f : found)
    if (std::abs(f / exact - 1.0) < std::abs(best))
      best = f / exact - 1.0;
  return best;
}

} // namespace

TEST(CaseD4, CantileverWithTipMass) {
  const auto found = cantilever_frequencies(20, 1000.0);
  expect_frequencies("D4_bending",
                     {found[0], found[1], found[2], found[3], found[4], found[5], found[8], found[9]},
                     {1.655433398, 1.655433398, 16.071161667, 16.071161667, 50.023996028, 50.023996028,
                      103.204375129, 103.204375129},
                     ten_digits);
  expect_frequency("D4_traction", found[6], 76.47055423642874, 1e-8); // closed form x tan x = m/M
  expect_frequency("D4_torsion", found[7], quarter_torsion, 3e-8);    // (k h)^4/1440: 2.7e-8
}

TEST(CaseD4, TractionAndTorsionConvergeWithOrderFour) {
  for (const double exact : {quarter_traction, quarter_torsion}) {
    double before = 0.0;
    for (const int n : {5, 10, 20, 40}) {
      const double error = nearest_error(cantilever_frequencies(n, 0.0), exact);
      const double wave = pi / 2 / n; // k h
      EXPECT_NEAR(error * 1440.0 / std::pow(wave, 4), 1.0, 0.6 * wave * wave + 0.01) << n << " elements";
      if (n > 5) {
        EXPECT_NEAR(std::log2(before / error), 4.0, 0.1) << n << " elements";
      }
      before = error;
    }
  }
}

TEST(CaseD5, FreeRingOfArcs) {
  const auto solve = [](int arcs) {
    ModelBuilder b;
    const Index number = b.property({{2.0e11, 0.3, 8000.0}, fem::circle_section(0.1)});
    const Index first = b.node({1, 0, 0});
    const auto nodes = b.arcs_from(first, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.0,
                                   2 * pi * (arcs - 1) / arcs, arcs - 1, number);
    const double t = 2 * pi * (arcs - 0.5) / arcs;
    b.model.beams.push_back({nodes.back(), first, number, Vec3(std::cos(t), std::sin(t), 0)});
    auto found = hertz(modes(b.model, 18));
    EXPECT_EQ(found[5], 0.0);
    found.erase(found.begin(), found.begin() + 6);
    return found;
  };
  std::vector<double> published;
  for (const double f : {51.849, 53.382, 148.77, 150.99, 286.98, 289.51})
    published.insert(published.end(), 2, f);
  expect_frequencies("D5_24_arcs", solve(24), published, 3e-3); // thin-ring formula
}

TEST(CaseD5, FreeRing) {
  ModelBuilder b;
  const Index number = b.property({{2.0e11, 0.3, 8000.0}, fem::circle_section(0.1)});
  const Index first = b.node({1, 0, 0});
  const auto nodes =
      b.arc_from(first, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.0, 2 * pi * 79 / 80, 79, number);
  b.model.beams.push_back({nodes.back(), first, number});
  const auto found = hertz(modes(b.model, 18));
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(found[i], 0.0);
  const std::vector<double> elastic(found.begin() + 6, found.end());
  std::vector<double> published, same_mesh;
  for (const double f : {51.849, 53.382, 148.77, 150.99, 286.98, 289.51})
    published.insert(published.end(), 2, f);
  for (const double f : {51.789, 53.381, 148.500, 150.951, 286.362, 289.407})
    same_mesh.insert(same_mesh.end(), 2, f);
  expect_frequencies("D5", elastic, published, 3e-3); // thin-ring formula, in the out-of-plane modes
  expect_frequencies("D5_80_chords", elastic, same_mesh, five_digits);
}

TEST(CaseD6, PipeBendWithStraightLegs) {
  const auto solve = [](double leg, int chords, int arcs) {
    ModelBuilder b;
    const Index number = b.property({{2.1e11, 0.3, 7800.0}, fem::pipe_section(0.02, 0.002)});
    Index at = b.node({0, -leg, 0});
    b.fix(at, all);
    if (leg > 0) {
      at = b.line_from(at, {0, 0, 0}, 20, number).back();
      b.fix(at, ux | uz);
    }
    at = (arcs > 0 ? b.arcs_from(at, {1, 0, 0}, -Vec3::UnitX(), Vec3::UnitY(), 0.0, pi / 2, arcs, number)
                   : b.arc_from(at, {1, 0, 0}, -Vec3::UnitX(), Vec3::UnitY(), 0.0, pi / 2, chords, number))
             .back();
    if (leg > 0) {
      b.fix(at, uy | uz);
      at = b.line_from(at, {1 + leg, 1, 0}, 20, number).back();
    }
    b.fix(at, all);
    return hertz(modes(b.model, 4));
  };
  constexpr double chords = 5e-4;  // of 60 chords a quarter
  constexpr double printed = 3e-4; // the printed values lie as far above the limit of ever shorter chords
  expect_frequencies("D6_L0_arcs", solve(0.0, 0, 12), {44.1454, 119.6016, 126.0029, 226.3892}, printed);
  expect_frequencies("D6_L0.6_arcs", solve(0.6, 0, 12), {33.2159, 94.1322, 98.8820, 182.9861}, printed);
  constexpr double extrapolated = 2e-6; // of 60 and 120 chords, and of 48 arcs
  for (const double leg : {0.0, 0.6}) {
    const auto coarse = solve(leg, 60, 0), fine = solve(leg, 120, 0), arcs = solve(leg, 0, 48);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(arcs[i] / (fine[i] + (fine[i] - coarse[i]) / 3.0), 1.0, extrapolated) << leg << " " << i;
  }
  expect_frequencies("D6_L0", solve(0.0, 60, 0), {44.1454, 119.6016, 126.0029, 226.3892}, chords);
  expect_frequencies("D6_L0.6", solve(0.6, 60, 0), {33.2159, 94.1322, 98.8820, 182.9861}, chords);
}

TEST(CaseD7, ClampedHalfCircle) {
  for (const bool arcs : {false, true}) {
    ModelBuilder b;
    const fem::BeamProperty p{{2.0e11, 0.3, 8000.0}, fem::circle_section(0.01)};
    const Index first = b.node({1, 0, 0});
    const Index number = b.property(p);
    const auto nodes =
        arcs ? b.arcs_from(first, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.0, pi, 32, number)
             : b.arc_from(first, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.0, pi, 100, number);
    b.fix(first, all);
    b.fix(nodes.back(), all);
    const double unit =
        std::sqrt(p.material.young_modulus * p.section.iy / (p.material.density * p.section.area)) /
        (2.0 * pi);
    auto found = hertz(modes(b.model, 8));
    for (double& f : found)
      f /= unit;
    expect_frequencies(arcs ? "D7_arcs" : "D7", found,
                       {4.38443, 9.65190, 17.92179, 27.52389, 1.81934, 5.25086, 11.02457, 18.90877},
                       arcs ? 3e-4 : 1e-3); // thin ring: axial strain is left out of the formula
  }
}

TEST(CaseD8, PinEndedDoubleCross) {
  ModelBuilder b;
  const Index number = b.property({{2.0e11, 0.3, 8000.0}, fem::rectangle_section(0.125, 0.125)});
  const Index centre = b.node(Vec3::Zero());
  for (int arm = 0; arm < 8; ++arm) {
    const Vec3 end(5 * std::cos(arm * pi / 4), 5 * std::sin(arm * pi / 4), 0);
    b.fix(b.line_from(centre, end, 4, number).back(), ux | uy);
  }
  b.fix_everywhere(uz | rx | ry);
  const auto found = hertz(modes(b.model, 16));
  std::vector<double> published{11.336, 45.345}, same_mesh{11.339, 17.692, 17.692, 45.524, 57.427, 57.427};
  published.insert(published.end(), 7, 17.709);
  published.insert(published.end(), 7, 57.390);
  same_mesh.insert(same_mesh.end(), 5, 17.721);
  same_mesh.insert(same_mesh.end(), 5, 57.748);
  expect_frequencies("D8", found, published, 7e-3);            // four elements an arm, as the benchmark asks
  expect_frequencies("D8_4_elements", found, same_mesh, 4e-5); // of five printed digits
}

TEST(CaseA5, ChainOfMasses) {
  ModelBuilder b;
  for (int i = 0; i < 10; ++i) {
    const Index n = b.node({0.1 * i, 0, 0});
    b.fix(n, uy | uz | rx | ry | rz | (i == 0 || i == 9 ? ux : 0u));
    if (i > 0 && i < 9)
      b.model.masses.push_back({n, 10.0});
    if (i > 0)
      b.model.springs.push_back({n - 1, n, {1e5}, {i == 1 ? 250.0 : i == 9 ? 25.0 : 50.0}});
  }
  const modal::Basis basis = modes(b.model, 8);
  std::vector<double> exact;
  for (int n = 1; n <= 8; ++n)
    exact.push_back(std::sqrt(1e5 / 10.0) * std::sin(n * pi / 18) / pi);
  expect_frequencies("A5", hertz(basis), exact, 1e-13); // a closed form, eight unknowns
  // trace of C / M: every mass has its two dampers
  EXPECT_NEAR(basis.damping_matrix.trace(), (300.0 + 6 * 100.0 + 75.0) / 10.0, 1e-10);
  EXPECT_GT(basis.damping_matrix.cwiseAbs().maxCoeff(), 0.0);
}

TEST(CaseB2, CantileverHeldAtItsTip) {
  const auto solve = [](int elements, double stiffness) {
    ModelBuilder b;
    const auto nodes =
        b.line({0, 0, 0}, {1, 0, 0}, elements, b.property({{1e10, 0.3, 1e6}, fem::circle_section(0.2)}));
    b.fix_everywhere(ux | uz | rx | ry);
    b.fix(nodes.front(), all);
    b.model.springs.push_back({nodes.back(), -1, {0.0, stiffness}, {}});
    return hertz(modes(b.model, 4));
  };
  expect_frequencies("B1_10_elements", solve(10, 0.0), {2.7980, 17.5351, 49.1096}, five_digits);
  expect_frequencies("B2_80_elements", solve(80, 1e8), {10.8921, 26.6883, 52.8922, 98.0103}, six_digits);
}

} // namespace modes_test
