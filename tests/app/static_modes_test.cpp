// SPDX-License-Identifier: GPL-3.0-or-later
// static_modes = "all": static modes have what the modes lack of the flexibility at the contacts. Few modes then rest where the
// structure does, and hit as many modes do.
#include "mesh_text.hpp"
#include "program.hpp"
#include <Eigen/Dense>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::static_modes_test {
namespace {

constexpr double young = 2.0e11, density = 8000.0, side = 0.02;
constexpr double bending = young * side * side * side * side / 12.0; // N m2

/// Square beams in the plane x-y, of the groups named.
std::string beams(const std::vector<std::string>& groups) {
  std::string study = fmt::format(R"([mesh]
file = "beams.msh"
[materials.steel]
young_modulus = {}
poisson_ratio = 0.3
density = {}
[sections.bar]
shape = "rectangle"
height_y = {}
height_z = {}
)",
                                  young, density, side, side);
  for (const std::string& group : groups)
    study +=
        fmt::format("[[beams]]\ngroup = \"{0}\"\nmaterial = \"steel\"\nsection = \"bar\"\n[[restraints]]\n"
                    "group = \"{0}\"\nfixed = [\"ux\", \"uz\", \"rx\", \"ry\"]\n",
                    group);
  return study;
}

std::string clamped(const std::string& group) {
  return fmt::format("[[restraints]]\ngroup = \"{}\"\nfixed = \"all\"\n", group);
}

std::string modes(int count, const std::string& static_modes) {
  return fmt::format("[modes]\ncount = {}\ndamping = 0.01\nstatic_modes = \"{}\"\n", count, static_modes);
}

/// Of a cantilever between a and b, m/N.
double cantilever(double a, double b) {
  const double x = std::min(a, b), y = std::max(a, b);
  return x * x * (3.0 * y - x) / (6.0 * bending);
}

/// The splitting rests (w h)^2/8 from equilibrium.
constexpr double of_the_splitting = 1e-5;

TEST(StaticModes, CoupledContactsRestWhereTheStructureDoes) {
  constexpr double stiffness = 1e6, overlap[] = {1e-4, 2e-4, 1e-4}, places[] = {0.4, 0.7, 1.0}, load = 200.0;
  const Workshop folder;
  MeshText mesh = straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 20);
  std::string contacts;
  for (int c = 0; c < 3; ++c) {
    mesh.points.emplace_back(fmt::format("stop{}", c), static_cast<int>(std::lround(20.0 * places[c])));
    contacts += fmt::format(R"([[contacts]]
name = "stop{0}"
group = "stop{0}"
obstacle = "stop_y"
gap = 0.0
axis = [1.0, 0.0, 0.0]
offset = [{1}, 0.0]
normal_stiffness = {2}
)",
                            c, -overlap[c], stiffness);
  }
  mesh.points.emplace_back("loaded", 15);
  folder.write("beams.msh", mesh.text());
  Eigen::Matrix3d compliance;
  Eigen::Vector3d pressed;
  for (int i = 0; i < 3; ++i) {
    pressed(i) = overlap[i] + load * cantilever(places[i], 0.75);
    for (int j = 0; j < 3; ++j)
      compliance(i, j) = cantilever(places[i], places[j]) + (i == j ? 1.0 / stiffness : 0.0);
  }
  const Eigen::Vector3d exact = compliance.inverse() * pressed;
  const auto run = [&](const std::string& static_modes) {
    return folder.run_text(
        beams({"beam"}) + clamped("beam_begin") + modes(5, static_modes) + contacts +
            fmt::format("[[loads]]\ngroup = \"loaded\"\ndirection = [0.0, 1.0, 0.0]\nconstant = {}\n"
                        "[transient]\nduration = 0.01\nstep = 1.0e-6\nstart = \"static\"\n",
                        load),
        {"--force"});
  };
  const Results none = run("none"), all = run("all");
  for (int c = 0; c < 3; ++c) {
    const auto& contact = all.statistics(fmt::format("stop{}", c));
    EXPECT_GT(exact(c), 1.0);
    EXPECT_TRUE(close_to(contact["normal_force"]["mean"], exact(c), of_the_splitting));
    EXPECT_TRUE(
        close_to(contact["displacement"]["y"]["mean"], exact(c) / stiffness - overlap[c], of_the_splitting));
    for (const char* part : {"exact", "basis"})
      EXPECT_TRUE(close_to(contact["static_flexibility"][part], cantilever(places[c], places[c]), 1e-9));
    const auto& lacking = none.statistics(fmt::format("stop{}", c))["static_flexibility"];
    const double sum = lacking["basis"].get<double>() + lacking["missing"].get<double>();
    EXPECT_TRUE(close_to(sum, lacking["exact"], 1e-7));
  }
  double worst = 0.0;
  for (int c = 0; c < 3; ++c)
    worst = std::max(
        worst,
        std::abs(none.statistics(fmt::format("stop{}", c))["normal_force"]["mean"].get<double>() / exact(c) -
                 1.0));
  EXPECT_GT(worst, 100.0 * of_the_splitting) << "there is something to be missed";
  EXPECT_TRUE(says(all.summary["notes"].dump(), "3 static modes at the contacts"));
}

