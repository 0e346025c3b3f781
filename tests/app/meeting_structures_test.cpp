// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts between two nodes, of one structure or of two: what they are refused for, the sides they keep, and runs of several structures as one.
#include "mesh_text.hpp"
#include "study_text.hpp"
#include "tubes.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::meeting_structures_test {
namespace {

constexpr double rounding = 1e-12; ///< relative

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

/// The contact of `study` again, with its nodes exchanged, under the name "again".
std::string exchanged(std::string contact, const std::string& name, const std::string& group,
                      const std::string& other) {
  const auto put = [&](const std::string& what, const std::string& by) {
    contact.replace(contact.find(what), what.size(), by);
  };
  put("name = \"" + name + "\"\n", "name = \"again\"\n");
  put("group = \"" + group + "\"\nother = \"" + other + "\"\n",
      "group = \"" + other + "\"\nother = \"" + group + "\"\n");
  return contact;
}

// The same pair again from its other node shares force and wear, like a contact that is there twice.
TEST(Warnings, NameAPairThatIsThereFromBothSides) {
  const Workshop folder;
  const auto warnings = [&](const std::string& study) {
    return folder.run_text(study).summary["warnings"].dump();
  };
  const std::string warning = " join the same two nodes with the same obstacle, group and other exchanged";
  const auto round = [&](const std::string& keys) {
    return warnings(tubes(folder, 2) + meeting(0, 1) + exchanged(meeting(0, 1), "meet01", "mid0", "mid1") +
                    keys);
  };
  EXPECT_TRUE(says(round(""), "contacts \\\"meet01\\\" and \\\"again\\\"" + warning));
  EXPECT_TRUE(says(round("angle = 30.0\n"), warning)) << "round bodies have no side";
  EXPECT_FALSE(says(round("offset = [0.0, 1.0e-5]\n"), warning)) << "bodies beside each other";
  const auto planes = [&](const std::string& first, const std::string& keys) {
    return warnings(two_masses(folder, {0.0, 0.315, 0.0}, {0.0, 0.3, 0.0}) + flat(along_x + first) +
                    exchanged(flat(along_x + keys), "c", "first", "second"));
  };
  EXPECT_TRUE(says(planes("", ""), warning));
  EXPECT_TRUE(says(planes("offset = [1.0e-3, 0.0]\n", "offset = [-1.0e-3, 0.0]\n"), warning));
  EXPECT_FALSE(says(planes("offset = [1.0e-3, 0.0]\n", "offset = [1.0e-3, 0.0]\n"), warning));
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

TEST(Structures, MeetAtTheGapThatTheyHaveWhereTheyAreDrawn) {
  const Workshop folder;
  const std::string study = tubes(folder, 2) + push(0, 200.0), contact = meeting(0, 1);
  const auto with_sizes = [&](const std::string& sizes) {
    std::string text = contact;
    const std::size_t from = text.find("distance_1"), to = text.find("normal_stiffness");
    return study + text.replace(from, to - from, sizes);
  };
  const Results run = folder.run_text(study + contact);
  const double gap = facts(run, "meet01").gap;
  EXPECT_GT(gap, 0.0);
  EXPECT_GT(run.statistics("meet01")["impacts"].get<int>(), 0);
  const Results same = folder.run_text(with_sizes(fmt::format("gap = {:.17g}\n", gap)), {"--force"});
  EXPECT_TRUE(close_to(facts(same, "meet01").gap, gap, 1e-9));
  EXPECT_TRUE(close_to(same.statistics("meet01")["normal_force"]["max"],
                       run.statistics("meet01")["normal_force"]["max"].get<double>(), 1e-6));
  const Results flat = folder.run_text(
      with_sizes(fmt::format("obstacle = \"plane_y\"\ngap = {:.17g}\noffset = [1.0e-5, 0.0]\n", gap)),
      {"--force"});
  EXPECT_TRUE(close_to(facts(flat, "meet01").gap, gap, 1e-9)) << "offset included";
  folder.write("wide.toml", with_sizes("gap = 0.5\n"));
  EXPECT_TRUE(says(folder.fretwork({"run", folder.path("wide.toml").string()}).err,
                   "nothing is left for the bodies"));
}

} // namespace
} // namespace fretwork::app::test::meeting_structures_test
