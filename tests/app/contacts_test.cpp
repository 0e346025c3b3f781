// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts from the keys of the study to the results: laws found by the program, supports with a thickness, what is told of them.
#include "mesh_text.hpp"
#include "study_text.hpp"
#include "tubes.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::contacts_test {
namespace {

constexpr double rounding = 1e-12; ///< relative
constexpr double symmetric =
    1e-7; ///< relative: two edges whose shapes come from an eigensolver, and that sweeps take one after the other
constexpr double one_impact = 1e-2; ///< relative: speeds are those of steps, some hundred an impact

std::string support(const std::string& keys) {
  return "[[contacts]]\nname = \"plate\"\ngroup = \"mid0\"\naxis = [1.0, 0.0, 0.0]\n" + keys;
}

TEST(Thickness, SharesASupportBetweenItsEdges) {
  const Workshop folder;
  const std::string keys = "obstacle = \"drilled\"\ntube_radius = 0.009525\nhole_radius = 0.009625\n"
                           "thickness = 0.03\nnormal_stiffness = 2.0e6\nnormal_damping = 40.0\n"
                           "tangential_stiffness = 1.0e6\ntangential_damping = 20.0\nfriction = 0.3\n";
  const Results run = folder.run_text(tubes(folder, 1) + support(keys) + push(0, 200.0));
  ASSERT_EQ(run.archive.contacts.size(), 2u);
  for (const char* name : {"plate@1", "plate@2"}) {
    const auto& edge = facts(run, name);
    EXPECT_EQ(edge.normal_stiffness, 1.0e6) << name;
    EXPECT_EQ(edge.normal_damping, 20.0) << name;
    EXPECT_EQ(edge.tangential_stiffness, 0.5e6) << name;
    EXPECT_EQ(edge.tangential_damping, 10.0) << name;
    EXPECT_GT(run.statistics(name)["impacts"].get<int>(), 0) << name;
  }
  // tube, support and load are symmetric about the middle
  EXPECT_TRUE(close_to(run.statistics("plate@1")["normal_force"]["rms"],
                       run.statistics("plate@2")["normal_force"]["rms"], symmetric));
}

// A tube that rests off the centre of its hole: how far it goes is told from the centre.
TEST(Offset, LeavesTheRadiusThatOfTheHole) {
  const Workshop folder;
  const Results run = folder.run_text(
      tubes(folder, 1) + support("gap = 2.5e-4\noffset = [2.0e-4, 0.0]\nnormal_stiffness = 1.0e6\n") +
      push(0, 200.0));
  const auto& plate = run.statistics("plate");
  const double force = plate["normal_force"]["max"], radius = plate["position"]["radial"]["max"];
  ASSERT_GT(force, 1.0);
  EXPECT_TRUE(close_to(plate["penetration"]["max"], force / 1.0e6, rounding));
  EXPECT_GT(radius, 2.5e-4);
  constexpr double crest = 1e-9; // of the parabola through three steps above the largest one: 2e-10
  EXPECT_NEAR(radius / (2.5e-4 + force / 1.0e6), 1.0, crest);
  EXPECT_EQ(plate["displacement"]["radial"], plate["position"]["radial"]);
  const double moved = plate["displacement"]["y"]["max"], at = plate["position"]["y"]["max"];
  EXPECT_NEAR(at, moved - 2.0e-4, 1e-12) << "the centre is shifted";
}

TEST(Thickness, LongerThanTheTubeIsRefused) {
  const Workshop folder;
  EXPECT_TRUE(
      says(refused(folder, tubes(folder, 1) + support("gap = 0\nnormal_stiffness = 1.0\nthickness = 1.2\n")),
           "contact \"plate\": the beam ends at "));
}

TEST(TubeRadius, ThatIsNotTheTubesIsWarnedAbout) {
  const Workshop folder;
  const auto warnings = [&](const char* sizes) {
    return folder
        .run_text(tubes(folder, 1) +
                  support(fmt::format("obstacle = \"drilled\"\n{}\nnormal_stiffness = 2.0e6\n", sizes)) +
                  push(0, 200.0))
        .summary["warnings"]
        .dump();
  };
  EXPECT_TRUE(says(
      warnings("tube_radius = 0.01905\nhole_radius = 0.01915"),
      "tube_radius = 0.01905 m, but the section of the beam at its node has an outer radius of 0.009525 m"));
  EXPECT_FALSE(says(warnings("tube_radius = 0.0095\nhole_radius = 0.0096"), "tube_radius"));
}

TEST(Wall, GivesTheStiffnessOfTheTube) {
  const Workshop folder;
  const Results run = folder.run_text(tubes(folder, 2) +
                                      support("gap = 1.0e-4\nnormal_stiffness = \"wall\"\n") + push(0, 50.0));
  const double d = 0.01905, t = 0.00109;
  const double wall = 1.9 * 2.0e11 * t * t / d * std::sqrt(t / d);
  EXPECT_TRUE(close_to(facts(run, "plate").normal_stiffness, wall, rounding));
  std::string two = meeting(0, 1);
  const std::string given = "normal_stiffness = 1.0e6";
  two.replace(two.find(given), given.size(), "normal_stiffness = \"wall\"");
  const Results both = folder.run_text(tubes(folder, 2) + two + push(0, 50.0));
  EXPECT_TRUE(close_to(facts(both, "meet01").normal_stiffness, 0.5 * wall, rounding));
}

TEST(Wall, NeedsATube) {
  const Workshop folder;
  EXPECT_TRUE(
      says(refused(folder, tubes(folder, 1, "rod") + support("gap = 1.0e-4\nnormal_stiffness = \"wall\"\n")),
           "contact \"plate\": normal_stiffness = \"wall\" needs a tube, and section \"rod\" of the beam "
           "at its node is no pipe; give normal_stiffness a value (N/m)"));
}

TEST(FrictionDirection, ReachesTheLaw) {
  const Workshop folder;
  const Results run = folder.run_text(
      tubes(folder, 1) +
      support("gap = 1.0e-4\nnormal_stiffness = 1.0e6\nfriction = 0.3\ntangential_stiffness = 1.0e6\n"
              "tangential_damping = 10.0\nfriction_direction = \"axial\"\n") +
      push(0, 200.0));
  EXPECT_EQ(facts(run, "plate").friction_along, (std::array<double, 2>{1.0, 0.0}));
  EXPECT_GT(run.contact("plate").normal_force.maxCoeff(), 0.0);
  EXPECT_EQ(run.contact("plate").tangential_force.col(1).cwiseAbs().maxCoeff(), 0.0);
}

/// A mass of 2 kg that flies against a stop 1 mm away at 0.1 m/s, held by a spring that is too weak to matter.
std::string flying_mass(const Workshop& folder, const std::string& keys) {
  folder.write("mesh.msh", lone_points({"mass"}).text());
  return R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 2.0
[[springs]]
group = "mass"
stiffness = [0.0, 1.0e-3, 0.0, 0.0, 0.0, 0.0]
[[restraints]]
group = "mass"
fixed = ["ux", "uz", "rx", "ry", "rz"]
[[initial]]
group = "mass"
velocity = [0.0, 0.1, 0.0]
[transient]
duration = 0.03
[[contacts]]
name = "stop"
group = "mass"
obstacle = "stop_y"
axis = [1.0, 0.0, 0.0]
gap = 1.0e-3
normal_stiffness = 1.0e6
)" + keys;
}

