// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::override_test {
namespace {

TEST(Override, AddressesAContactByItsName) {
  EXPECT_EQ(gap_of(read_text(full_study, {"contacts.tsp2.gap=3e-4"}).contacts[1]), 3e-4);
}

TEST(Override, AddressesAnEntryByItsGroup) {
  EXPECT_EQ(read_text(full_study, {"masses.apex.mass=2"}).masses[0].mass, 2.0);
}

TEST(Override, AddressesAnEntryByItsIndex) {
  EXPECT_EQ(read_text(full_study, {"loads.2.random.rms=9"}).loads[2].function,
            signals::TimeFunction(signals::Random{9, 5, 200, 7}));
}

TEST(Override, AddressesATableOfATable) {
  EXPECT_EQ(read_text(full_study, {"materials.inconel.density=8000"}).materials.at("inconel").density,
            8000.0);
}

TEST(Override, AddressesAnItemOfAnArray) {
  EXPECT_EQ(read_text(full_study, {"contacts.tsp1.offset.1=4e-5"}).contacts[0].offset,
            (std::array{1e-5, 4e-5}));
}

TEST(Override, TakesQuotesRoundANameWithDots) {
  const std::string text =
      contact("") + "[[contacts]]\nname = \"a.b\"\ngroup = \"q\"\ngap = 0\nnormal_stiffness = 1\n";
  EXPECT_EQ(gap_of(read_text(text, {"contacts.\"a.b\".gap=5"}).contacts[1]), 5.0);
}

TEST(Override, AddsAKeyToATable) {
  EXPECT_EQ(read_text(contact(""), {"contacts.c.angle=30"}).contacts[0].angle, 30.0);
}

TEST(Override, MakesATableThatTheStudyLeftOut) {
  const Study study =
      read_text(contact(""), {"transient.duration=1", "transient.scheme=euler", "modes.count=3",
                              "output.every=0.1", "gravity.acceleration=[0,0,-1]"});
  EXPECT_EQ(study.transient->duration, 1.0);
  EXPECT_EQ(study.transient->scheme, Scheme::euler);
  EXPECT_EQ(study.modes.count, 3);
  EXPECT_EQ(study.output.every, 0.1);
  EXPECT_EQ(study.gravity, Vec3(0, 0, -1));
}

TEST(Override, TakesBareWordsQuotedStringsAndTables) {
  EXPECT_EQ(read_text(contact(""), {"title=two words"}).title, "two words");
  EXPECT_EQ(read_text(contact(""), {"title=\"x\""}).title, "x");
  EXPECT_EQ(read_text(contact(""), {"mesh.file=../b.msh"}).mesh.file.filename(), "b.msh");
  const Study study =
      read_text(contact("tangential_stiffness = 1"), {"contacts.c.friction={static=0.4,dynamic=0.3}"});
  EXPECT_EQ(study.contacts[0].friction_dynamic, 0.3);
}

TEST(Override, TakesTheLastOfTwoOfTheSameKey) {
  EXPECT_EQ(read_text(full_study, {"mesh.scale=2", " mesh.scale = 3"}).mesh.scale, 3.0);
}

struct Case {
  const char* text;
  std::vector<std::string> expected;
};

TEST(Override, SaysWhatIsWrong) {
  const std::vector<Case> cases{
      {"contacts.tsp9.gap=1",
       {"contacts has no entry \"tsp9\"; did you mean \"tsp1\"? existing: \"tsp1\", \"tsp2\"",
        "indices 0 to 1"}},
      {"contacts.tsp1[0].gap=1",
       {"contacts has no entry \"tsp1[0]\"", "\"tsp1\" has one value for all nodes of its group"}},
      {"contacts.7.gap=1", {"contacts has no entry \"7\"", "\"tsp1\", \"tsp2\"", "indices 0 to 1"}},
      {"contacts.-1.gap=1", {"contacts has no entry \"-1\""}},
      {"materials.inconl.density=1",
       {"materials has no \"inconl\"; did you mean \"inconel\"? existing: \"inconel\""}},
      {"contcts.tsp1.gap=1",
       {"the study has no \"contcts\"; did you mean \"contacts\"? existing: \"base_motion\""}},
      {"mesh.scale.x=1", {"mesh.scale is a number, nothing is inside it"}},
      {"contacts.tsp1.gapp=1",
       {"contacts.tsp1.gapp = 1: unknown key; did you mean \"gap\"? keys: \"name\", \"group\""}},
      {"transiet=1", {"transiet = 1: unknown key; did you mean \"transient\"?"}},
      {"contacts.tsp1.gap=-1",
       {"contacts.tsp1.gap = -1: a number >= 0 in m is expected; an overlap is made by origin or offset"}},
      {"contacts.tsp1.gap=wide",
       {"contacts.tsp1.gap = \"wide\": a number >= 0 in m is expected, not a string"}},
      {"contacts.0=1", {"contacts = 1: a table is expected for each entry"}},
      {"title", {"no = in it; write --set key=value"}},
      {"title=", {"no value after ="}},
      {"=1", {"a part of the address is empty"}},
      {"mesh..scale=1", {"a part of the address is empty"}},
      {"\"mesh.scale=1", {"a double quote is not closed"}},
      {"mesh.scale=[1, 2", {"not valid TOML"}},
      {"title=a\nb", {"a line break is not allowed"}}};
  for (const Case& c : cases) {
    const std::string message = message_of(full_study, {c.text});
    EXPECT_TRUE(message.starts_with(std::string("--set ") + c.text + ": ")) << message;
    for (const auto& part : c.expected)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  }
}

TEST(Override, ListsTheIndicesOfAnAmbiguousGroup) {
  const std::string load = "[[loads]]\ngroup = \"p\"\ndirection = [1, 0, 0]\nconstant = 1\n";
  EXPECT_NE(message_of(contact(load + load), {"loads.p.constant=5"})
                .find("loads has several entries with group \"p\"; address one by its index: 0, 1"),
            std::string::npos);
}

TEST(Override, IsWhatAMessageNamesInsteadOfALine) {
  EXPECT_TRUE(
      message_of(full_study, {"transient.duration=0.1"})
          .ends_with(
              "output.statistics_from = 0.2: the statistics must start before the end, transient.duration"));
  EXPECT_TRUE(message_of(full_study, {"loads.apex.harmonic.frequency=0"})
                  .starts_with("--set loads.apex.harmonic.frequency=0: loads.apex.harmonic.frequency = 0:"));
}

} // namespace
} // namespace fretwork::study::override_test
