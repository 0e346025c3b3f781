// SPDX-License-Identifier: GPL-3.0-or-later
#include "tubes.hpp"
#include "mesh_text.hpp"
#include "study_text.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace fretwork::app::test {

static const std::string materials = steel_pipe("mesh.msh") + R"([sections.rod]
shape = "circle"
diameter = 0.01
)";

std::string tubes(const Workshop& folder, int count, const std::string& section) {
  MeshText mesh;
  std::string study = materials + "[modes]\ncount = 8\ndamping = 0.01\n[transient]\nduration = 0.02\n";
  std::string observed;
  for (int i = 0; i < count; ++i) {
    MeshText tube =
        straight_line(fmt::format("tube{}", i), {0.0, 0.025 * i, 0.0}, {1.0 + 0.1 * i, 0.025 * i, 0.0}, 8);
    tube.points.emplace_back(fmt::format("mid{}", i), 4);
    mesh = together(mesh, tube);
    study += fmt::format("[[beams]]\ngroup = \"tube{0}\"\nmaterial = \"steel\"\nsection = \"{1}\"\n"
                         "[[restraints]]\ngroup = \"tube{0}_begin\"\nfixed = \"all\"\n"
                         "[[restraints]]\ngroup = \"tube{0}_end\"\nfixed = \"all\"\n",
                         i, section);
    observed += fmt::format("{}\"mid{}\"", i ? ", " : "", i);
  }
  folder.write("mesh.msh", mesh.text());
  return study + "[output]\nevery = 1.0e-3\nnodes = [" + observed + "]\n";
}

std::string push(int tube, double force) {
  return fmt::format("[[loads]]\ngroup = \"mid{}\"\ndirection = [0.0, 1.0, 0.1]\nconstant = {}\n", tube,
                     force);
}

std::string meeting(int a, int b) {
  return fmt::format("[[contacts]]\nname = \"meet{0}{1}\"\ngroup = \"mid{0}\"\nother = \"mid{1}\"\n"
                     "axis = [1.0, 0.0, 0.0]\ndistance_1 = {2}\ndistance_2 = 0.012\n"
                     "normal_stiffness = 1.0e6\nnormal_damping = 10.0\n",
                     a, b, 0.012 + 0.025 * (b - a - 1));
}

const results::ContactFacts& facts(const Results& run, const std::string& name) {
  for (const auto& contact : run.archive.contacts)
    if (contact.name == name)
      return contact;
  throw std::runtime_error("no contact " + name);
}

std::string refused(const Workshop& folder, const std::string& study) {
  const Outcome outcome = folder.fretwork({"run", folder.write("study.toml", study).string(), "-o",
                                           folder.path("results").string(), "--no-report"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  return outcome.err;
}

} // namespace fretwork::app::test