TEST(Restitution, IsWhatAMassComesBackWith) {
  for (const std::string law :
       {"restitution = 0.7\n", "restitution = 0.7\nrestitution_mass = 2.0\n",
        "normal_law = \"hunt_crossley\"\nrestitution = 0.7\nrestitution_velocity = 0.1\n"}) {
    const Workshop folder;
    const Results run = folder.run_text(flying_mass(folder, law));
    const auto& stop = run.statistics("stop");
    ASSERT_EQ(stop["impacts"], 1) << law;
    EXPECT_TRUE(close_to(stop["departure_velocity"]["mean"].get<double>(),
                         0.7 * stop["impact_velocity"]["mean"].get<double>(), one_impact))
        << law;
  }
}

// The law loses more at 0.1 m/s than at the velocity that the study names: the warning has the restitution of the run.
TEST(Restitution, OfHuntAndCrossleyAtAnotherVelocityIsWarnedOf) {
  const auto run = [](const std::string& velocity) {
    const Workshop folder;
    return folder.run_text(flying_mass(
        folder,
        "normal_law = \"hunt_crossley\"\nrestitution = 0.7\nrestitution_velocity = " + velocity + "\n"));
  };
  const Results fast = run("0.02");
  const auto& stop = fast.statistics("stop");
  constexpr double two_digits = 0.005;
  EXPECT_NEAR(stop["departure_velocity"]["mean"].get<double>() / stop["impact_velocity"]["rms"].get<double>(),
              0.29, two_digits);
  EXPECT_TRUE(
      says(fast.summary["warnings"].dump(),
           "contact \\\"stop\\\": the rms impact velocity is 0.1 m/s, 5 times restitution_velocity = "
           "0.02 m/s: the restitution of hunt_crossley there is 0.29, not 0.7, and an impact loses 91 % "
           "of its energy, not 51 %; set restitution_velocity = 0.1"));
  EXPECT_TRUE(says(run("0.3").summary["warnings"].dump(), "there is 0.88, not 0.7"));
  EXPECT_FALSE(says(run("0.09").summary["warnings"].dump(), "restitution"));
}

