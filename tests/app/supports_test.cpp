// SPDX-License-Identifier: GPL-3.0-or-later
// Supports of one group, named one by one.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app::test::supports_test {
namespace {

using nlohmann::json;

/// A tube of 1 m in water with two bars, one of which is also alone in a group.
class Supports : public ::testing::Test {
protected:
  Supports() {
    MeshText mesh = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
    mesh.points.insert(mesh.points.end(), {{"first", 14}, {"bars", 14}, {"bars", 26}});
    folder_.write("mesh.msh", mesh.text());
  }

  [[nodiscard]] Outcome outcome(const std::string& bars, const std::string& more,
                                const std::string& command = "stability") const {
    folder_.write("study.toml", steel_pipe("mesh.msh") + R"(
[[beams]]
group = "tube"
material = "steel"
section = "tube"
[[restraints]]
group = "tube"
fixed = ["ux", "rx"]
[[restraints]]
group = "tube_begin"
fixed = ["uy", "uz"]
[[restraints]]
group = "tube_end"
fixed = ["uy", "uz"]
[modes]
count = 2
[[flow]]
group = "tube"
from = "tube_begin"
[[flow.zones]]
density = 740.0
viscosity = 1.23e-7
velocity = 1.5
connors_constant = 3.0
)" + "[[contacts]]\nnormal_stiffness = 1e6\ngap = 1e-3\ngroup = " +
                                    bars + more);
    std::vector<std::string> arguments{command, folder_.path("study.toml").string()};
    if (command != "check")
      arguments.insert(arguments.end(), {"-o", folder_.path("out").string(), "--force"});
    return folder_.fretwork(arguments);
  }

  [[nodiscard]] json summary(const std::string& bars, const std::string& more,
                             const std::string& command = "stability") const {
    const Outcome found = outcome(bars, more, command);
    EXPECT_EQ(found.status, 0) << found.err;
    return json::parse(bytes_of(folder_.path("out") / "summary.json"));
  }

  Workshop folder_;
};

TEST_F(Supports, ArePinnedOneByOne) {
  const json alone = summary("\"first\"\n", ""),
             named = summary("\"bars\"\n",
                             "[[stability]]\npinned = [\"bars[0]\"]\n"
                             "[[stability]]\nname = \"both\"\npinned = [\"bars[0]\", \"bars[1]\"]\n");
  EXPECT_EQ(named["stability"][0]["modes"], alone["stability"][0]["modes"]);
  EXPECT_EQ(named["stability"][0]["pinned"], json({"bars[0]"}));
  EXPECT_EQ(named["stability"][1]["pinned"], json({"bars"}));
}

TEST_F(Supports, AreInactiveOneByOne) {
  const json alone = summary("\"first\"\n", ""),
             one = summary("\"bars\"\ninactive = [\"bars[1]\"]\n",
                           "[[stability]]\n[transient]\nduration = 1e-3\n"
                           "[[wear]]\ncontacts = \"bars[1]\"\ncoefficient = 1e-14\nlength = 0.01\n",
                           "run");
  EXPECT_EQ(one["stability"][0]["modes"], alone["stability"][0]["modes"]);
  EXPECT_EQ(one["stability"][0]["pinned"], json({"bars[0]"}));
  ASSERT_EQ(one["contacts"].size(), 1u) << "nor is the other in the transient";
  EXPECT_EQ(one["contacts"][0]["name"], "bars[0]");
}

TEST_F(Supports, AreSaidWhereTheyAre) {
  const std::string places =
      "supports of groups are numbered along them: \"bars[0]\" at s = 0.35 m to \"bars[1]\" at s = 0.65 m";
  EXPECT_TRUE(says(outcome("\"bars\"\n", "", "check").out, places));
  const json notes = summary("\"bars\"\n", "", "modes")["notes"];
  EXPECT_NE(std::find(notes.begin(), notes.end(), places), notes.end()) << notes;
  EXPECT_FALSE(says(outcome("\"first\"\n", "", "check").out, "numbered"));
}

TEST_F(Supports, ThatAGroupDoesNotHaveAreRefused) {
  const char* there_are = "contact \"bars\" has 2 supports, \"bars[0]\" to \"bars[1]\"";
  EXPECT_TRUE(says(outcome("\"bars\"\n", "[[stability]]\npinned = [\"bars[2]\"]\n").err, there_are));
  EXPECT_TRUE(says(outcome("\"bars\"\ninactive = [\"bars[2]\"]\n", "").err, there_are));
}

// The bars are 0.3 m apart.
TEST_F(Supports, AskWhetherAThicknessThatReachesTheNextOneIsMeant) {
  const auto said = [&](const std::string& bars, const std::string& more) {
    const Outcome found = outcome(bars, more, "check");
    EXPECT_EQ(found.status, 0) << found.err;
    return found.out;
  };
  const std::string group = "\"bars\"\n",
                    alone = "[[contacts]]\nnormal_stiffness = 1e6\ngap = 1e-3\ngroup = \"first\"\n";
  EXPECT_TRUE(says(said(group + "thickness = 0.32\n", ""),
                   "warning: contact \"bars[0]\": a thickness of 0.32 m reaches \"bars[1]\", which is 0.3 m "
                   "away along the tube and "
                   "0.32 m thick; thickness is the length of one support"));
  EXPECT_FALSE(says(said(group + "thickness = 0.29\n", ""), "reaches"));
  EXPECT_TRUE(says(said(group, alone + "thickness = 0.61\n"),
                   "warning: contact \"first\": a thickness of 0.61 m reaches \"bars[1]\", which is 0.3 m "
                   "away along the tube;"));
  EXPECT_FALSE(says(said(group, alone + "thickness = 0.1\n"),
                    "reaches")); // two at one node may be two sides of a support
}

TEST_F(Supports, AskAboutStiffTangentialSprings) {
  const auto said = [&](double tangential, const char* friction) {
    return outcome("\"bars\"\n",
                   fmt::format("tangential_stiffness = {}\nfriction = {}\n", tangential, friction), "check")
        .out;
  };
  EXPECT_TRUE(
      says(said(2e7, "0.3"),
           "warning: contact \"bars\": its tangential stiffness of 2e+07 N/m is 20 times the normal one, "
           "1e+06 N/m, and of elastic bodies 0.7 to 1 times it: are they exchanged?"));
  EXPECT_FALSE(says(said(1e7, "0.3"), "exchanged"));
  EXPECT_FALSE(says(said(2e7, "0"), "exchanged")); // nothing tangential is computed
}

TEST_F(Supports, NoteOutputsThatAreFew) {
  const auto said = [&](double every) {
    return outcome("\"bars\"\n", fmt::format("[transient]\nduration = 0.01\n[output]\nevery = {}\n", every),
                   "check")
        .out;
  };
  EXPECT_TRUE(says(said(0.004), "note: output.every = 0.004 s keeps 2 outputs of a run of 0.01 s: orbits, "
                                "spectra and pictures need some "
                                "thousand, as the default, 2e-06 s, keeps"));
  EXPECT_FALSE(says(said(0.0005), "keeps"));
}

} // namespace
} // namespace fretwork::app::test::supports_test
