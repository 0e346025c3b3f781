// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies of beams with shear, rotary inertia, axial force and changing sections against closed forms.
#include "../fem/expect_error.hpp"
#include "../fem/model_builder.hpp"
#include "frequencies.hpp"
#include <Eigen/LU>
#include <functional>

namespace section_cases_test {

using namespace fretwork;
using namespace fretwork::tests;
using std::numbers::pi;

namespace {

constexpr double length = 2.0;

/// A span in one plane, n elements.
ModelBuilder span(const fem::BeamProperty& p, int n, unsigned left, unsigned right) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, n, b.property(p));
  for (int i = 0; i < n; ++i)
    b.model.beams[static_cast<std::size_t>(i)].along = {static_cast<double>(i) / n,
                                                        static_cast<double>(i + 1) / n};
  b.fix_everywhere(ux | uz | rx | ry);
  b.fix(nodes.front(), left);
  b.fix(nodes.back(), right);
  return b;
}

fem::BeamProperty stubby(bool shear, bool rotary) {
  fem::BeamProperty p{{2.0e11, 0.3, 8000.0}, fem::pipe_section(0.2, 0.02)};
  if (shear)
    p.section.shear = fem::ShapeShear{};
  p.section.rotary_inertia = rotary;
  return p;
}

/// omega^2 of Timoshenko's beam on pins, q the wave number: the lower root x of
///   (k G A q^2 - rho A x)(E I q^2 + k G A - rho I x) = (k G A q)^2
/// (S. Timoshenko, Vibration Problems in Engineering, 2nd edition, section 55), with or without its two parts.
double timoshenko_square(const fem::BeamProperty& p, double q) {
  const double ei = p.material.young_modulus * p.section.iz, m = p.material.density * p.section.area,
               inertia = p.section.rotary_inertia ? p.material.density * p.section.iz : 0.0;
  const auto k = fem::shear_coefficients(p.section, p.material.poisson_ratio);
  if (!k)
    return ei * std::pow(q, 4) / (m + inertia * q * q);
  const double ga =
      k->y * p.material.young_modulus / (2.0 * (1.0 + p.material.poisson_ratio)) * p.section.area;
  const double a = m * inertia, b = m * (ei * q * q + ga) + inertia * ga * q * q,
               c = ga * ei * std::pow(q, 4);
  return 2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c));
}

std::vector<double> pinned_errors(const fem::BeamProperty& p, int n) {
  const modal::Basis basis = modes(span(p, n, uy, uy).model, 3);
  std::vector<double> errors;
  for (int i = 0; i < 3; ++i)
    errors.push_back(basis.omega[i] / std::sqrt(timoshenko_square(p, (i + 1) * pi / length)) - 1.0);
  return errors;
}

/// Determinant whose zeros mu = omega L^2 sqrt(rho A0 / E I0) are those of a cantilever with A ~ x^n, I ~ x^(n+2), x from
/// the apex, cut where x = share of the root's: w = x^(-n/2) Z(2 k sqrt x), Z = J_n, Y_n, I_n, K_n (E. Cranch and
/// A. Adler, Bending vibrations of variable section beams, Journal of Applied Mechanics 23 (1956) 103-108).
double tapered_determinant(int n, double share, double mu) {
  const double root = 2.0 * std::sqrt(mu) / (1.0 - share), tip = root * std::sqrt(share);
  Eigen::Matrix4d rows;
  const auto row = [&](int derivative, double z) {
    const double order = n + derivative, sign = derivative % 2 == 0 ? 1.0 : -1.0;
    rows.row(derivative) << sign * std::cyl_bessel_j(order, z), sign * std::cyl_neumann(order, z),
        std::cyl_bessel_i(order, z), sign * std::cyl_bessel_k(order, z);
  };
  row(0, root);
  row(1, root);
  row(2, tip);
  row(3, tip);
  return rows.determinant();
}

double zero_between(const std::function<double(double)>& f, double low, double high) {
  const double at_low = f(low);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) * at_low > 0.0 ? low : high) = middle;
  }
  return low;
}

/// Half as deep at the tip: a wedge of constant width (n = 1) or a cone (n = 2).
fem::BeamProperty half_tapered(int n) {
  fem::BeamProperty p{{2.0e11, 0.3, 8000.0},
                      n == 1 ? fem::rectangle_section(0.02, 0.01) : fem::circle_section(0.02)};
  p.taper = fem::Taper{n == 1 ? fem::rectangle_section(0.01, 0.01) : fem::circle_section(0.01)};
  p.orientation = Vec3::UnitY();
  return p;
}

} // namespace

