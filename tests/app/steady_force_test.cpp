// SPDX-License-Identifier: GPL-3.0-or-later
// The force of a quasi-steady law at rest: the deflection of a tube under it, what a line force of the same size does.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::steady_force_test {
namespace {

using nlohmann::json;
constexpr double outer = 0.01905, bore = outer - 2.0 * 0.00109, young = 2e11; // of steel_pipe
constexpr double velocity = 2.0, density = 300.0, drag = 0.8, lift = 0.3;
constexpr double per_coefficient = 0.5 * density * velocity * velocity * outer; // q D, N/m

/// A pinned tube of 1 m along x in flow along y, at rest under its constant forces.
json middle_of(const std::string& law_keys, const std::string& loads) {
  const Workshop folder;
  MeshText text = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
  text.points.emplace_back("middle", 20);
  folder.write("mesh.msh", text.text());
  folder.write(
      "study.toml",
      steel_pipe("mesh.msh") + "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" +
          fmt::format("[[restraints]]\ngroup = \"tube_begin\"\nfixed = [\"ux\", \"uy\", \"uz\", \"rx\"]\n"
                      "[[restraints]]\ngroup = \"tube_end\"\nfixed = [\"uy\", \"uz\"]\n"
                      "[modes]\ncount = 40\ndamping = 0.02\n"
                      "[flow_laws.cell]\nlaw = \"quasi_steady\"\ndrag = {}\nlift = {}\ngradients = 0\n{}"
                      "[[flow]]\ngroup = \"tube\"\nfrom = \"tube_begin\"\nlaw = \"cell\"\n"
                      "[[flow.zones]]\nvelocity = {}\ndirection = [0, 1, 0]\ndensity = {}\n"
                      "viscosity = 1e-7\narrangement = \"square\"\npitch = 0.028575\n{}"
                      "[output]\nnodes = [\"middle\"]\n"
                      "[transient]\nduration = 0.01\nstep = 1e-4\nstart = \"static\"\n",
                      drag, lift, law_keys, velocity, density, loads));
  const Outcome outcome = folder.fretwork(
      {"run", folder.path("study.toml").string(), "-o", folder.path("out").string(), "--no-report"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(bytes_of(folder.path("out") / "summary.json"))["nodes"][0]["displacement"];
}

TEST(SteadyForce, IsTheLoadOfTheFlowAtRest) {
  constexpr double of_modes = 1e-6; // (1/21)^5 of the first
  constexpr double round_off = 1e-9;
  const auto load = [](const char* direction, double force) {
    return fmt::format("[[loads]]\ngroup = \"tube\"\nper_length = true\ndirection = {}\nconstant = {:.17g}\n",
                       direction, force);
  };
  const json steady = middle_of("steady = true\n", "");
  const json loaded =
      middle_of("", load("[0, 1, 0]", drag * per_coefficient) + load("[0, 0, 1]", lift * per_coefficient));
  const double inertia = std::numbers::pi / 64.0 * (std::pow(outer, 4) - std::pow(bore, 4));
  const double flexibility = 5.0 / (384.0 * young * inertia); // of 1 m
  EXPECT_TRUE(close_to(steady["y"]["mean"], flexibility * drag * per_coefficient, of_modes));
  EXPECT_TRUE(close_to(steady["z"]["mean"], flexibility * lift * per_coefficient, of_modes));
  for (const char* axis : {"y", "z"})
    EXPECT_TRUE(close_to(steady[axis]["mean"], loaded[axis]["mean"], round_off)) << axis;
  const json without = middle_of("", "");
  EXPECT_EQ(without["y"]["mean"], 0.0);
}

} // namespace
} // namespace fretwork::app::test::steady_force_test
