// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong input: one message that names the thing and the cure, exit status 1, no results left.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <ostream>

namespace fretwork::app::test::wrong_input_test {
namespace {

MeshText good_mesh() { return straight_line("beam", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 4); }

constexpr const char* beam_properties = R"([mesh]
file = "mesh.msh"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.3
density = 8000.0
[sections.rod]
shape = "circle"
diameter = 0.02
)";

const std::string good_study = beam_properties + std::string(R"([[beams]]
group = "beam"
material = "steel"
section = "rod"
[[restraints]]
group = "beam_begin"
fixed = "all"
[[contacts]]
name = "stop"
group = "beam_end"
obstacle = "circle"
gap = 1.0e-4
normal_stiffness = 1.0e6
[[loads]]
group = "beam_end"
direction = [0.0, 1.0, 0.0]
constant = 100.0
[transient]
duration = 0.01
[output]
nodes = ["beam_end"]
)");

std::string with(std::string text, const std::string& part, const std::string& other) {
  const auto place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part;
  return text.replace(place, part.size(), other);
}

std::string good_but(const std::string& part, const std::string& other) {
  return with(good_study, part, other);
}

struct Wrong {
  std::string name, study, mesh;
  std::vector<std::string> said;
  bool seen_by_check = true;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.name; }

class WrongInput : public testing::TestWithParam<Wrong> {};

TEST_P(WrongInput, IsRefusedWithOneMessage) {
  const Wrong& wrong = GetParam();
  const Workshop folder;
  folder.write("mesh.msh", wrong.mesh);
  const std::string study = folder.write("study.toml", wrong.study).string(),
                    results = folder.path("results").string();
  std::vector<std::vector<std::string>> commands{{"run", study, "-o", results}};
  if (wrong.seen_by_check)
    commands.push_back({"check", study});
  for (const auto& command : commands) {
    const Outcome outcome = folder.fretwork(command);
    EXPECT_EQ(outcome.status, 1) << command.front() << ": " << outcome.out << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("fretwork: ", 0), 0u) << outcome.err;
    for (const std::string& part : wrong.said)
      EXPECT_TRUE(says(outcome.err, part)) << command.front();
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_FALSE(fs::exists(folder.path("results") / "summary.json"));
  EXPECT_FALSE(fs::exists(folder.path("results") / "results.h5"));
}

std::vector<Wrong> wrong_studies() {
  const std::string mesh = good_mesh().text();
  return {
      {"MissingMesh", good_but("mesh.msh", "mash.msh"), mesh, {"mash.msh", "check the path"}},
      {"NotToml", good_but("duration = 0.01", "duration ="), mesh, {"study.toml:"}},
      {"UnknownKey",
       good_but("gap = 1.0e-4", "gapp = 1.0e-4"),
       mesh,
       {"gapp", "did you mean \"gap\"", "study.toml:"}},
      {"WrongType",
       good_but("gap = 1.0e-4", "gap = \"wide\""),
       mesh,
       {"contacts.stop.gap", "\"wide\"", "number"}},
      {"NegativeGap",
       good_but("gap = 1.0e-4", "gap = -1.0e-4"),
       mesh,
       {"contacts.stop.gap", "-0.0001", "offset"}},
      {"ZeroStiffness",
       good_but("normal_stiffness = 1.0e6", "normal_stiffness = 0.0"),
       mesh,
       {"contacts.stop.normal_stiffness", "> 0"}},
      {"NotANumber", good_but("gap = 1.0e-4", "gap = nan"), mesh, {"contacts.stop.gap", "nan"}},
      {"StepLongerThanTheRun",
       good_but("duration = 0.01", "duration = 0.01\nstep = 0.02"),
       mesh,
       {"transient.step", "0.02", "duration"}},
      {"UnknownObstacle",
       good_but("\"circle\"\ngap", "\"cirle\"\ngap"),
       mesh,
       {"cirle", "did you mean \"circle\""}},
      {"TwoTimeFunctions",
       good_but("constant = 100.0", "constant = 100.0\nharmonic = { amplitude = 1.0, frequency = 2.0 }"),
       mesh,
       {"loads.", "constant", "harmonic"}},
      {"NoTransient", good_but("[transient]\nduration = 0.01\n", ""), mesh, {"[transient]"}, false},
  };
}

std::vector<Wrong> wrong_meshes() {
  MeshText two_parts = together(good_mesh(), straight_line("arm", {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, 2));
  MeshText twice = good_mesh();
  for (const auto& line : good_mesh().lines)
    twice.lines.push_back({"also", line.nodes});
  const std::string beams =
      "[[beams]]\ngroup = \"also\"\nmaterial = \"steel\"\nsection = \"rod\"\n[[beams]]\ngroup = \"beam\"";
  const std::string no_groups =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n";
  const std::string nothing_in_group =
      with(with(good_mesh().text(), "$PhysicalNames\n3\n", "$PhysicalNames\n4\n"), "$EndPhysicalNames",
           "0 9 \"hollow\"\n$EndPhysicalNames");
  const std::string to_nothing = good_but("group = \"beam_end\"\nobstacle", "group = \"hollow\"\nobstacle");
  return {
      {"MissingGroup",
       good_but("group = \"beam_end\"\nobstacle", "group = \"beam_ned\"\nobstacle"),
       good_mesh().text(),
       {"contact \"stop\"", "beam_ned", "did you mean \"beam_end\""}},
      {"EmptyGroup", to_nothing, nothing_in_group, {"contact \"stop\"", "hollow"}},
      {"LinesWithoutSection", good_study, two_parts.text(), {"2 of 6 line elements", "[[beams]]", "\"arm\""}},
      {"LinesWithTwoSections",
       good_but("[[beams]]\ngroup = \"beam\"", beams),
       twice.text(),
       {"two [[beams]] entries", "also", "beam"}},
      {"NothingNamed", good_study, no_groups + "0\n$EndElements\n", {"mesh.msh", "line"}},
      {"OnlySurfaces", good_study, no_groups + "1\n1 2 2 1 1 1 2 3\n$EndElements\n", {"mesh.msh", "line"}},
      {"LoadPerLengthOnAPoint",
       good_but("constant = 100.0", "constant = 100.0\nper_length = true"),
       good_mesh().text(),
       {"[[loads]] entry 1", "beam_end", "curve"}},
  };
}

std::vector<Wrong> wrong_models() {
  const std::string mass = lone_points({"mass"}).text(), mesh = good_mesh().text();
  MeshText lone = good_mesh();
  lone.nodes.emplace_back(9.0, 0.0, 0.0);
  lone.points.emplace_back("far", static_cast<int>(lone.nodes.size()) - 1);
  const std::string mesh_and_point = lone.text();
  const std::string stop =
      "[[contacts]]\nname = \"stop\"\ngroup = \"mass\"\ngap = 0.1\nnormal_stiffness = 1e3\n";
  return {
      {"DofWithoutMassOrRestraint",
       with(lone_mass(), "\"ry\", \"rz\"", "\"ry\""),
       mass,
       {"rz", "mass"},
       false},
      {"ContactOnAFixedNode",
       good_but("group = \"beam_end\"\nobstacle", "group = \"beam_begin\"\nobstacle"),
       mesh,
       {"contact \"stop\"", "cannot move"}},
      {"ContactOnAPointWithoutBeam",
       good_but("group = \"beam_end\"\nobstacle", "group = \"far\"\nobstacle"),
       mesh_and_point,
       {"contact \"stop\"", "no beam meets its node at (9, 0, 0)", "physical curve"}},
      {"ContactWithAxisOnAPointWithoutBeam",
       good_but("group = \"beam_end\"\nobstacle", "group = \"far\"\naxis = [1, 0, 0]\nobstacle"),
       mesh_and_point,
       {"contact \"stop\"", "cannot move", "no beam meets its node at (9, 0, 0)", "[[masses]]"}},
      {"ContactWithYAxisAlongItsBeam",
       good_but("group = \"beam_end\"\nobstacle", "group = \"beam_end\"\ny_axis = [1, 0, 0]\nobstacle"),
       mesh,
       {"contact \"stop\"", "y_axis is along the axis"}},
      {"ContactWithoutAxis", lone_mass() + stop, mass, {"contact \"stop\"", "axis"}},
      {"EverythingRestrained",
       with(lone_mass(), "[\"uy\", \"uz\", \"rx\", \"ry\", \"rz\"]", "\"all\""),
       mass,
       {"nothing", "[[restraints]]"}},
      {"ListOfDampingTooShort",
       good_but("[transient]", "[modes]\ncount = 5\ndamping = [0.02, 0.01]\n[transient]"),
       mesh,
       {"damping", "2 ratios for 5 modes"},
       false},
      {"MoreOutputsThanFit",
       good_but("[output]\n", "[output]\nevery = 1.0e-11\n"),
       mesh,
       {"output.every", "GB", "sample less often"},
       false},
      {"MoreImpactsThanFit",
       with(good_but("[output]\n", "[output]\nimpacts = 9000000000000\n"), "duration = 0.01\n",
            "duration = 0.01\nstep = 1.0e-11\n"),
       mesh,
       {"output.impacts = 9000000000000", "GB", "keep fewer rows"},
       false},
  };
}

std::string case_name(const testing::TestParamInfo<Wrong>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Study, WrongInput, testing::ValuesIn(wrong_studies()), case_name);
INSTANTIATE_TEST_SUITE_P(Mesh, WrongInput, testing::ValuesIn(wrong_meshes()), case_name);
INSTANTIATE_TEST_SUITE_P(Model, WrongInput, testing::ValuesIn(wrong_models()), case_name);

TEST(GoodInput, IsThatWhichTheWrongOnesChange) {
  const Workshop folder;
  folder.write("mesh.msh", good_mesh().text());
  EXPECT_EQ(folder.run_text(good_study).summary["contacts"].size(), 1u);
  folder.write("mesh.msh", lone_points({"mass"}).text());
  EXPECT_EQ(folder.run_text(lone_mass()).summary["modes"]["frequencies_hz"].size(), 1u);
}

TEST(WrongCommand, MissingStudyIsNamed) {
  const Workshop folder;
  for (const char* command : {"run", "mesh", "modes", "transient", "check"}) {
    const Outcome outcome = folder.fretwork({command, folder.path("none.toml").string()});
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_TRUE(says(outcome.err, "none.toml")) << command;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST(WrongCommand, FileInTheWayOfTheResultsIsNamed) {
  const Workshop folder;
  folder.write("mesh.msh", good_mesh().text());
  const std::string study = folder.write("study.toml", good_study).string(),
                    file = folder.write("taken", "a file").string();
  for (const std::string& output : {file, file + "/below"}) {
    const Outcome outcome = folder.fretwork({"run", study, "-o", output});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(says(outcome.err, "taken"));
    EXPECT_TRUE(says(outcome.err, "-o"));
  }
  EXPECT_EQ(bytes_of(file), "a file");
}

TEST(WrongCommand, FoldersWithoutResultsAreNamed) {
  const Workshop folder;
  for (const char* command : {"export", "report"}) {
    const Outcome outcome = folder.fretwork({command, folder.path("nowhere").string()});
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_TRUE(says(outcome.err, "nowhere")) << command;
  }
}

TEST(WrongCommand, CommandLineIsChecked) {
  const Workshop folder;
  EXPECT_EQ(folder.fretwork({}).status, 1);
  EXPECT_EQ(folder.fretwork({"run"}).status, 1);
  EXPECT_EQ(folder.fretwork({"export", ".", "--format", "xyz"}).status, 1);
  EXPECT_TRUE(says(folder.fretwork({"export", ".", "--format", "xyz"}).err, "xyz"));
  EXPECT_TRUE(says(folder.fretwork({"rum", "study.toml"}).err, "rum"));
}

TEST(Diverging, RunFailsWithStatusTwoAndLeavesOldResults) {
  const Workshop folder;
  const std::string study = example("cantilever_stop").string(), results = folder.path("results").string();
  const std::vector<std::string> unstable{
      "run", study, "-o", results, "--set", "transient.scheme=euler", "--set", "transient.step=5e-3"};
  const Outcome first = folder.fretwork(unstable);
  EXPECT_EQ(first.status, 2) << first.err;
  EXPECT_TRUE(says(first.err, "diverged"));
  EXPECT_TRUE(says(first.err, "smaller step"));
  EXPECT_EQ(std::count(first.err.begin(), first.err.end(), '\n'), 1) << first.err;
  EXPECT_FALSE(fs::exists(folder.path("results") / "summary.json"));
  EXPECT_FALSE(fs::exists(folder.path("results") / "results.h5"));
  ASSERT_EQ(folder.fretwork({"run", study, "--no-report", "-o", results}).status, 0);
  const std::string summary = bytes_of(folder.path("results") / "summary.json"),
                    series = bytes_of(folder.path("results") / "results.h5");
  EXPECT_EQ(folder.fretwork(unstable).status, 2);
  EXPECT_EQ(bytes_of(folder.path("results") / "summary.json"), summary);
  EXPECT_EQ(bytes_of(folder.path("results") / "results.h5"), series);
}

} // namespace
} // namespace fretwork::app::test::wrong_input_test
