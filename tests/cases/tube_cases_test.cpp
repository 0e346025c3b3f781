// SPDX-License-Identifier: GPL-3.0-or-later
// B4: a tube in eight round supports (examples/straight_tube), before single runs part: without friction against another program, with
// friction the scheme against itself and the oracle.
#include "transient_case.hpp"

namespace fretwork::cases::tube_cases_test {
namespace {

constexpr double accepted = 5e-7; ///< m: against another program's scheme, steps and modes
constexpr int instants = 4;       ///< 0.01, 0.02, 0.03, 0.04 s
constexpr int supports[] = {0, 3, 7};

/// y and z at supports 1, 4 and 8, m: Code_Aster, DIFF_CENTRE extrapolated from steps of 1e-6 and 5e-7 s.
constexpr double reference[6][instants] = {{2.45141e-04, -2.04120e-04, 2.32088e-04, 1.99667e-04},
                                           {8.62373e-05, 1.37354e-05, -6.68796e-05, -8.06608e-06},
                                           {2.83889e-04, -1.77909e-04, 2.13518e-04, 6.74603e-05},
                                           {1.09611e-04, -1.48165e-04, -6.67959e-05, 8.98298e-05},
                                           {2.42800e-04, -2.72991e-04, 2.08173e-04, 2.80853e-05},
                                           {-1.27546e-05, 7.40810e-06, -6.73909e-07, 1.98233e-04}};

Results tube(const Workshop& folder, const std::string& name, double friction, const std::string& scheme,
             const std::string& control) {
  std::vector<std::string> more;
  for (const std::string& value :
       {fmt::format("contacts.support.friction={}", friction), "transient.scheme=" + scheme,
        "transient." + control, std::string("transient.duration=0.041"), std::string("output.every=0.01"),
        std::string("output.statistics_from=0")}) {
    more.emplace_back("--set");
    more.push_back(value);
  }
  return folder.run(app::test::example("straight_tube"), name, more);
}

/// Component of contacts' displacement at output `instant`, m.
double moved(const Results& run, int support, int axis, int instant) {
  return run.contact(fmt::format("support[{}]", support)).displacement(instant, axis);
}

double largest_difference(const Results& a, const Results& b, int instant) {
  double largest = 0.0;
  for (int support = 0; support < 8; ++support)
    for (const int axis : {1, 2})
      largest =
          std::max(largest, std::abs(moved(a, support, axis, instant) - moved(b, support, axis, instant)));
  return largest;
}

TEST(TubeCases, WithoutFrictionFollowsAnotherProgram) {
  const Workshop folder;
  for (const auto& [scheme, control] : {std::pair{"runge_kutta_54", "tolerance=1e-8"},
                                        {"splitting", "step=1e-5"},
                                        {"devogelaere", "step=2e-5"}}) {
    const Results run = tube(folder, scheme, 0.0, scheme, control);
    double largest = 0.0;
    for (int row = 0; row < 6; ++row)
      for (int k = 0; k < instants; ++k)
        largest = std::max(largest,
                           std::abs(moved(run, supports[row / 2], 1 + row % 2, k + 1) - reference[row][k]));
    expect_value("B4 tube without friction", run, "largest error up to 0.04 s, m", 0.0, largest, accepted,
                 1.0);
  }
}

TEST(TubeCases, WithFrictionConverges) {
  constexpr double asked = 1e-8; // m at 0.02 s
  const Workshop folder;
  const Results exact = tube(folder, "exact", 0.3, "runge_kutta_54", "tolerance=1e-10");
  const Results coarse = tube(folder, "coarse", 0.3, "splitting", "step=1e-5"),
                fine = tube(folder, "fine", 0.3, "splitting", "step=2.5e-6");
  expect_value("B4 tube with friction", fine, "splitting from the oracle at 0.02 s, m", 0.0,
               largest_difference(fine, exact, 2), asked, 1.0);
  // a quarter of the step: order 1 at least
  EXPECT_LT(largest_difference(fine, exact, 2), 0.25 * largest_difference(coarse, exact, 2) * 1.05);
  constexpr double of_loose = 1e-7; // m: tolerance 1e-4 of the energy norm
  const Results loose = tube(folder, "loose", 0.3, "runge_kutta_54", "tolerance=1e-4");
  expect_value("B4 tube with friction", loose, "tolerance 1e-4 from 1e-10 at 0.03 s, m", 0.0,
               largest_difference(loose, exact, 3), of_loose, 1.0);
}

} // namespace
} // namespace fretwork::cases::tube_cases_test