TEST(Timoshenko, PinnedSpanHasTheClosedForm) {
  constexpr double at_64_elements = 5e-4; // of mode 3: shear converges as h^2
  for (const bool shear : {false, true})
    for (const bool rotary : {false, true}) {
      const auto p = stubby(shear, rotary);
      const auto errors = pinned_errors(p, 64);
      testing::Test::RecordProperty("mode_3_of_shear_" + std::to_string(shear) + "_rotary_" +
                                        std::to_string(rotary),
                                    std::to_string(errors[2] * 1e6) + "e-6");
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(errors[static_cast<std::size_t>(i)], 0.0, shear ? at_64_elements : 1e-6)
            << shear << rotary << i;
      const double slender = timoshenko_square(stubby(false, false), 3 * pi / length);
      if (shear || rotary) {
        EXPECT_LT(timoshenko_square(p, 3 * pi / length), 0.95 * slender) << "they matter here";
      }
    }
}

TEST(Timoshenko, ConvergesWithOrderTwoInShearAndFourWithout) {
  for (const bool shear : {false, true}) {
    const auto p = stubby(shear, true);
    std::vector<double> before = pinned_errors(p, 8);
    for (const int n : {16, 32, 64}) {
      const auto now = pinned_errors(p, n);
      for (std::size_t i = 0; i < 3; ++i) {
        testing::Test::RecordProperty("order_" + std::to_string(n) + "_" + std::to_string(i),
                                      std::to_string(std::log2(before[i] / now[i])));
        EXPECT_NEAR(std::log2(before[i] / now[i]), shear ? 2.0 : 4.0, 0.3) << n << " mode " << i;
      }
      before = now;
    }
  }
}

// Case E2, dry: the printed frequency has k without Poisson's ratio, 6 (1 + m^2)^2 / (7 (1 + m^2)^2 + 20 m^2).
TEST(Timoshenko, ClampedTubeOfCaseE2) {
  constexpr double printed = 5e-5; // six digits, of a mesh that is not told
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::pipe_section(0.04, 0.005)};
  const double m2 = 0.5625, sum = (1.0 + m2) * (1.0 + m2), k = 6.0 * sum / (7.0 * sum + 20.0 * m2);
  p.section.shear = fem::ShearCoefficients{k, k};
  p.section.rotary_inertia = true;
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 40, b.property(p));
  b.fix(nodes.front(), all);
  b.fix(nodes.back(), all);
  expect_frequency("E2_shear", hertz(modes(b.model, 2))[0], 226.391, printed);
}

// Both planes of a rectangle, so that each has its own coefficient and inertia.
TEST(Timoshenko, KnowsTheTwoPlanesOfASection) {
  fem::BeamProperty p{{2.0e11, 0.3, 8000.0}, fem::rectangle_section(0.2, 0.1)};
  p.orientation = Vec3::UnitY();
  p.section.shear = fem::ShearCoefficients{0.8, 0.4};
  p.section.rotary_inertia = true;
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, 64, b.property(p));
  b.fix_everywhere(ux | rx);
  b.fix(nodes.front(), uy | uz);
  b.fix(nodes.back(), uy | uz);
  const auto found = hertz(modes(b.model, 2));
  auto weak = p;
  std::swap(weak.section.iy, weak.section.iz);
  weak.section.shear = fem::ShearCoefficients{0.4, 0.8};
  constexpr double at_64_elements = 1e-4;
  expect_frequency("flat", found[0], std::sqrt(timoshenko_square(weak, pi / length)) / (2 * pi),
                   at_64_elements);
  expect_frequency("upright", found[1], std::sqrt(timoshenko_square(p, pi / length)) / (2 * pi),
                   at_64_elements);
}

// omega_n^2 (1 + N L^2 / (n^2 pi^2 E I)) against the same mesh without force: the shapes are the same sines.
TEST(AxialForce, ChangesTheFrequenciesOfAPinnedSpan) {
  constexpr double at_32_elements = 2e-5; // errors of order 4 that differ with the force
  const auto plain = tube_property();
  const double euler = pi * pi * plain.material.young_modulus * plain.section.iz / (length * length);
  const Eigen::VectorXd without = modes(span(plain, 32, uy, uy).model, 4).omega.array().square();
  for (const double share : {10.0, 0.5, -0.5, -0.99}) {
    auto p = plain;
    p.axial_force = share * euler;
    const Eigen::VectorXd found = modes(span(p, 32, uy, uy).model, 4).omega.array().square();
    for (int n = 1; n <= 4; ++n) {
      const double factor = 1.0 + share / (n * n);
      EXPECT_NEAR(found[n - 1] / (without[n - 1] * factor), 1.0, at_32_elements / std::min(1.0, factor))
          << share << " " << n;
    }
  }
}

