// SPDX-License-Identifier: GPL-3.0-or-later
// What a run says of the motions that a study gives, and of studies in which nothing moves or the modes cannot follow.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::motion_facts_test {
namespace {

void write_tube(const Workshop& folder) {
  MeshText mesh = straight_line("tube", {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 10);
  mesh.points.emplace_back("middle", 5);
  folder.write("mesh.msh", mesh.text());
}

std::string study(const std::string& more, const std::string& end = "\"all\"") {
  return steel_pipe("mesh.msh") + tube_between("tube", "\"all\"", end) + more +
         "[modes]\ncount = 10\ndamping = 0.02\n[transient]\nduration = 0.5\n[output]\nnodes = [\"middle\"]\n";
}

std::string hole(const std::string& more) {
  return "[[contacts]]\nname = \"hole\"\ngroup = \"middle\"\nnormal_stiffness = 1.0e5\n" + more;
}

/// 101 rows of a sin(w t), 5 ms apart.
std::string record(double amplitude, double w, double offset) {
  std::string table = "table = [";
  for (int k = 0; k <= 100; ++k)
    table += fmt::format("[{:.17g}, {:.17g}],", 0.005 * k, offset + amplitude * std::sin(w * 0.005 * k));
  return table + "]\n";
}

std::string warnings_of(const Results& run) { return run.summary["warnings"].dump(); }
std::string notes_of(const Results& run) { return run.summary["notes"].dump(); }

} // namespace

TEST(MotionFacts, AreThoseOfTheRecordWithinTheRun) {
  const Workshop folder;
  write_tube(folder);
  const double w = 20.0 * std::numbers::pi; // 5 whole periods; largest at 25 ms and 50 ms further on
  const std::string base = "[[base_motion]]\ndirection = [0.0, 1.0, 0.0]\n" + record(3.0, w, 0.0);
  const Results run = folder.run_text(study(base));
  const auto& facts = run.summary["motions"].at(0);
  EXPECT_EQ(facts["name"], "[[base_motion]] along (0, 1, 0)");
  EXPECT_TRUE(close_to(facts["largest_acceleration_m_s2"], 3.0, 1e-9));
  // from rest the base drifts with 3/w m/s
  EXPECT_TRUE(close_to(facts["largest_displacement_m"], 3.0 / w * 0.5, 0.02));
  EXPECT_EQ(facts["rows"], 101);
  EXPECT_EQ(facts["record_s"], nlohmann::json({0.0, 0.5}));
  EXPECT_EQ(notes_of(run).find("ends before the record"), std::string::npos);
  const Results half = folder.run_text(study(base), {"--force", "--set", "transient.duration=0.2"});
  EXPECT_TRUE(says(notes_of(half), "the run of 0.2 s ends before the record, which goes on to 0.5 s"));
}

TEST(MotionFacts, SayThatALoadOnACurveActsAtEachOfItsNodes) {
  const Workshop folder;
  write_tube(folder);
  const auto notes = [&](const std::string& keys) {
    return notes_of(folder.run_text(
        study("[[loads]]\nname = \"wind\"\ndirection = [0.0, 1.0, 0.0]\nconstant = 1.0\n" + keys),
        {"--force"}));
  };
  EXPECT_TRUE(says(notes("group = \"tube\"\n"), "load \\\"wind\\\" acts in full at each of the 11 nodes of "
                                                "the curve \\\"tube\\\", 11 times its value"));
  EXPECT_FALSE(says(notes("group = \"tube\"\nper_length = true\n"), "acts in full"));
  EXPECT_FALSE(says(notes("group = \"middle\"\n"), "acts in full"));
}

TEST(MotionFacts, OfAHarmonicMotionAreItsAmplitudeHoweverManyItsPeriods) {
  const Workshop folder;
  write_tube(folder);
  for (const char* frequency : {"100.0", "1000.0"}) { // whole numbers of periods between 20 000 instants
    const Results run =
        folder.run_text(study(std::string("[[base_motion]]\ndirection = [0.0, 1.0, 0.0]\nvelocity0 = 0.0\n"
                                          "harmonic = { amplitude = 5.0, frequency = ") +
                              frequency + " }\n"),
                        {"--force", "--set", "transient.duration=10.0"});
    EXPECT_TRUE(close_to(run.summary["motions"].at(0)["largest_acceleration_m_s2"], 5.0, 1e-12)) << frequency;
  }
}

TEST(MotionFacts, OfABaseThatLeavesItsObstaclesAreAWarning) {
  const Workshop folder;
  write_tube(folder);
  const std::string base = "[[base_motion]]\ndirection = [0.0, 1.0, 0.0]\n" + record(3.0, 62.8, 20.0);
  EXPECT_TRUE(says(warnings_of(folder.run_text(study(base + hole("gap = 5.0\nattached_to = \"ground\"\n")))),
                   "drifts; correct it"));
  EXPECT_EQ(warnings_of(folder.run_text(study(base + hole("gap = 5.0\n")), {"--force"})).find("drifts"),
            std::string::npos)
      << "obstacles move along";
}

// 3 sin(w t) from rest drifts with 3/w m/s on the average; from -3/w m/s it stays about its place, though it moves at its end.
TEST(MotionFacts, OfRecordsWhoseBaselineDriftsHaveNumbers) {
  const Workshop folder;
  write_tube(folder);
  const double w = 20.0 * std::numbers::pi;
  const std::string base = "[[base_motion]]\ndirection = [0.0, 1.0, 0.0]\n",
                    support = "[[support_motion]]\ngroup = \"tube_end\"\ndirection = [0.0, 1.0, 0.0]\n";
  const Results still = folder.run_text(study(base + record(3.0, w, 0.0)));
  EXPECT_TRUE(says(notes_of(still), "[[base_motion]] along (0, 1, 0): its record moves by 0.0"));
  EXPECT_TRUE(says(notes_of(still), " m from where it starts"));
  EXPECT_TRUE(
      says(notes_of(still), "its baseline drifts, of no effect on results, which are relative to the base"));
  const auto warned = [&](const std::string& motion) {
    return warnings_of(folder.run_text(study(motion), {"--force"}));
  };
  const std::string offset = warned(support + record(0.0, w, 1.0)); // v = t: 0.4375 m/s, and 0.125 m away
  EXPECT_TRUE(says(
      offset,
      "its record moves by 0.438 m/s on the average of its last quarter (largest velocity 0.5 m/s) and ends "
      "0.125 m from where it starts (largest 0.125 m): its baseline drifts; correct the record"))
      << offset;
  const std::string start = fmt::format("velocity0 = {:.17g}\n", -3.0 / w);
  EXPECT_EQ(warned(support + start + record(3.0, w, 0.0)).find("drifts"), std::string::npos);
  const std::string by = "quantity = \"displacement\"\n";
  EXPECT_EQ(warned(support + by + record(1e-3, w, 0.0)).find("drifts"), std::string::npos);
  std::string away = "table = [", ramp = away; // to and fro about a baseline that goes away; a settlement
  for (int k = 0; k <= 100; ++k) {
    away += fmt::format("[{:.17g}, {:.17g}],", 0.005 * k, 2e-5 * k + 1e-3 * std::sin(w * 0.005 * k));
    ramp += fmt::format("[{:.17g}, {:.17g}],", 0.005 * k, 2e-5 * k);
  }
  EXPECT_TRUE(says(warned(support + by + away + "]\n"), "and ends 0.002 m from where it starts"));
  EXPECT_EQ(warned(support + by + ramp + "]\n").find("drifts"), std::string::npos);
}

TEST(MotionFacts, SayWhereTheModesDoNotFollow) {
  const Workshop folder;
  write_tube(folder);
  const auto said = [&](const char* direction) {
    return warnings_of(folder.run_text(
        study(fmt::format(
            "[[base_motion]]\ndirection = {}\nharmonic = {{ amplitude = 1.0, frequency = 5.0 }}\n",
            direction)),
        {"--force"}));
  };
  EXPECT_TRUE(says(said("[0.0, 0.0, 1.0]"), "of the static deflection under [[base_motion]]"));
  EXPECT_EQ(said("[0.0, 1.0, 0.0]").find("[[base_motion]]"), std::string::npos);
}

TEST(Motion, OfNothingIsAWarningAndThatReachesNoObstacleANote) {
  const Workshop folder;
  write_tube(folder);
  EXPECT_TRUE(
      says(warnings_of(folder.run_text(study(hole("gap = 1.0e-3\n")))), "nothing moves: no load, motion"));
  const std::string push = "[[initial]]\ngroup = \"middle\"\nvelocity = [0.0, 1.0e-3, 0.0]\n";
  const Results run = folder.run_text(study(push + hole("gap = 1.0e-3\n")), {"--force"});
  EXPECT_EQ(warnings_of(run).find("nothing moves"), std::string::npos);
  EXPECT_TRUE(says(notes_of(run), "no contact closes"));
}

TEST(Motion, OfAFreeStructureIsANote) {
  const Workshop folder;
  write_tube(folder);
  const std::string push = "[[initial]]\ngroup = \"middle\"\nvelocity = [0.0, 1.0e-3, 0.0]\n";
  const std::string sliding = "[\"ux\", \"uz\", \"rx\", \"ry\", \"rz\"]"; // both ends slide along y
  std::string text = steel_pipe("mesh.msh") + tube_between("tube", sliding, sliding) + push +
                     hole("gap = 1.0e-3\n") + "[modes]\ncount = 10\n[transient]\nduration = 0.1\n";
  EXPECT_TRUE(says(notes_of(folder.run_text(text)), "the structure has 1 rigid-body mode (0 Hz)"));
  EXPECT_EQ(notes_of(folder.run_text(study(push), {"--force"})).find("rigid-body"), std::string::npos);
}

TEST(Contacts, AcrossTheirBeamAreAWarning) {
  const Workshop folder;
  write_tube(folder);
  const std::string push = "[[initial]]\ngroup = \"middle\"\nvelocity = [0.0, 1.0e-3, 0.0]\n";
  const auto said = [&](const std::string& keys) {
    return warnings_of(folder.run_text(study(push + hole(keys)), {"--force"}));
  };
  EXPECT_TRUE(says(said("gap = 1.0e-3\naxis = [1.0, 0.0, 0.0]\n"),
                   "its axis is 90 degrees off the beam at its node"));
  EXPECT_EQ(said("gap = 1.0e-3\naxis = [0.0, 0.2, 1.0]\n").find("degrees off"), std::string::npos);
  EXPECT_EQ(said("obstacle = \"stop_y\"\ngap = 1.0e-3\naxis = [1.0, 0.0, 0.0]\n").find("degrees off"),
            std::string::npos)
      << "a stop at the end of a beam";
}

} // namespace fretwork::app::test::motion_facts_test