/// Notes that say this.
std::vector<std::string> notes_with(const Results& run, const std::string& part) {
  std::vector<std::string> out;
  for (const std::string note : run.summary["notes"])
    if (note.find(part) != std::string::npos)
      out.push_back(note);
  return out;
}

TEST(Overlap, IsToldOfTheInitialState) {
  const Workshop folder;
  const std::string moved = "[[initial]]\ngroup = \"mass\"\ndisplacement = [0.0, 1.5e-3, 0.0]\n";
  EXPECT_TRUE(notes_with(folder.run_text(flying_mass(folder, "")), "overlap").empty());
  // K_N times 0.5 mm, and C_N times 0.1 m/s
  EXPECT_EQ(
      notes_with(folder.run_text(flying_mass(folder, moved)), "overlap"),
      std::vector<std::string>{"contact \"stop\" starts with an overlap of 0.0005 m: it presses with 500 N"});
  const Results damped = folder.run_text(
      flying_mass(folder, "normal_damping = 1.0e3\n" + moved +
                              "[[initial]]\ngroup = \"mass\"\n"
                              "displacement = [0.0, 1.5e-3, 0.0]\nvelocity = [0.0, 0.1, 0.0]\n"));
  EXPECT_EQ(notes_with(damped, "presses with 600 N").size(), 1u);
}

// The same support twice, under another name, shares force and wear: half of each.
TEST(Warnings, NameAContactThatIsThereTwice) {
  const Workshop folder;
  const std::string hole = "gap = 2.0e-4\nnormal_stiffness = 1.0e6\n", again = support(hole);
  const auto with = [&](const std::string& second) {
    return folder.run_text(tubes(folder, 1) + support(hole) + second).summary["warnings"].dump();
  };
  const auto named = [&](std::string text, const std::string& more) {
    return text.replace(text.find("\"plate\""), 7, "\"again\"") + more;
  };
  EXPECT_TRUE(says(with(named(again, "")), "contacts \\\"plate\\\" and \\\"again\\\" are at one node"));
  EXPECT_FALSE(says(with(named(again, "offset = [0.0, 1.0e-5]\n")), "are at one node"));
  EXPECT_FALSE(says(with(named(support("gap = 3.0e-4\nnormal_stiffness = 1.0e6\n"), "")), "are at one node"));
}

// An origin in mm, or of another support.
TEST(Warnings, NameATubeThatRestsInsideItsObstacle) {
  const Workshop folder;
  const std::string hole = "gap = 2.0e-4\nnormal_stiffness = 1.0e6\n";
  const auto with = [&](const std::string& keys) {
    return folder.run_text(tubes(folder, 1) + support(hole + keys)).summary["warnings"].dump();
  };
  const std::string warning = "rests 0.0198 m inside its obstacle; look at origin";
  EXPECT_TRUE(says(with("offset = [0.0, 0.02]\n"), warning));
  EXPECT_FALSE(says(with("offset = [0.0, 0.005]\n"), "inside its obstacle"));
}

TEST(Contacts, WithAClearanceOfTheSizeOfTheTubeAreAWarning) {
  const Workshop folder;
  const auto with = [&](const std::string& size) {
    return folder.run_text(tubes(folder, 1) + support(size + "normal_stiffness = 1.0e6\n"), {"--force"})
        .summary["warnings"]
        .dump();
  };
  const std::string warning = "is of the size of the tube, whose radius is 0.009525 m";
  EXPECT_TRUE(says(with("gap = 0.009725\n"), warning)); // the radius of the hole
  const std::string bars = "obstacle = \"bars_y\"\ny_axis = [0, 0, 1]\ntube_radius = 0.009525\nbars = ";
  EXPECT_TRUE(says(with(bars + "[0.01925, 0.01925]\n"), warning)); // diameters
  EXPECT_FALSE(says(with(bars + "[0.009625, 0.009625]\n"), "of the size of the tube"));
  EXPECT_FALSE(says(with("gap = 2.0e-3\n"), "of the size of the tube"));
}