// Daniel Bernoulli's hanging chain: omega = j/2 (g/L)^(1/2), j the zeros of J0. Its bending stiffness is next to none.
TEST(AxialForce, ThatGrowsLinearlyIsThatOfAHangingChain) {
  constexpr double zeros[] = {2.404825557695773, 5.520078110286311, 8.653727912911013}, g = 9.81;
  constexpr double of_the_mesh =
      4e-3; // the force of each element is that at its middle: of order 1 at the free end of a chain
  auto p = tube_property();
  p.material.young_modulus = 2e4;
  p.axial_force = p.material.density * p.section.area * g * length;
  p.taper = fem::Taper{p.section, 0.0, {}, 0.0};
  double error[2];
  for (const int refined : {0, 1}) {
    const modal::Basis basis = modes(span(p, refined ? 80 : 40, uy, 0).model, 3);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(basis.omega[i] / (0.5 * zeros[i] * std::sqrt(g / length)), 1.0, of_the_mesh) << i;
    error[refined] = basis.omega[2] / (0.5 * zeros[2] * std::sqrt(g / length)) - 1.0;
  }
  EXPECT_LT(std::abs(error[1]), 0.6 * std::abs(error[0]));
}

TEST(AxialForce, ThatBucklesIsRefused) {
  const auto refused = [](fem::BeamProperty p, double force, int elements) {
    p.axial_force = -force;
    const auto b = span(p, elements, uy, uy);
    try {
      (void)modes(b.model, 2);
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find("buckles under the compression"), std::string::npos);
      return true;
    }
    return false;
  };
  for (const int elements : {16, 80}) { // a dense solve, and Krylov's
    const auto p = tube_property();
    const double euler = pi * pi * p.material.young_modulus * p.section.iz / (length * length);
    EXPECT_TRUE(refused(p, 1.001 * euler, elements));
    EXPECT_FALSE(refused(p, 0.999 * euler, elements));
    // Engesser: a column that shears
    const auto q = stubby(true, false);
    const double stiff = pi * pi * q.material.young_modulus * q.section.iz / (length * length);
    const double kga = fem::shear_coefficients(q.section, 0.3)->y * 2.0e11 / 2.6 * q.section.area;
    const double limit = stiff / (1.0 + stiff / kga);
    EXPECT_LT(limit, 0.96 * stiff);
    EXPECT_TRUE(refused(q, 1.005 * limit, elements)); // the mesh is stiffer by some 1e-3
    EXPECT_FALSE(refused(q, 0.995 * limit, elements));
  }
}

// A free bar under tension turns against it: 2 U = N L theta^2, inertia m L^3 / 12.
TEST(AxialForce, HoldsAFreeBarInItsDirection) {
  auto p = tube_property();
  p.axial_force = 1e-2; // so small that the bar hardly bends
  ModelBuilder b;
  b.line({0, 0, 0}, {length, 0, 0}, 8, b.property(p));
  const modal::Basis basis = modes(b.model, 8);
  EXPECT_EQ(basis.omega[3], 0.0); // three translations and the spin
  const double m = p.material.density * p.section.area;
  const double exact = std::sqrt(12.0 * p.axial_force / (m * length * length)) / (2 * pi);
  constexpr double bent = 1e-4; // a share N L^2 / (pi^2 E I)
  expect_frequency("turn_1", basis.omega[4] / (2 * pi), exact, bent);
  expect_frequency("turn_2", basis.omega[5] / (2 * pi), exact, bent);
  b.model.properties[0].axial_force = -1e-2;
  expect_error([&] { (void)modes(b.model, 8); }, {"buckles"});
}

// Rigid motions are of eigenvalue 0: round-off must not make them buckle, nor hide what buckles, however fine the mesh.
TEST(AxialForce, OfAColumnThatSlidesAndSpinsBucklesAtEulersLoad) {
  for (const int elements : {18, 90, 1000})
    for (const double share : {0.1, 0.99, 1.01}) {
      auto p = tube_property();
      const double euler = pi * pi * p.material.young_modulus * p.section.iy / (length * length);
      p.axial_force = -share * euler;
      ModelBuilder b;
      const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, elements, b.property(p));
      for (const auto node : {nodes.front(), nodes.back()})
        b.fix(node, uy | uz);
      if (share > 1.0)
        expect_error([&] { (void)modes(b.model, 4); }, {"buckles"});
      else
        EXPECT_EQ(modes(b.model, 4).omega[1], 0.0) << elements; // it slides and spins
    }
}

