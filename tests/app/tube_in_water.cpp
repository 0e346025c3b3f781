// SPDX-License-Identifier: GPL-3.0-or-later
#include "tube_in_water.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::tube_in_water {
namespace {

constexpr double bore = outer - 2.0 * 0.00109, viscosity = 1.23e-7; // m, m2/s
const double bore_area = pi / 4.0 * bore * bore, displaced = pi / 4.0 * outer * outer,
             ratio = (1.07 + 0.56 * pitch_ratio) * pitch_ratio; // De/D of squares

} // namespace

const double bending = 2.0e11 * pi / 64.0 * (std::pow(outer, 4) - std::pow(bore, 4));
const double mass = 8000.0 * (displaced - bore_area) + 700.0 * bore_area +
                    (ratio * ratio + 1.0) / (ratio * ratio - 1.0) * density * displaced;

std::string tube(const std::string& held, const std::string& more) {
  return steel_pipe("mesh.msh") + "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" +
         fmt::format(R"([[restraints]]
group = "tube"
fixed = {}
[[restraints]]
group = "tube_begin"
fixed = ["uy", "uz"]
[[restraints]]
group = "tube_end"
fixed = ["uy", "uz"]
)",
                     held) +
         more;
}

const std::string in_one_plane = R"(["ux", "uy", "rx", "rz"])", in_two_planes = R"(["ux", "rx"])";
std::string flow(const std::string& more, const std::string& zone) {
  return "[[flow]]\nname = \"T1\"\ngroup = \"tube\"\nfrom = \"tube_begin\"\n" + more +
         "[[flow.zones]]\nname = \"water\"\ndensity = 740.0\nviscosity = 1.23e-7\nfluid_inside = 700.0\n"
         "arrangement = \"square\"\npitch = 0.027432\n" +
         zone;
}
std::string contact(const std::string& group, const std::string& keys) {
  return fmt::format("[[contacts]]\ngroup = \"{}\"\nnormal_stiffness = 1e6\ngap = 1e-3\n{}", group, keys);
}
std::string modes(int count, const std::string& more) {
  return fmt::format("[modes]\ncount = {}\n{}", count, more);
}

MeshText mesh() {
  MeshText text = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
  text.points.emplace_back("middle", 20);
  text.points.emplace_back("third", 14);
  return text;
}

Outcome outcome_of(const Workshop& folder, const std::string& study, const std::string& command,
                   const std::vector<std::string>& more, int ranks) {
  folder.write("mesh.msh", mesh().text());
  folder.write("study.toml", study);
  std::vector<std::string> arguments{command, folder.path("study.toml").string(), "-o",
                                     folder.path("out").string(), "--force"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return folder.fretwork(arguments, ranks);
}

nlohmann::json summary_of(const Workshop& folder, const std::string& study, const std::string& command,
                          const std::vector<std::string>& more) {
  const Outcome outcome = outcome_of(folder, study, command, more);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"));
}

std::vector<double> frequencies(const nlohmann::json& assessment) {
  std::vector<double> out;
  for (const nlohmann::json& mode : assessment["modes"])
    out.push_back(mode["frequency_hz"]);
  return out;
}

double viscous_ratio(double hertz) {
  const double confinement = (1.0 + std::pow(ratio, -3)) / std::pow(1.0 - std::pow(ratio, -2), 2);
  return pi / std::sqrt(8.0) * density * outer * outer / mass *
         std::sqrt(2.0 * viscosity / (pi * hertz * outer * outer)) * confinement;
}

} // namespace fretwork::app::test::tube_in_water
