// SPDX-License-Identifier: GPL-3.0-or-later
#include "study_text.hpp"
#include "mesh_text.hpp"
#include "program.hpp"
#include <fmt/format.h>

namespace fretwork::app::test {

std::string steel_pipe(const std::string& mesh_file, double density) {
  return fmt::format(R"([mesh]
file = "{}"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.3
density = {:.1f}
[sections.tube]
shape = "pipe"
outer_diameter = 0.01905
thickness = 0.00109
)",
                     mesh_file, density);
}

std::string lone_mass() {
  return R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 1.0
[[springs]]
group = "mass"
stiffness = [100.0, 0, 0, 0, 0, 0]
[[restraints]]
group = "mass"
fixed = ["uy", "uz", "rx", "ry", "rz"]
[transient]
duration = 1.0
)";
}

std::string tube_between(const std::string& group, const std::string& begin, const std::string& end) {
  std::string text =
      fmt::format("[[beams]]\ngroup = \"{}\"\nmaterial = \"steel\"\nsection = \"tube\"\n", group);
  const auto fix = [&](const char* side, const std::string& components) {
    if (!components.empty())
      text += fmt::format("[[restraints]]\ngroup = \"{}_{}\"\nfixed = {}\n", group, side, components);
  };
  fix("begin", begin);
  fix("end", end);
  return text;
}

std::string bundle(const Workshop& folder, int tubes, const std::string& run) {
  MeshText mesh;
  std::string study = steel_pipe("bundle.msh", 12000.0) + "[modes]\ncount = 12\ndamping = 0.01\n" + run;
  for (int i = 0; i < tubes; ++i) {
    const std::string name = fmt::format("tube{}", i);
    MeshText tube = straight_line(name, {0.0, 0.05 * i, 0.0}, {2.0 + 0.3 * i, 0.05 * i, 0.0}, 12 + 2 * i);
    tube.points.emplace_back(fmt::format("support{}", i), 4);
    tube.points.emplace_back(fmt::format("drive{}", i), 8);
    mesh = together(mesh, tube);
    study += tube_between(name, "\"all\"", R"(["ux", "uy", "uz", "rx"])");
    study += fmt::format(R"([[contacts]]
name = "support{0}"
group = "support{0}"
gap = 1.0e-5
normal_stiffness = 1.0e6
normal_damping = 20.0
friction = 0.3
tangential_stiffness = 1.0e6
tangential_damping = 100.0
[[loads]]
group = "drive{0}"
direction = [0.0, 1.0, 0.5]
random = {{ rms = 20.0, band = [5.0, 200.0], seed = {1} }}
)",
                         i, 11 + i);
  }
  folder.write("bundle.msh", mesh.text());
  return study;
}

std::string across(const std::string& group, double rms) {
  return fmt::format("[[loads]]\ngroup = \"{}\"\ndirection = [0.0, 0.5, -1.0]\n"
                     "random = {{ rms = {}, band = [5.0, 200.0], seed = 5 }}\n",
                     group, rms);
}

} // namespace fretwork::app::test