TEST(Taper, CantileversHaveTheFrequenciesOfTheLiterature) {
  // published, e.g. B. Downs, Transverse vibrations of cantilever beams having unequal breadth and depth tapers,
  // Journal of Applied Mechanics 44 (1977) 737-742
  const std::array<std::array<double, 3>, 2> published{
      {{3.82379, 18.3173, 47.2648}, {4.62515, 19.5476, 48.5789}}};
  constexpr double six_digits = 3e-6; // one in the last
  for (int n = 1; n <= 2; ++n) {
    const auto p = half_tapered(n);
    const double unit = std::sqrt(2.0e11 * p.section.iz / (8000.0 * p.section.area)) / (length * length);
    std::vector<double> exact;
    for (const double near : published[static_cast<std::size_t>(n - 1)])
      exact.push_back(
          zero_between([&](double mu) { return tapered_determinant(n, 0.5, mu); }, 0.99 * near, 1.01 * near));
    std::vector<double> before;
    for (const int elements : {8, 16, 32}) {
      const modal::Basis basis = modes(span(p, elements, all, 0).model, 3);
      std::vector<double> errors;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(exact[i] / published[static_cast<std::size_t>(n - 1)][i], 1.0, six_digits);
        errors.push_back(basis.omega[static_cast<Eigen::Index>(i)] / (unit * exact[i]) - 1.0);
        if (elements > 8) { // three modes need more than eight elements
          EXPECT_NEAR(std::log2(before[i] / errors[i]), 4.0, 0.3) << n << " " << elements << " mode " << i;
        }
      }
      if (elements == 32) {
        EXPECT_LT(std::abs(errors[0]), 1e-7);
        expect_frequency((n == 1 ? "wedge" : "cone"), basis.omega[0] / unit, exact[0], 1e-7);
      }
      before = errors;
    }
  }
}

// Mass that grows along a string-like span: added mass alone changes.
TEST(Taper, OfAddedMassKeepsThatOfItsMean) {
  auto p = tube_property();
  p.added_mass = 0.0;
  p.taper = fem::Taper{p.section, 0.8};
  auto mirrored = p;
  mirrored.added_mass = 0.8;
  mirrored.taper->added_mass = 0.0;
  const auto a = hertz(modes(span(p, 16, all, all).model, 3)),
             b = hertz(modes(span(mirrored, 16, all, all).model, 3));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i] / b[i], 1.0, 1e-11) << "mirrored";
  // Rayleigh's quotient with the uniform tube's first mode, symmetric, sees the mean only: an upper bound, close
  auto mean = tube_property();
  mean.added_mass = 0.4;
  const auto uniform = hertz(modes(span(mean, 16, all, all).model, 1));
  EXPECT_LT(a[0], uniform[0]);
  EXPECT_GT(a[0], 0.98 * uniform[0]);
}

// Everything at once: a bend that gets thinner, shears, turns and is full of a fluid that gets denser. Arcs against chords.
TEST(Taper, OfABendOfArcsIsThatOfManyChords) {
  fem::BeamProperty p{{2.0e11, 0.3, 8000.0}, fem::pipe_section(0.06, 0.006)};
  p.section.shear = fem::ShapeShear{};
  p.section.rotary_inertia = true;
  p.taper = fem::Taper{p.section, 0.5, {2000.0, 500.0, 2.0}};
  p.taper->section = fem::pipe_section(0.04, 0.003);
  p.taper->section.shear = p.section.shear;
  p.taper->section.rotary_inertia = true;
  p.fluid = {1000.0, 500.0, 1.0};
  const auto solve = [&](int n, bool arcs) {
    ModelBuilder b;
    const Index number = b.property(p), first = b.node({1, 0, 0});
    if (arcs)
      b.arcs_from(first, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.0, pi / 2, n, number);
    else
      b.arc_from(first, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.0, pi / 2, n, number);
    for (int i = 0; i < n; ++i)
      b.model.beams[static_cast<std::size_t>(i)].along = {static_cast<double>(i) / n,
                                                          static_cast<double>(i + 1) / n};
    b.fix(first, all);
    b.fix(n, all);
    return hertz(modes(b.model, 4));
  };
  constexpr double of_chords = 5e-5, of_arcs = 5e-3; // 160 chords; 8 arcs, mode 4 has two a half wave
  const auto fine = solve(64, true), chords = solve(160, false), coarse = solve(8, true);
  for (std::size_t i = 0; i < 4; ++i) {
    expect_frequency("tapered_bend_" + std::to_string(i), fine[i], chords[i], of_chords);
    EXPECT_NEAR(coarse[i] / fine[i], 1.0, of_arcs) << i;
  }
}

// A tapered column under pressure, cut in its middle and tied in all six components.
TEST(Taper, GoesOnOverATie) {
  constexpr double round_off = 1e-11;
  auto p = half_tapered(2);
  p.section.shear = p.taper->section.shear = fem::ShapeShear{};
  p.axial_force = -100.0;
  const auto whole = span(p, 16, all, all);
  auto cut = whole;
  const Index beside = cut.node(whole.model.nodes[8]);
  cut.fix(beside, whole.model.fixed[8]);
  cut.model.beams[8].a = beside;
  cut.model.ties.push_back({8, beside, all});
  const auto expected = hertz(modes(whole.model, 4)), found = hertz(modes(cut.model, 4));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(found[i] / expected[i], 1.0, round_off) << i;
}

} // namespace section_cases_test
