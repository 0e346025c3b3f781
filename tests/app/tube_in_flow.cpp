// SPDX-License-Identifier: GPL-3.0-or-later
#include "tube_in_flow.hpp"
#include "mesh_text.hpp"
#include "study_text.hpp"
#include <fmt/format.h>

namespace fretwork::app::test::tube_in_flow {

const std::string s1 =
    "[flow_laws.s1]\nlaw = \"rational\"\nstiffness = -4\ndamping = -0.4\nlags = [0.4]\nlag_forces = [4]\n";

std::string pinned(const std::string& group) {
  return fmt::format("[[beams]]\ngroup = \"{0}\"\nmaterial = \"steel\"\nsection = \"tube\"\n"
                     "[[restraints]]\ngroup = \"{0}\"\nfixed = [\"ux\", \"uy\", \"rx\", \"rz\"]\n"
                     "[[restraints]]\ngroup = \"{0}_begin\"\nfixed = [\"uz\"]\n"
                     "[[restraints]]\ngroup = \"{0}_end\"\nfixed = [\"uz\"]\n",
                     group);
}
std::string tube(const std::string& more) {
  return steel_pipe("mesh.msh", metal) + pinned("tube") + "[modes]\ncount = 12\ndamping = 0.01\n" + more;
}
std::string flow(const std::string& law, const std::string& zones) {
  return "[[flow]]\nname = \"T1\"\ngroup = \"tube\"\nfrom = \"tube_begin\"\nlaw = \"" + law + "\"\n" + zones;
}
std::string zone(double from, double to, double velocity, double density, double inside) {
  return fmt::format(
      "[[flow.zones]]\nfrom = {}\nto = {}\nvelocity = {}\ndirection = [0, 1, 0]\ndensity = {}\n"
      "viscosity = 1e-7\nfluid_inside = {:.17g}\narrangement = \"square\"\npitch = 0.028575\n",
      from, to, velocity, density, inside);
}
double inside_of_light() {
  const double ratio = (1.07 + 0.56 * 1.5) * 1.5, added = (ratio * ratio + 1.0) / (ratio * ratio - 1.0);
  return 1000.0 + added * 700.0 * outer * outer / (bore * bore);
}
Outcome outcome_on(const MeshText& mesh, const Workshop& folder, const std::string& study,
                   const std::string& command) {
  folder.write("mesh.msh", mesh.text());
  folder.write("study.toml", study);
  Outcome outcome = folder.fretwork(
      {command, folder.path("study.toml").string(), "-o", folder.path("out").string(), "--force"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome;
}
Outcome outcome_of(const Workshop& folder, const std::string& study, const std::string& command) {
  MeshText mesh = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
  mesh.points.emplace_back("middle", 20);
  return outcome_on(mesh, folder, study, command);
}
nlohmann::json summary_of(const Workshop& folder, const std::string& study, const std::string& command) {
  (void)outcome_of(folder, study, command);
  return nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"));
}

} // namespace fretwork::app::test::tube_in_flow