TEST(StaticModes, HaveTheFlexibilityOfBothStructuresOfAContact) {
  constexpr double stiffness = 1e8, overlap = 1e-4, one = 1.0, two = 0.6;
  const Workshop folder;
  folder.write("beams.msh", together(straight_line("one", {0.0, 0.0, 0.0}, {one, 0.0, 0.0}, 20),
                                     straight_line("two", {one + two, -0.02, 0.0}, {one, -0.02, 0.0}, 20))
                                .text());
  const Results run =
      folder.run_text(beams({"one", "two"}) + clamped("one_begin") + clamped("two_begin") + modes(4, "all") +
                      fmt::format(R"([[contacts]]
name = "tips"
group = "one_end"
other = "two_end"
obstacle = "plane_y"
axis = [1.0, 0.0, 0.0]
distance_1 = 0.01
distance_2 = {}
normal_stiffness = {}
[transient]
duration = 0.002
step = 2.0e-7
start = "static"
)",
                                  0.01 + overlap, stiffness));
  const double flexibility = (one * one * one + two * two * two) / (3.0 * bending);
  const auto& contact = run.statistics("tips");
  EXPECT_TRUE(close_to(contact["static_flexibility"]["exact"], flexibility, 1e-9));
  EXPECT_TRUE(
      close_to(contact["normal_force"]["mean"], overlap / (1.0 / stiffness + flexibility), of_the_splitting));
}

/// A free beam that flies into a stop with its middle.
Results flight(const Workshop& folder, int count, const std::string& static_modes) {
  MeshText mesh = straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 60);
  mesh.points.emplace_back("middle", 30);
  folder.write("beams.msh", mesh.text());
  return folder.run_text(beams({"beam"}) + modes(count, static_modes) + R"([[initial]]
group = "beam"
velocity = [0.0, 1.0, 0.0]
[[contacts]]
name = "stop"
group = "middle"
obstacle = "stop_y"
axis = [1.0, 0.0, 0.0]
gap = 1.0e-4
normal_stiffness = 1.0e6
[transient]
duration = 0.006
step = 5.0e-7
)",
                         {"--force"});
}

TEST(StaticModes, AFreeBeamIsRelievedByItsInertia) {
  const Workshop folder;
  const double many = flight(folder, 40, "none").statistics("stop")["normal_force"]["max"];
  const double none = flight(folder, 5, "none").statistics("stop")["normal_force"]["max"];
  const double all = flight(folder, 5, "all").statistics("stop")["normal_force"]["max"];
  constexpr double enough =
      2e-3; // of three elastic modes, up to 4.7 times the frequency of the contact, and their static mode
  EXPECT_TRUE(close_to(all, many, enough));
  EXPECT_GT(std::abs(none / many - 1.0), 2.0 * enough);
}

