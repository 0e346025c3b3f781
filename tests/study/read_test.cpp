// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_constants.hpp"
#include "folder.hpp"
#include "paths.hpp"
#include "study/study.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::study::read_test {
namespace {

constexpr double rounding = 1e-15; // a few units in the last place of numbers of size 1

using Numbers6 = std::array<double, 6>;

TEST(ReadStudy, TakesAStudyThatNamesOnlyAMesh) {
  const Study study = read_text("[mesh]\nfile = \"a.msh\"\n");
  EXPECT_EQ(study.mesh.file.filename(), "a.msh");
  EXPECT_EQ(study.title, "");
  EXPECT_FALSE(study.mesh.element_size);
  EXPECT_EQ(study.mesh.scale, 1.0);
  EXPECT_EQ(study.mesh.merge_tolerance, 0.0);
  EXPECT_TRUE(study.materials.empty() && study.sections.empty() && study.beams.empty() &&
              study.restraints.empty());
  EXPECT_TRUE(study.masses.empty() && study.springs.empty() && study.contacts.empty() && study.loads.empty());
  EXPECT_TRUE(study.base_motions.empty() && study.initial.empty() && study.overrides.empty());
  EXPECT_FALSE(study.gravity);
  EXPECT_FALSE(study.transient);
}

TEST(ReadStudy, GivesModesAndOutputTheirDefaults) {
  const Study study = read_text("[mesh]\nfile = \"a.msh\"\n");
  EXPECT_EQ(study.modes.count, 40);
  EXPECT_FALSE(study.modes.number_given);
  EXPECT_FALSE(study.modes.up_to_hz);
  EXPECT_EQ(std::get<double>(study.modes.damping), 0.0);
  EXPECT_FALSE(study.modes.distributed);
  EXPECT_FALSE(study.output.every);
  EXPECT_TRUE(study.output.nodes.empty());
  EXPECT_EQ(study.output.statistics_from, 0.0);
  EXPECT_EQ(study.output.impacts, 10000);
  EXPECT_EQ(study.output.rest_time, 0.0);
  EXPECT_EQ(study.output.checkpoint, 60.0);
}

TEST(ReadStudy, GivesTheTransientItsDefaults) {
  const Study study = read_text("[mesh]\nfile = \"a.msh\"\n[transient]\nduration = 3\n");
  ASSERT_TRUE(study.transient);
  EXPECT_EQ(study.transient->duration, 3.0);
  EXPECT_EQ(study.transient->scheme, Scheme::automatic);
  EXPECT_EQ(study.transient->accuracy, 0.01);
  EXPECT_EQ(study.transient->start, Start::rest);
  EXPECT_FALSE(study.transient->step);
  EXPECT_FALSE(study.transient->verify);
  EXPECT_TRUE(
      read_text("[mesh]\nfile = \"a.msh\"\n[transient]\nduration = 3\nverify = true\n").transient->verify);
}

TEST(ReadStudy, GivesAContactItsDefaults) {
  const Study study =
      read_text("[mesh]\nfile = \"a.msh\"\n[[contacts]]\ngroup = \"p\"\ngap = 0.1\nnormal_stiffness = 1e6\n");
  const Contact& contact = study.contacts.at(0);
  EXPECT_EQ(contact.name, "p");
  EXPECT_EQ(contact.obstacle, ObstacleKind::circle);
  EXPECT_FALSE(contact.axis || contact.y_axis || contact.origin);
  EXPECT_EQ(contact.angle, 0.0);
  EXPECT_EQ(contact.offset, (std::array<double, 2>{0.0, 0.0}));
  EXPECT_EQ(contact.normal_damping, 0.0);
  EXPECT_EQ(contact.tangential_stiffness, 0.0);
  EXPECT_FALSE(contact.tangential_damping);
  EXPECT_EQ(contact.friction_static, 0.0);
  EXPECT_EQ(contact.friction_dynamic, 0.0);
  EXPECT_EQ(contact.memory, contact::FrictionMemoryKind::return_map);
}

TEST(ReadStudy, GivesTheOtherEntriesTheirDefaults) {
  const Study study = read_text(R"([mesh]
file = "a.msh"
[materials.m]
young_modulus = 1
poisson_ratio = 0
density = 0
[sections.s]
shape = "general"
area = 1
iy = 2
iz = 2
torsion_constant = 1
[[beams]]
group = "b"
material = "m"
section = "s"
[[masses]]
group = "p"
mass = 1
[[springs]]
group = "p"
damping = [1, 0, 0, 0, 0, 0]
[[loads]]
group = "p"
direction = [1, 0, 0]
random = { rms = 1, band = [0, 1] }
[[loads]]
group = "p"
direction = [1, 0, 0]
harmonic = { amplitude = 1, frequency = 2 }
[[initial]]
group = "p"
velocity = [1, 0, 0]
)");
  EXPECT_EQ(study.sections.at("s").polar_inertia, 4.0);
  EXPECT_FALSE(study.beams[0].orientation);
  EXPECT_EQ(study.beams[0].added_mass, 0.0);
  EXPECT_EQ(study.beams[0].added_mass_direction, fem::AddedMass::transverse);
  EXPECT_EQ(study.masses[0].inertia, Vec3::Zero());
  EXPECT_EQ(study.masses[0].arm, Vec3::Zero());
  EXPECT_FALSE(study.springs[0].other);
  EXPECT_EQ(study.springs[0].stiffness, Numbers6{});
  EXPECT_FALSE(study.loads[0].per_length || study.loads[0].moment);
  EXPECT_EQ(study.loads[0].function, signals::TimeFunction(signals::Random{1.0, 0.0, 1.0, 1}));
  EXPECT_EQ(study.loads[1].function, signals::TimeFunction(signals::Harmonic{1.0, 2.0, 0.0}));
  EXPECT_EQ(study.initial[0].displacement, Vec3::Zero());
  EXPECT_EQ(study.initial[0].rotation_rate, Vec3::Zero());
  EXPECT_EQ(study.initial[0].centre, Vec3::Zero());
}

TEST(ReadStudy, ReadsEveryKeyOfTheStructure) {
  const Study study = read_text(full_study);
  EXPECT_EQ(study.title, "U-bend");
  EXPECT_EQ(study.mesh.file, study.file.parent_path() / "meshes/tube.geo");
  EXPECT_EQ(study.mesh.element_size, 0.05);
  EXPECT_EQ(study.mesh.scale, 0.001);
  EXPECT_EQ(study.mesh.merge_tolerance, 1e-6);
  EXPECT_EQ(study.materials.at("inconel").young_modulus, 2e11);
  EXPECT_EQ(study.materials.at("inconel").poisson_ratio, 0.3);
  EXPECT_EQ(study.materials.at("inconel").density, 8200.0);
  EXPECT_EQ(study.sections.at("tube").area, fem::pipe_section(0.02, 0.001).area);
  EXPECT_EQ(study.sections.at("bar").iy, fem::rectangle_section(0.01, 0.02).iy);
  EXPECT_EQ(study.sections.at("bar").iz, fem::rectangle_section(0.01, 0.02).iz);
  EXPECT_EQ(study.sections.at("rod").area, fem::circle_section(0.2).area);
  const fem::Section& free = study.sections.at("free");
  EXPECT_EQ((std::array{free.area, free.iy, free.iz, free.torsion_constant, free.polar_inertia}),
            (std::array{1e-3, 1e-8, 2e-8, 1e-9, 4e-8}));
  EXPECT_EQ(study.beams.at(0).group, "tube");
  EXPECT_EQ(study.beams[0].material, "inconel");
  EXPECT_EQ(study.beams[0].section, "tube");
  EXPECT_EQ(study.beams[0].added_mass, 0.3);
  EXPECT_EQ(study.beams[0].fluid, (fem::Fluid{750.0, 1000.0, 1.5}));
  EXPECT_FALSE(study.beams[0].taper);
  EXPECT_EQ(study.beams[0].axial_force, 0.0);
  EXPECT_EQ(study.beams[0].added_mass_direction, fem::AddedMass::all);
  EXPECT_EQ(study.beams.at(1).orientation, Vec3(0, 0, 2));
  EXPECT_EQ(study.restraints.at(0).group, "ends");
  EXPECT_EQ(study.restraints[0].fixed, 0b100001);
  EXPECT_EQ(study.restraints.at(1).fixed, 0b111111);
  EXPECT_EQ(study.masses.at(0).group, "apex");
  EXPECT_EQ(study.masses[0].mass, 0.5);
  EXPECT_EQ(study.masses[0].inertia, Vec3(1, 2, 3));
  EXPECT_EQ(study.masses[0].arm, Vec3(0, 0.1, -0.1));
  EXPECT_EQ(study.springs.at(0).group, "apex");
  EXPECT_EQ(study.springs[0].other, "wall");
  EXPECT_EQ(study.springs[0].stiffness, (Numbers6{0, 1e4, 0, 0, 0, 6}));
  EXPECT_EQ(study.springs[0].damping, (Numbers6{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(study.ties.at(0).group, "hinge");
  EXPECT_EQ(study.ties[0].other, "arm_end");
  EXPECT_EQ(study.ties[0].tied, 0b100001);
}

// Case E2: 40 x 5 mm of 7800 kg/m3 in and full of water, of which one displaced mass times 2/pi goes along.
TEST(ReadStudy, AddsTheFluidsOfATube) {
  constexpr double printed = 2e-5; // 5.7952 kg/m
  const auto mass = [](const std::string& shape, const std::string& fluid) {
    const Study study =
        read_text("[mesh]\nfile = \"a.msh\"\n[materials.m]\nyoung_modulus = 2.1e11\npoisson_ratio = "
                  "0.3\ndensity = 7800\n[sections.s]\n" +
                  shape + "\n[[beams]]\ngroup = \"g\"\nmaterial = \"m\"\nsection = \"s\"\n" + fluid);
    fem::BeamProperty property{study.materials.at("m"), study.sections.at("s")};
    property.fluid = study.beams.at(0).fluid;
    return fem::beam_constants(property).mass_transverse;
  };
  const std::string tube = "shape = \"pipe\"\nouter_diameter = 0.04\nthickness = 0.005";
  const double wet =
      mass(tube, "fluid_inside = 1000\nfluid_outside = { density = 1000, confinement = 0.6366197723675814 }");
  EXPECT_NEAR(wet / 5.7952, 1.0, printed);
  const double solid = mass("shape = \"circle\"\ndiameter = 0.04", "fluid_outside = { density = 1000 }");
  EXPECT_NEAR(solid, 8800.0 * std::numbers::pi * 0.02 * 0.02, 10 * rounding);
}

TEST(ReadStudy, ReadsEveryKeyOfTheContacts) {
  const Study study = read_text(full_study);
  ASSERT_EQ(study.contacts.size(), 2u);
  const Contact& first = study.contacts[0];
  EXPECT_EQ(first.name, "tsp1");
  EXPECT_EQ(first.group, "point1");
  EXPECT_EQ(first.obstacle, ObstacleKind::plane_y);
  EXPECT_EQ(std::get<contact::PlanePair>(first.shape).gap, 2e-4);
  EXPECT_EQ(first.axis, Vec3(0, 0, 1));
  EXPECT_EQ(first.y_axis, Vec3(1, 0, 0));
  EXPECT_EQ(first.origin, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(first.offset, (std::array<double, 2>{1e-5, -2e-5}));
  EXPECT_EQ(first.normal_stiffness, 1e6);
  EXPECT_EQ(first.normal_damping, 10.0);
  EXPECT_EQ(first.tangential_stiffness, 2e6);
  EXPECT_EQ(first.tangential_damping, 3.0);
  EXPECT_EQ(first.friction_static, 0.4);
  EXPECT_EQ(first.friction_dynamic, 0.3);
  EXPECT_EQ(first.memory, contact::FrictionMemoryKind::reference);
  const Contact& second = study.contacts[1];
  EXPECT_EQ(second.obstacle, ObstacleKind::stop_z);
  EXPECT_EQ(second.angle, 30.0);
  EXPECT_FALSE(second.tangential_damping);
  EXPECT_EQ(second.friction_static, 0.2);
  EXPECT_EQ(second.friction_dynamic, 0.2);
}

TEST(ReadStudy, ReadsEveryKeyOfTheLoads) {
  const Study study = read_text(full_study);
  ASSERT_EQ(study.loads.size(), 3u);
  EXPECT_EQ(study.loads[0].group, "apex");
  EXPECT_TRUE(study.loads[0].per_length);
  EXPECT_NEAR((study.loads[0].direction - Vec3(0, 0.6, 0.8)).norm(), 0.0, rounding);
  EXPECT_EQ(study.loads[0].function, signals::TimeFunction(signals::Harmonic{10, 25, 0.5}));
  EXPECT_TRUE(study.loads[1].moment);
  EXPECT_EQ(study.loads[1].function, signals::TimeFunction(signals::Table{{0, 1, 1}, {1, 1, 2.5}}));
  EXPECT_EQ(study.loads[2].function, signals::TimeFunction(signals::Random{5, 5, 200, 7}));
  EXPECT_EQ(study.gravity, Vec3(0, 0, -9.81));
  ASSERT_EQ(study.base_motions.size(), 1u);
  EXPECT_EQ(study.base_motions[0].direction, Vec3(0, 0, -1));
  EXPECT_EQ(study.base_motions[0].acceleration, signals::TimeFunction(signals::Constant{1.5}));
  ASSERT_EQ(study.initial.size(), 1u);
  EXPECT_EQ(study.initial[0].group, "apex");
  EXPECT_EQ(study.initial[0].displacement, Vec3(0, 1e-3, 0));
  EXPECT_EQ(study.initial[0].velocity, Vec3(1, 2, 3));
  EXPECT_EQ(study.initial[0].rotation_rate, Vec3(0, 0, 3.8));
  EXPECT_EQ(study.initial[0].centre, Vec3(0, 0, 1));
}

TEST(ReadStudy, ReadsEveryKeyOfTheRun) {
  const Study study = read_text(full_study);
  EXPECT_EQ(study.modes.count, 12);
  EXPECT_TRUE(study.modes.number_given);
  EXPECT_EQ(std::get<std::vector<double>>(study.modes.damping), (std::vector{0.01, 0.02}));
  EXPECT_EQ(study.modes.distributed, true);
  ASSERT_TRUE(study.transient);
  EXPECT_EQ(study.transient->duration, 2.0);
  EXPECT_EQ(study.transient->scheme, Scheme::splitting);
  EXPECT_EQ(study.transient->accuracy, 0.02);
  EXPECT_EQ(study.transient->step, 1e-5);
  EXPECT_EQ(study.output.every, 1e-4);
  EXPECT_EQ(study.output.nodes, (std::vector<std::string>{"apex", "foot"}));
  EXPECT_EQ(study.output.statistics_from, 0.2);
  EXPECT_EQ(study.output.impacts, 500);
  EXPECT_EQ(study.output.rest_time, 1e-3);
  EXPECT_EQ(study.output.checkpoint, 30.0);
}

TEST(ReadStudy, ReadsDampingByFrequency) {
  const Study study =
      read_text("[mesh]\nfile = \"a.msh\"\n[modes]\ndamping = { table = [[0, 0.02], [50.5, 0.01]] }\n");
  const auto& rows = std::get<modal::DampingTable>(study.modes.damping).rows;
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].frequency, 0.0);
  EXPECT_EQ(rows[0].ratio, 0.02);
  EXPECT_EQ(rows[1].frequency, 50.5);
  EXPECT_EQ(rows[1].ratio, 0.01);
}

TEST(ReadStudy, ReadsRayleighDampingAndABandOfModes) {
  const Study study = read_text(
      "[mesh]\nfile = \"a.msh\"\n[modes]\nup_to_hz = 800\ndamping = { stiffness = 1e-5, mass = 0.5 }\n");
  EXPECT_FALSE(study.modes.count);
  EXPECT_EQ(study.modes.up_to_hz, 800.0);
  EXPECT_EQ(std::get<modal::Rayleigh>(study.modes.damping).stiffness, 1e-5);
  EXPECT_EQ(std::get<modal::Rayleigh>(study.modes.damping).mass, 0.5);
}

TEST(ReadStudy, KnowsEveryObstacleAndScheme) {
  const std::pair<const char*, ObstacleKind> obstacles[] = {{"circle", ObstacleKind::circle},
                                                            {"plane_y", ObstacleKind::plane_y},
                                                            {"plane_z", ObstacleKind::plane_z},
                                                            {"stop_y", ObstacleKind::stop_y},
                                                            {"stop_z", ObstacleKind::stop_z}};
  for (const auto& [name, kind] : obstacles)
    EXPECT_EQ(read_text(full_study, {std::string("contacts.tsp1.obstacle=") + name}).contacts[0].obstacle,
              kind);
  const std::pair<const char*, Scheme> schemes[] = {{"auto", Scheme::automatic},
                                                    {"splitting", Scheme::splitting},
                                                    {"euler", Scheme::euler},
                                                    {"energy_conserving", Scheme::energy_conserving}};
  for (const auto& [name, scheme] : schemes)
    EXPECT_EQ(read_text(full_study, {std::string("transient.scheme=") + name}).transient->scheme, scheme);
}

TEST(ReadStudy, KeepsTheTextAndTheOverrides) {
  const Study study = read_text("[mesh]\nfile = \"a.msh\"", {"mesh.scale=2"});
  EXPECT_EQ(study.text, "[mesh]\nfile = \"a.msh\"\n# --set mesh.scale=2\n");
  EXPECT_EQ(study.overrides, std::vector<std::string>{"mesh.scale=2"});
  EXPECT_TRUE(study.file.is_absolute());
}

TEST(ReadStudy, KeepsAnAbsolutePathOfTheMesh) {
  EXPECT_EQ(read_text("[mesh]\nfile = \"/some/where/a.msh\"\n").mesh.file, "/some/where/a.msh");
}

TEST(ReadStudy, TakesTheExampleOfTheReference) {
  std::ifstream stream(test_paths::source_dir() / "doc" / "study-file.md");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string opening = "```toml\n";
  const auto begin = text.find(opening);
  ASSERT_NE(begin, std::string::npos);
  const auto from = begin + opening.size();
  EXPECT_EQ(message_of(text.substr(from, text.find("```", from) - from)), "");
}

TEST(ReadStudy, RefusesAFileThatIsNotThere) {
  const Folder folder;
  for (const auto& [file, problem] :
       {std::pair{folder.path() / "none.toml", "does not exist"}, std::pair{folder.path(), "is a directory"}})
    try {
      (void)read(file);
      FAIL() << file;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace fretwork::study::read_test