TEST(Notes, AreOneLineAContactOfTheStudyOverlapsFirst) {
  const Workshop folder;
  const std::string plate = "gap = 0.0\noffset = [0.0, -2.0e-4]\nthickness = 0.03\nthickness_points = 3\n"
                            "normal_stiffness = \"wall\"\nrestitution = 0.7\nrestitution_mass = 2.0\n"
                            "friction = 0.3\ntangential_stiffness = 1.0e6\n";
  const Results run = folder.run_text(tubes(folder, 1) + support(plate));
  const auto notes = notes_with(run, "contact \"plate");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], run.summary["notes"][1]) << "after what the modes lack, which makes forces wrong";
  EXPECT_TRUE(says(notes[0], "contact \"plate\": 3 of 3 points start with an overlap, the deepest \"plate@"));
  EXPECT_TRUE(says(notes[0], "with 0.0002 m: it presses with "));
  EXPECT_TRUE(
      says(notes[1], "contact \"plate\": stiffness of the tube's wall 5.669e+06 N/m, normal damping "));
  EXPECT_TRUE(
      says(notes[1], " N s/m for restitution 0.7 with a mass of 2 kg, automatic tangential damping "));
  EXPECT_TRUE(says(notes[1], "(of the whole support: each point has 0.3333 of it)"));
  EXPECT_TRUE(says(notes[1], ", stiffer than tangential_stiffness above "));
  const results::ContactFacts& point = facts(run, "plate@2");
  EXPECT_TRUE(says(notes[1], fmt::format(" {:.4g} Hz", point.tangential_stiffness / point.tangential_damping /
                                                           (2.0 * std::numbers::pi))));
}

TEST(Restitution, TakesTheMassThatTheModesGive) {
  const Workshop folder;
  const Results found = folder.run_text(flying_mass(folder, "restitution = 0.7\n"));
  const double damping = facts(found, "stop").normal_damping;
  const Results given = folder.run_text(flying_mass(folder, "restitution = 0.7\nrestitution_mass = 2.0\n"));
  EXPECT_TRUE(close_to(damping, facts(given, "stop").normal_damping, rounding));
  EXPECT_TRUE(says(found.summary["notes"].dump(), "for restitution 0.7 with a mass of 2 kg"));
  // e = exp(-2 xi acos(xi)/sqrt(1 - xi^2)) with C_N = 2 xi sqrt(K_N m)
  const double xi = damping / (2.0 * std::sqrt(1.0e6 * 2.0));
  EXPECT_TRUE(close_to(std::exp(-2.0 * xi * std::acos(xi) / std::sqrt(1.0 - xi * xi)), 0.7, rounding));
}

/// A block on a plane, dragged to and fro on a soft tangential spring with a strong damper.
std::string dragged_block(const Workshop& folder, const std::string& memory) {
  folder.write("mesh.msh", lone_points({"block"}).text());
  return R"([mesh]
file = "mesh.msh"
[[masses]]
group = "block"
mass = 1.0
[[springs]]
group = "block"
stiffness = [100.0, 100.0, 0.0, 0.0, 0.0, 0.0]
[[restraints]]
group = "block"
fixed = ["uz", "rx", "ry", "rz"]
[[loads]]
group = "block"
direction = [0.0, 1.0, 0.0]
constant = 10.0
[[loads]]
group = "block"
direction = [1.0, 0.0, 0.0]
harmonic = { amplitude = 10.0, frequency = 5.0 }
[[initial]]
group = "block"
velocity = [1.0, 0.0, 0.0]
[[contacts]]
name = "plane"
group = "block"
obstacle = "stop_y"
axis = [1.0, 0.0, 0.0]
gap = 0.0
normal_stiffness = 1.0e6
normal_damping = 100.0
tangential_stiffness = 100.0
tangential_damping = 100.0
friction = 0.3
friction_memory = ")" +
         memory + R"("
[transient]
duration = 1.0
[output]
every = 0.01
)";
}

TEST(ReferenceMemory, ThatGivesEnergyIsWarnedOf) {
  const Workshop folder;
  const auto told = [&](const std::string& memory) {
    const Results run = folder.run_text(dragged_block(folder, memory));
    const double given = -run.summary["energy"]["contact_damping_J"].get<double>() /
                         run.summary["energy"]["input_J"].get<double>();
    return std::pair{given, run.summary["warnings"].dump()};
  };
  const auto [given, warnings] = told("reference");
  EXPECT_GT(given, 0.02);
  EXPECT_TRUE(says(warnings, "the dampers of the contacts gave 3.1 % of the energy put in"));
  EXPECT_TRUE(says(warnings, "return_map"));
  const auto [taken, silent] = told("return_map");
  EXPECT_LT(taken, 0.0);
  EXPECT_EQ(silent.find("return_map"), std::string::npos);
}

} // namespace
} // namespace fretwork::app::test::contacts_test
