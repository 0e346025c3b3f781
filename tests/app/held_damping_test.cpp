// SPDX-License-Identifier: GPL-3.0-or-later
// What the ratios of modes without contacts come to where contacts hold the tube.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::held_damping_test {
namespace {

constexpr int elements = 20, at = 20; // the node of the stop
constexpr double spring = 1e6;        // N/m
constexpr const char* in_one_plane = "[\"ux\", \"uz\", \"rx\", \"ry\"]";

/// A tube clamped at one end, in one plane, on a stop.
Results run(const Workshop& folder, const std::string& damping) {
  MeshText mesh = straight_line("tube", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, elements);
  mesh.points.emplace_back("stop", at);
  folder.write("mesh.msh", mesh.text());
  return folder.run_text(steel_pipe("mesh.msh") + tube_between("tube", "\"all\"", "") +
                         fmt::format("[[restraints]]\ngroup = \"tube\"\nfixed = {}\n", in_one_plane) +
                         "[modes]\ncount = 12\ndamping = " + damping +
                         fmt::format("\n[[contacts]]\ngroup = \"stop\"\naxis = [1.0, 0.0, 0.0]\n"
                                     "obstacle = \"plane_y\"\ngap = 1.0e-4\nnormal_stiffness = {}\n"
                                     "[transient]\nduration = 0.01\n",
                                     spring));
}

/// The lowest root of 1/k = sum b_i^2/(w^2 - w_i^2), and the mean of the modes' frequencies in its motion, weighted by energy.
std::pair<double, double> held_mode(const modal::Basis& basis) {
  const Eigen::ArrayXd b = basis.shapes.row(6 * at + 1).transpose(), squares = basis.omega.array().square();
  const auto left = [&](double square) { return (b.square() / (squares - square)).sum() + 1.0 / spring; };
  double low = squares(0) * (1.0 + 1e-9), high = squares(1) * (1.0 - 1e-9);
  for (int i = 0; i < 200; ++i) // from -infinity to infinity
    (left(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  const double omega = std::sqrt(0.5 * (low + high));
  const Eigen::ArrayXd y = (b / (squares - omega * omega)).square();
  return {omega, (y * basis.omega.array()).sum() / y.sum()};
}

} // namespace

TEST(HeldDamping, IsThatOfTheModesItIsMadeOf) {
  const Workshop folder;
  const Results one = run(folder, "0.01");
  const auto [omega, mean] = held_mode(one.archive.bases.at(0));
  const std::string notes = one.summary["notes"].dump();
  EXPECT_LT(mean, 0.9 * omega);
  EXPECT_TRUE(
      says(notes, fmt::format("at {:.4g} Hz, held by closed contacts, the damping ratio is {:.3g} %, not 1 %",
                              omega / (2.0 * std::numbers::pi), mean / omega)));
  EXPECT_TRUE(says(notes, fmt::format("{{ mass = {:.4g} }} gives 1 % there", 0.02 * omega)));
  EXPECT_FALSE(says(run(folder, fmt::format("{{ mass = {} }}", 0.02 * omega)).summary["notes"].dump(),
                    "held by closed contacts"));
}

} // namespace fretwork::app::test::held_damping_test