TEST(StaticModes, AreTheSameOnAnyNumberOfRanks) {
  const Workshop folder;
  MeshText mesh;
  std::string study = beams({"beam0", "beam1", "beam2"}) + modes(6, "all");
  for (int i = 0; i < 3; ++i) {
    MeshText beam =
        straight_line(fmt::format("beam{}", i), {0.0, 0.1 * i, 0.0}, {1.0 + 0.1 * i, 0.1 * i, 0.0}, 12);
    beam.points.emplace_back(fmt::format("stop{}", i), 7);
    mesh = together(mesh, beam);
    study += clamped(fmt::format("beam{}_begin", i)) +
             fmt::format("[[contacts]]\ngroup = \"stop{0}\"\naxis = [1.0, 0.0, 0.0]\ngap = "
                         "1.0e-5\nnormal_stiffness = 1.0e6\n"
                         "[[loads]]\ngroup = \"beam{0}_end\"\ndirection = [0.0, 1.0, 0.0]\n"
                         "harmonic = {{ amplitude = 50.0, frequency = 20.0 }}\n",
                         i);
  }
  folder.write("beams.msh", mesh.text());
  study += "[transient]\nduration = 0.05\n[output]\nevery = 1.0e-3\n";
  const Results one = folder.run_text(study, {"--force"});
  EXPECT_GT(one.statistics("stop0")["impacts"], 0);
  for (const int ranks : {2, 3}) {
    const Results more = folder.run_text(study, {"--force"}, ranks);
    EXPECT_TRUE(same_numbers(one.archive, more.archive)) << ranks;
    EXPECT_EQ(lasting(one.summary), lasting(more.summary)) << ranks;
  }
  // the modes of `fretwork modes` are read again
  const fs::path file = folder.write("study.toml", study);
  ASSERT_EQ(folder.fretwork({"modes", file.string(), "-o", folder.path("staged").string()}, 2).status, 0);
  const std::string stored = bytes_of(folder.path("staged") / "modes.h5");
  ASSERT_EQ(folder.fretwork({"transient", file.string(), "-o", folder.path("staged").string()}).status, 0);
  EXPECT_EQ(bytes_of(folder.path("staged") / "modes.h5"), stored);
  EXPECT_TRUE(same_numbers(one.archive, read_results(folder.path("staged")).archive));
}

/// A cantilever that rattles with friction on a circle at its tip.
std::string rattling(const std::string& modes, const std::string& scheme) {
  return beams({"beam"}) + clamped("beam_begin") + modes +
         "[[contacts]]\ngroup = \"beam_end\"\naxis = [1.0, 0.0, 0.0]\ngap = 1.0e-5\nnormal_stiffness = "
         "1.0e6\n"
         "restitution = 0.5\nfriction = 0.3\ntangential_stiffness = 5.0e5\n"
         "[[loads]]\ngroup = \"beam_end\"\ndirection = [0.0, 1.0, 0.0]\nharmonic = { amplitude = 50.0, "
         "frequency "
         "= 20.0 }\n[transient]\nduration = 0.02\nscheme = \"" +
         scheme + "\"\n";
}

TEST(AddedStaticModes, AreTakenByEveryScheme) {
  const Workshop folder;
  folder.write("beams.msh", straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 10).text());
  std::vector<double> forces;
  for (const char* scheme : {"splitting", "collocation", "energy_conserving", "euler", "devogelaere"}) {
    const Results run = folder.run_text(rattling(modes(4, "all"), scheme), {"--force"});
    EXPECT_EQ(run.summary["transient"]["scheme"], scheme);
    EXPECT_GT(run.statistics("beam_end")["impacts"], 0) << scheme;
    forces.push_back(run.statistics("beam_end")["normal_force"]["max"]);
    constexpr double of_the_schemes = 0.02; // one impact of the automatic steps of an accuracy of 1 %
    EXPECT_TRUE(close_to(forces.back(), forces.front(), of_the_schemes)) << scheme;
  }
}

/// What the laws of contacts take from the modes.
std::string laws_of(const Results& run) {
  for (const auto& note : run.summary["notes"])
    if (says(note.get<std::string>(), "automatic tangential damping"))
      return note;
  return "no note of laws";
}

// Studies written before static modes were what "auto" gives keep their key.
TEST(AddedStaticModes, AreWhatAutoGives) {
  const Workshop folder;
  folder.write("beams.msh", straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 10).text());
  const Results all = folder.run_text(rattling(modes(4, "all"), "auto"), {"--force"});
  const Results automatic = folder.run_text(rattling(modes(4, "auto"), "auto"), {"--force"});
  EXPECT_EQ(automatic.summary["modes"]["static_modes"], 1);
  EXPECT_TRUE(same_numbers(all.archive, automatic.archive));
}

