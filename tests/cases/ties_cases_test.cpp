// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies and steady amplitudes of structures with ties (doc/validation.md).
#include "../fem/model_builder.hpp"
#include "frequencies.hpp"

namespace ties_cases_test {

using namespace fretwork;
using namespace fretwork::tests;
using std::numbers::pi;

namespace {

/// Printed digits.
constexpr double seven_digits = 2.5e-7;
constexpr double nine_digits = 1e-8;

/// Relative errors of the frequencies of a beam of length 2 L, clamped at both ends, its halves (n elements each)
/// tied in the middle, against the roots beta L.
std::vector<double> errors_of_halves(int n, unsigned tied, const std::vector<double>& roots) {
  constexpr double half = 1.5;
  ModelBuilder b;
  const fem::BeamProperty p = tube_property();
  const auto left = b.line({0, 0, 0}, {half, 0, 0}, n, b.property(p));
  const auto right = b.line({half, 0, 0}, {2 * half, 0, 0}, n, 0);
  b.fix_everywhere(ux | uz | rx | ry);
  b.fix(left.front(), all);
  b.fix(right.back(), all);
  b.model.ties.push_back({left.back(), right.front(), static_cast<std::uint8_t>(tied)});
  const modal::Basis basis = modes(b.model, static_cast<int>(roots.size()));
  std::vector<double> errors;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double wave = roots[i] / half;
    errors.push_back(
        basis.omega[static_cast<Eigen::Index>(i)] /
            (wave * wave *
             std::sqrt(p.material.young_modulus * p.section.iz / (p.material.density * p.section.area))) -
        1.0);
  }
  return errors;
}

void expect_halves(const std::string& name, unsigned tied, const std::vector<double>& roots) {
  constexpr double round_off = 2e-9; // roots of ten digits
  for (const int n : {16, 120}) {    // a dense and a Krylov solve
    const std::vector<double> errors = errors_of_halves(n, tied, roots);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const double of_mesh = std::pow(roots[i] / n, 4) / 1440.0; // Hermite elements, from above
      EXPECT_GT(errors[i], 0.8 * of_mesh - round_off) << name << " " << i;
      EXPECT_LT(errors[i], 1.05 * of_mesh + round_off) << name << " " << i;
    }
  }
}

} // namespace

// By symmetry the halves are clamped-free where the middle carries no shear, clamped-pinned where it does not move.
TEST(Ties, HingeInTheMiddleOfAClampedBeam) {
  expect_halves("hinge", uy, {1.8751040687, 3.9266023120, 4.6940911330, 7.0685827456, 7.8547574382});
}

// The slide carries moments alone: clamped-guided where the slope is zero, clamped-free where the moment is.
TEST(Ties, SlideInTheMiddleOfAClampedBeam) {
  expect_halves("slide", rz, {1.8751040687, 2.3650203724, 4.6940911330, 5.4978039190, 7.8547574382});
}

namespace {

struct HGrid {
  ModelBuilder b;
  Index middle, centre; ///< of a long bar and of the cross bar
};

/// D3: two bars along y, corners held in z, and a cross bar whose ends are tied to their middles in z alone; motion
/// out of plane. The spin of each bar about its axis meets no tie and no load: it is held.
HGrid h_grid() {
  HGrid grid{};
  ModelBuilder& b = grid.b;
  const Index p = b.property({{2e11, 0.3, 7800.0}, {2.872e-3, 1.943e-5, 1.943e-5, 5.165e-8, 2 * 1.943e-5}});
  const auto left = b.line({-2.5, -2.5, 0}, {-2.5, 2.5, 0}, 10, p);
  const auto right = b.line({2.5, -2.5, 0}, {2.5, 2.5, 0}, 10, p);
  for (const auto* bar : {&left, &right}) {
    b.fix(bar->front(), uz);
    b.fix(bar->back(), uz);
    for (const Index node : *bar)
      b.fix(node, ry);
  }
  const auto cross = b.line({-2.5, 0, 0}, {2.5, 0, 0}, 10, p);
  for (const Index node : cross)
    b.fix(node, rx);
  b.fix_everywhere(ux | uy | rz);
  b.model.ties = {{cross.front(), left[5], uz}, {cross.back(), right[5], uz}};
  grid.middle = left[5];
  grid.centre = cross[5];
  return grid;
}

} // namespace

TEST(CaseD3, HGridOutOfPlane) {
  const HGrid grid = h_grid();
  const std::vector<double> found = hertz(modes(grid.b.model, 3));
  expect_frequencies("D3", found, {16.419020, 22.56758, 38.046795}, seven_digits);
}

// -1e5 N at the centre at 80 rad/s, no damping: u = sum of phi phi^T F / (omega_i^2 - 80^2) over all modes.
TEST(CaseD3, SteadyAmplitude) {
  const HGrid grid = h_grid();
  const modal::Basis basis = modes(grid.b.model, 1000);
  const auto amplitude = [&](Index node) {
    const auto at = [&](Index n) -> Eigen::VectorXd {
      return basis.shapes.row(basis.row_of(n) + 2).transpose();
    };
    return (at(node).array() * at(grid.centre).array() * -1e5 / (basis.omega.array().square() - 80.0 * 80.0))
        .sum();
  };
  expect_frequency("D3_middle", amplitude(grid.middle), -0.100377195, nine_digits);
  expect_frequency("D3_centre", amplitude(grid.centre), -0.227396528, nine_digits);
}

} // namespace ties_cases_test
