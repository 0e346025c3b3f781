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

} // namespace
} // namespace fretwork::app::test::supports_test
