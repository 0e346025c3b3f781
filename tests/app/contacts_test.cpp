// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts from the keys of the study to the results: laws found by the program, supports with a thickness,
// structures that meet.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test {
namespace {

constexpr double rounding = 1e-12;  ///< relative
constexpr double symmetric = 1e-9;  ///< relative: two edges whose shapes come from an eigensolver
constexpr double one_impact = 1e-2; ///< relative: speeds are those of steps, some hundred an impact

const std::string materials = steel_pipe("mesh.msh") + R"([sections.rod]
shape = "circle"
diameter = 0.01
)";

/// Tubes of 1 m and a little more, side by side every 25 mm along y, clamped at both ends; their middles are
/// mid0, mid1 ...
std::string tubes(const Workshop& folder, int count, const std::string& section = "tube") {
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

/// Tubes a and b meet after 1 mm.
std::string meeting(int a, int b) {
  return fmt::format("[[contacts]]\nname = \"meet{0}{1}\"\ngroup = \"mid{0}\"\nother = \"mid{1}\"\n"
                     "axis = [1.0, 0.0, 0.0]\ndistance_1 = {2}\ndistance_2 = 0.012\n"
                     "normal_stiffness = 1.0e6\nnormal_damping = 10.0\n",
                     a, b, 0.012 + 0.025 * (b - a - 1));
}

std::string support(const std::string& keys) {
  return "[[contacts]]\nname = \"plate\"\ngroup = \"mid0\"\naxis = [1.0, 0.0, 0.0]\n" + keys;
}

const results::ContactFacts& facts(const Results& run, const std::string& name) {
  for (const auto& contact : run.archive.contacts)
    if (contact.name == name)
      return contact;
  throw std::runtime_error("no contact " + name);
}

/// The message of a study that is refused.
std::string refused(const Workshop& folder, const std::string& study) {
  const Outcome outcome = folder.fretwork({"run", folder.write("study.toml", study).string(), "-o",
                                           folder.path("results").string(), "--no-report"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  return outcome.err;
}

/// The middle of a tube in the archive.
core::Index middle_of(const Results& run, int tube) {
  const core::Vec3 place(0.5 + 0.05 * tube, 0.025 * tube, 0.0);
  for (std::size_t n = 0; n < run.archive.nodes.size(); ++n)
    if ((run.archive.nodes[n] - place).norm() < 1e-9) // m: the mesh has it at that place
      return static_cast<core::Index>(n);
  throw std::runtime_error("no such node");
}

/// Every observed middle moves as the modes of its own structure say, at their place among all modes.
void expect_modal_series(const Results& run) {
  for (const auto& name : run.archive.node_names) {
    const core::Index node = middle_of(run, name.back() - '0');
    const auto& bases = run.archive.bases;
    Eigen::Index first = 0;
    std::size_t s = 0;
    for (; bases.at(s).row_of(node) < 0; ++s)
      first += bases[s].size();
    const Eigen::MatrixXd moved = (bases[s].shapes.middleRows<3>(bases[s].row_of(node)) *
                                   run.archive.series.modal_displacement.middleRows(first, bases[s].size()))
                                      .transpose();
    const auto& series = run.node(name).displacement;
    const double largest = series.cwiseAbs().maxCoeff();
    EXPECT_GT(largest, 0.0) << name;
    EXPECT_LT((moved - series).cwiseAbs().maxCoeff(), rounding * largest) << name;
  }
}

TEST(Structures, ThatMeetKeepTheirPlacesInTheModalSeries) {
  const Workshop folder; // tubes 0 and 2 run together, 1 and 3 alone
  const Results run =
      folder.run_text(tubes(folder, 4) + meeting(0, 2) + push(0, 200.0) + push(1, 30.0) + push(3, -50.0));
  EXPECT_GT(run.statistics("meet02")["impacts"].get<int>(), 0);
  expect_modal_series(run);
}

TEST(Structures, LeaveOutTheModesThatNothingMoves) {
  // the loads are at the middles, where every second mode has a node: 4 of 8 modes of a tube
  const Workshop folder;
  const Results run = folder.run_text(tubes(folder, 2) + meeting(0, 1) + push(0, 200.0));
  EXPECT_GT(run.statistics("meet01")["impacts"].get<int>(), 0);
  const Eigen::MatrixXd& q = run.archive.series.modal_displacement;
  ASSERT_EQ(q.rows(), 16);
  EXPECT_EQ((q.rowwise().squaredNorm().array() > 0.0).count(), 8);
  EXPECT_EQ(run.archive.series.modal_velocity.rows(), 16);
  expect_modal_series(run);
  EXPECT_TRUE(
      says(run.summary["notes"].dump(), "8 of 16 modes are moved by no load, contact or initial state"));
}

TEST(Structures, InAChainPassTheForceOnAndGiveTheSameOnAllRanks) {
  const Workshop folder;
  const std::string study = tubes(folder, 4) + meeting(0, 1) + meeting(1, 2) + push(0, 600.0) + push(3, 20.0);
  const Results run = folder.run_text(study);
  for (const char* name : {"meet01", "meet12"})
    EXPECT_GT(run.statistics(name)["impacts"].get<int>(), 0) << name;
  expect_modal_series(run);
  for (const int ranks : {2, 3}) {
    const Results many = folder.run(folder.path("study.toml"), fmt::format("ranks{}", ranks), {}, ranks);
    EXPECT_TRUE(same_numbers(many.archive, run.archive)) << ranks;
  }
}

TEST(Structures, MeetASecondNodeThatIsFixed) {
  const Workshop folder;
  std::string study = tubes(folder, 2) + meeting(0, 1) + push(0, 200.0) +
                      "[[restraints]]\ngroup = \"tube1\"\nfixed = \"all\"\n";
  const auto at = study.find(", \"mid1\"");
  study.erase(at, 8);
  const Results run = folder.run_text(study);
  EXPECT_EQ(run.archive.bases.size(), 1u);
  EXPECT_GT(run.statistics("meet01")["impacts"].get<int>(), 0);
}

TEST(Structures, WrongPairsAreRefused) {
  const Workshop folder;
  const std::string study = tubes(folder, 2);
  const std::string sizes = "distance_1 = 0.01\ndistance_2 = 0.01\naxis = [1.0, 0.0, 0.0]\n"
                            "normal_stiffness = 1.0e6\n";
  const auto pair = [&](const std::string& group, const std::string& other, const std::string& more = "") {
    return refused(folder, study + "[[contacts]]\nname = \"c\"\ngroup = \"" + group + "\"\nother = \"" +
                               other + "\"\n" + sizes + more);
  };
  EXPECT_TRUE(says(pair("mid0", "tube1"), "group \"mid0\" has 1 nodes and other \"tube1\" has 9"));
  EXPECT_TRUE(
      says(pair("mid0", "mid0"), "share a node, which cannot be joined to itself; name two different nodes"));
  EXPECT_TRUE(says(pair("mid0", "mid9"), "mid9"));
  // across z the two tubes lie at the same place
  EXPECT_TRUE(
      says(pair("mid0", "mid1", "obstacle = \"plane_z\"\n"),
           "contact \"c\": its two nodes are at the same place across the planes, so that neither has a "
           "side; give side = 1 or -1"));
}

/// Two masses at places that each move along y only.
std::string two_masses(const Workshop& folder, const core::Vec3& first, const core::Vec3& second) {
  MeshText mesh = lone_points({"first", "second"});
  mesh.nodes = {first, second};
  mesh.points.insert(mesh.points.end(), {{"both", 0}, {"both", 1}});
  folder.write("mesh.msh", mesh.text());
  std::string study = "[mesh]\nfile = \"mesh.msh\"\n[transient]\nduration = 0.01\n";
  for (const char* name : {"first", "second"})
    study += fmt::format("[[masses]]\ngroup = \"{0}\"\nmass = 1.0\n[[springs]]\ngroup = \"{0}\"\n"
                         "stiffness = [0.0, 100.0, 0.0, 0.0, 0.0, 0.0]\n[[restraints]]\ngroup = \"{0}\"\n"
                         "fixed = [\"ux\", \"uz\", \"rx\", \"ry\", \"rz\"]\n",
                         name);
  return study;
}

std::string flat(const std::string& keys) {
  return "[[contacts]]\nname = \"c\"\ngroup = \"first\"\nother = \"second\"\nobstacle = \"plane_y\"\n"
         "distance_1 = 0.01\ndistance_2 = 0.0\nnormal_stiffness = 1.0e6\n" +
         keys;
}

const std::string along_x = "axis = [1.0, 0.0, 0.0]\n";
const std::string no_side = "contact \"c\": its two nodes are at the same place across the planes, so that "
                            "neither has a side; give side = 1 or -1";

TEST(Sides, ThatOnlyRoundOffTellsApartAreRefused) {
  const Workshop folder;
  // one ulp apart across the planes; then along an axis that is written with ten digits
  EXPECT_TRUE(says(
      refused(folder, two_masses(folder, {0.0, 0.3, 0.0}, {0.5, 0.1 + 0.2, 0.0}) + flat(along_x)), no_side));
  const double c = std::sqrt(1.0 / 3.0);
  EXPECT_TRUE(says(refused(folder, two_masses(folder, {c, c, c}, {2.0 * c, 2.0 * c, 2.0 * c}) +
                                       flat("axis = [0.5773502692, 0.5773502692, 0.5773502691]\n")),
                   no_side));
  // of coincident nodes; an offset moves the surfaces, not the nodes
  EXPECT_TRUE(says(refused(folder, two_masses(folder, {0.0, 0.3, 0.0}, {0.0, 0.3, 0.0}) +
                                       flat(along_x + "offset = [0.05, 0.0]\n")),
                   no_side));
}

TEST(Sides, AreThoseOfTheNodesWhateverTheOffset) {
  const Workshop folder;
  for (const double side : {1.0, -1.0})
    for (const double offset : {0.0, 0.02, -0.02}) {
      const Results run =
          folder.run_text(two_masses(folder, {0.0, 0.3 + side * 0.015, 0.0}, {0.0, 0.3, 0.0}) +
                          flat(along_x + fmt::format("offset = [{}, 0.0]\n", offset)));
      constexpr double of_places = 1e-9; // m: digits of the mesh file
      EXPECT_NEAR(facts(run, "c").gap, side * (side * 0.015 - offset) - 0.01, of_places);
    }
}

TEST(Sides, ThatContradictThePlacesAreTold) {
  const Workshop folder;
  const auto warned = [&](const std::string& keys, double second) {
    const Results run =
        folder.run_text(two_masses(folder, {0.0, 0.3, 0.0}, {0.0, second, 0.0}) + flat(along_x + keys));
    const std::string check = folder.fretwork({"check", folder.path("study.toml").string()}).out;
    const bool told = run.summary["warnings"].dump().find("passed through each other") != std::string::npos;
    EXPECT_EQ(check.find("passed through each other") != std::string::npos, told);
    return told;
  };
  EXPECT_TRUE(warned("side = 1\n", 0.32));
  EXPECT_TRUE(warned("side = -1\n", 0.28));
  EXPECT_FALSE(warned("side = -1\n", 0.32));
  EXPECT_FALSE(warned("side = 1\n", 0.1 + 0.2)); // round-off contradicts nothing
  EXPECT_FALSE(warned("side = -1\n", 0.1 + 0.2));
}

TEST(Names, OfTwoPointsThatAreTheSameAreRefused) {
  const Workshop folder;
  const std::string study = two_masses(folder, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  const auto named = [](const std::string& name, const std::string& group) {
    return fmt::format("[[contacts]]\nname = \"{}\"\ngroup = \"{}\"\naxis = [1.0, 0.0, 0.0]\n"
                       "gap = 1.0e-3\nnormal_stiffness = 1.0e6\n",
                       name, group);
  };
  EXPECT_TRUE(says(refused(folder, study + named("c", "both") + named("c[0]", "first")),
                   "contacts \"c\" and \"c[0]\" both have a point called \"c[0]\"; rename one of them"));
  EXPECT_TRUE(says(
      refused(folder, tubes(folder, 1) + named("p@2", "mid0") + named("p", "mid0") + "thickness = 0.02\n"),
      "contacts \"p@2\" and \"p\" both have a point called \"p@2\"; rename one of them"));
}

TEST(Structures, MeetWhicheverOfTwoNodesIsFixed) {
  const Workshop folder;
  const auto fixed = [](const std::string& name) {
    return "[[restraints]]\ngroup = \"" + name + "\"\nfixed = [\"uy\"]\n";
  };
  const std::string flying = "[[initial]]\ngroup = \"{}\"\nvelocity = [0.0, {}, 0.0]\n";
  const auto thrown = [&](const std::string& held, const std::string& moves, double speed) {
    std::string study = two_masses(folder, {0.0, 0.0105, 0.0}, {0.0, 0.0, 0.0}) + flat(along_x) + fixed(held);
    return folder.run_text(study + fmt::format(fmt::runtime(flying), moves, speed));
  };
  const Results first = thrown("second", "first", -0.2), second = thrown("first", "second", 0.2);
  const auto& force = first.contact("c").normal_force;
  EXPECT_GT(force.maxCoeff(), 0.0);
  EXPECT_LT((second.contact("c").normal_force - force).cwiseAbs().maxCoeff(), rounding * force.maxCoeff());
  EXPECT_TRUE(says(refused(folder, two_masses(folder, {0.0, 0.02, 0.0}, {0.0, 0.0, 0.0}) + flat(along_x) +
                                       fixed("first") + fixed("second")),
                   "contact \"c\" joins two nodes that cannot move; release one in [[restraints]] or give it "
                   "a mass"));
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

TEST(Notes, AreOneLineAContactOfTheStudyOverlapsFirst) {
  const Workshop folder;
  const std::string plate = "gap = 0.0\noffset = [0.0, -2.0e-4]\nthickness = 0.03\nthickness_points = 3\n"
                            "normal_stiffness = \"wall\"\nrestitution = 0.7\nrestitution_mass = 2.0\n"
                            "friction = 0.3\ntangential_stiffness = 1.0e6\n";
  const Results run = folder.run_text(tubes(folder, 1) + support(plate));
  const auto notes = notes_with(run, "contact \"plate");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], run.summary["notes"][0]);
  EXPECT_TRUE(says(notes[0], "contact \"plate\": 3 of 3 points start with an overlap, the deepest \"plate@"));
  EXPECT_TRUE(says(notes[0], "with 0.0002 m: it presses with "));
  EXPECT_TRUE(
      says(notes[1], "contact \"plate\": stiffness of the tube's wall 5.669e+06 N/m, normal damping "));
  EXPECT_TRUE(
      says(notes[1], " N s/m for restitution 0.7 with a mass of 2 kg, automatic tangential damping "));
  EXPECT_TRUE(says(notes[1], "(of the whole support: each point has 0.3333 of it)"));
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

TEST(Names, OfTwoObservedNodesThatAreTheSameAreRefused) {
  const Workshop folder;
  std::string study = two_masses(folder, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  MeshText mesh = lone_points({"first", "second"});
  mesh.points.insert(mesh.points.end(), {{"both", 0}, {"both", 1}, {"both[0]", 1}});
  folder.write("mesh.msh", mesh.text());
  study += "[output]\nnodes = [\"both\", \"both[0]\"]\n";
  EXPECT_TRUE(says(refused(folder, study),
                   "[output] nodes: groups \"both\" and \"both[0]\" both have a node called \"both[0]\"; "
                   "leave one of them out, or rename it in the mesh"));
}

TEST(Origin, BetweenTwoNodesIsToldToMoveNothing) {
  const Workshop folder;
  const auto run_with = [&](const std::string& keys) {
    return folder.run_text(two_masses(folder, {0.0, 0.3, 0.0}, {0.0, 0.32, 0.0}) + flat(along_x + keys));
  };
  const Results with = run_with("origin = [0.0, 5.0, 0.0]\n"), without = run_with("");
  EXPECT_EQ(facts(with, "c").gap, facts(without, "c").gap);
  EXPECT_TRUE(says(with.summary["warnings"].dump(), "origin moves nothing between two nodes"));
  EXPECT_EQ(without.summary["warnings"].dump().find("origin"), std::string::npos);
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
} // namespace fretwork::app::test