TEST(AddedStaticModes, AreListedApartAndChangeNoLaw) {
  const Workshop folder;
  folder.write("beams.msh", straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 10).text());
  const Results none = folder.run_text(rattling(modes(4, "none"), "auto"), {"--force"});
  const Results all = folder.run_text(rattling(modes(4, "all"), "auto"), {"--force"});
  EXPECT_TRUE(says(laws_of(none), "for restitution 0.5 with a mass of"));
  EXPECT_EQ(laws_of(all), laws_of(none));
  auto with = all.summary["modes"];
  const auto& without = none.summary["modes"];
  EXPECT_EQ(without["static_modes"], 0);
  EXPECT_EQ(with["static_modes"], 1); // the beam moves in one plane
  ASSERT_EQ(with["static_frequencies_hz"].size(), 1);
  EXPECT_GT(with["static_frequencies_hz"][0], with["frequencies_hz"].back());
  EXPECT_EQ(with["static_damping"][0], 0.01);
  for (const char* key : {"frequencies_hz", "damping", "residuals", "error_estimate", "effective_mass_kg",
                          "effective_mass_sum_kg"})
    EXPECT_EQ(with[key], without[key]) << key;
  EXPECT_EQ(all.archive.bases.at(0).static_modes, 1);
  EXPECT_EQ(all.archive.bases.at(0).size(), 5);
  EXPECT_EQ(all.archive.series.modal_displacement.rows(), 5);
}

TEST(AddedStaticModes, HaveTheRatioOfTheHighestModeOfAList) {
  const Workshop folder;
  folder.write("beams.msh", straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 10).text());
  const Results run = folder.run_text(
      rattling("[modes]\ncount = 3\ndamping = [0.01, 0.02, 0.03, 0.04]\nstatic_modes = \"all\"\n", "auto"));
  EXPECT_EQ(run.summary["modes"]["static_damping"][0], 0.03);
  EXPECT_TRUE(says(run.summary["notes"].dump(), "static modes have the ratio of the highest"));
}

TEST(AddedStaticModes, AreNoneWhereNothingIsMissing) {
  const Workshop folder;
  folder.write("beams.msh", straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 10).text());
  const Results run = folder.run_text(rattling(modes(20, "all"), "auto"));
  EXPECT_EQ(run.summary["modes"]["static_modes"], 0);
  EXPECT_FALSE(run.summary["modes"].contains("static_frequencies_hz"));
  EXPECT_TRUE(says(run.summary["notes"].dump(), "no static modes: the modes lack nothing"));
}

} // namespace

TEST(StaticModes, HoldTubesInHolesThatFewModesBarelyFeel) {
  // 12 modes, eight holes: K_N R = 22, and no friction
  const Workshop folder;
  const Results run = folder.run(example("straight_tube"), "results",
                                 {"--set", "modes.count=12", "--set", "modes.static_modes=all", "--set",
                                  "contacts.support.friction=0", "--set", "transient.duration=0.1", "--set",
                                  "output.statistics_from=0", "--set", "transient.scheme=splitting"});
  EXPECT_TRUE(says(run.summary["notes"].dump(), "16 static modes at the contacts"));
  constexpr double balance = 5e-3; // 1e-3 measured over seconds
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), balance);
  EXPECT_GT(run.statistics("support[3]")["normal_force"]["max"].get<double>(), 1.0);
}

TEST(StaticModes, AreExportedAfterTheModesOfAllStructures) {
  const Workshop folder;
  const Results run = folder.run(example("two_tubes"), "results",
                                 {"--set", "modes.count=4", "--set", "modes.static_modes=all", "--set",
                                  "transient.duration=0.02", "--set", "output.statistics_from=0"});
  ASSERT_EQ(folder.fretwork({"export", folder.path("results").string(), "--format", "msh"}).status, 0);
  const std::string modes = bytes_of(folder.path("results") / "export-msh" / "modes.msh");
  EXPECT_TRUE(says(modes, "\"mode 4 of each structure\""));
  EXPECT_FALSE(says(modes, "\"mode 5 of each structure\""));
  EXPECT_TRUE(says(modes, "\"static mode 1 of each structure\""));
}

} // namespace fretwork::app::test::static_modes_test
