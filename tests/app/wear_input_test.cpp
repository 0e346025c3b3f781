// SPDX-License-Identifier: GPL-3.0-or-later
// [[wear]] that does not fit its study: refused before the run, with the cure.
#include "mesh_text.hpp"
#include "program.hpp"
#include "results/checksum.hpp"
#include "study_text.hpp"
#include <fstream>
#include <sys/stat.h>

namespace fretwork::app::test::wear_input_test {
namespace {

const std::string short_run = "[transient]\nduration = 0.3\n";
const std::string archard = "coefficient = 2.0e-14\nlength = 0.02\n";

/// Tubes that rattle in holes, and [[wear]].
std::string worn_bundle(const Workshop& folder, int tubes, const std::string& wear) {
  return bundle(folder, tubes, short_run) + "[[wear]]\n" + wear;
}

/// What `fretwork check` answers to a wrong study.
std::string refused_by_check(const Workshop& folder, const std::string& study) {
  const Outcome outcome = folder.fretwork({"check", folder.write("study.toml", study).string()});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  return outcome.err;
}

} // namespace

TEST(WearInput, IsCountedByCheck) {
  const Workshop folder;
  const Outcome outcome =
      folder.fretwork({"check", folder.write("study.toml", worn_bundle(folder, 2, archard)).string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "2 supports that wear"));
}

TEST(WearInput, IsRefusedBeforeTheRunWithTheCure) {
  const Workshop folder;
  struct Wrong {
    std::string wear;
    std::vector<std::string> said;
  };
  const std::string k = "coefficient = 1e-14\n";
  const std::vector<Wrong> cases{
      {archard + "contacts = \"suport0\"\n",
       {"wear.0: no contact fits \"suport0\"; did you mean \"support0\"?"}},
      {archard + "contacts = \"support0\"\n[[wear]]\n" + archard + "contacts = \"sup*\"\n",
       {"wear.0 and wear.1: both name the contact \"support0\"; name it in one of them"}},
      {k,
       {"wear.0, contact \"support0\": the contact has no thickness that gives the length; give length (m)"}},
      {archard + "geometry = \"tube_on_tube\"\n", {"contact \"support0\": ", "crossing"}},
      {archard + "limit = 1\nwall = 0.02\n", {"contact \"support0\": ", "beyond the"}},
      {"materials = \"690_405\"\nlength = 0.02\n",
       {"contact \"support0\": wear coefficients: the class \"drilled_hole\" has no pair", "690_405"}},
      {"materials = \"690_405\"\ncoefficient_class = \"flat\"\nlength = 0.02\n",
       {"there is no geometry class \"flat\""}},
      {archard + "initial_wear = { \"+y\" = 0.1 }\n",
       {"contact \"support0\": initial_wear.+y: there is one scar and no side \"+y\"; give a number"}},
      {archard + "geometry = \"lands\"\nhalf_angle = 100\n", {"contact \"support0\": "}}};
  for (const Wrong& wrong : cases) {
    const std::string message = refused_by_check(folder, worn_bundle(folder, 1, wrong.wear));
    for (const std::string& part : wrong.said)
      EXPECT_TRUE(says(message, part)) << wrong.wear;
  }
}

TEST(WearInput, IsRefusedForContactsWithoutASizeOrGeometry) {
  const Workshop folder;
  const std::string study = bundle(folder, 1, short_run);
  const std::string profile =
      "[[contacts]]\nname = \"hole\"\ngroup = \"drive0\"\naxis = [1, 0, 0]\nobstacle = "
      "\"profile\"\nprofile = [[0, 1e-3], [120, 1e-3], [240, 1e-3]]\n"
      "normal_stiffness = 1e6\n";
  EXPECT_TRUE(says(refused_by_check(folder, study + profile + "[[wear]]\n" + archard),
                   "contact \"hole\": a profile of 3 points has no geometry of wear of its own"));
  EXPECT_TRUE(says(refused_by_check(folder, study + profile + "[[wear]]\n" + archard +
                                                "contacts = \"hole\"\ngeometry = \"drilled_hole\"\n"),
                   "the obstacle is no circle whose gap gives the clearance; give clearance (m)"));
  const std::string turned =
      "[[contacts]]\nname = \"turned\"\ngroup = \"drive0\"\naxis = [1, 0, 0]\nangle = 30\ngap = "
      "1e-3\nnormal_stiffness = 1e6\n";
  EXPECT_TRUE(says(
      refused_by_check(folder, study + turned + "[[wear]]\nname = \"both\"\none_support = true\n" + archard),
      "have different local axes, in which the angles of one support are counted"));
  std::string solid = study;
  solid.replace(solid.find("shape = \"pipe\"\nouter_diameter = 0.01905\nthickness = 0.00109"), 60,
                "shape = \"circle\"\ndiameter = 0.01905\n");
  EXPECT_TRUE(says(refused_by_check(folder, solid + "[[wear]]\n" + archard),
                   "no pipe at its node gives the wall; give wall (m)"));
}

TEST(WearInput, IsRefusedWhereTheOtherRunLacksTheContactOrDiverged) {
  const Workshop folder;
  fs::create_directories(folder.path("other"));
  const std::string study =
      worn_bundle(folder, 1, archard + "states = [{ share = 1, results = \"other\" }]\n");
  const auto refused_with = [&](const std::string& summary) {
    std::ofstream(folder.path("other") / "summary.json") << summary;
    return refused_by_check(folder, study);
  };
  const auto with_summary = [&](const nlohmann::ordered_json& keys) {
    nlohmann::ordered_json summary = keys;
    summary["sha256"] = results::no_checksum();
    return refused_with(results::with_checksum(summary.dump(2)));
  };
  EXPECT_TRUE(
      says(refused_with("{}"), "is not as it was written (its checksum does not fit); run that study again"));
  const auto parsed = [](const char* text) { return nlohmann::ordered_json::parse(text); };
  EXPECT_TRUE(says(with_summary(parsed("{}")), "holds no results of a transient; run that study again"));
  EXPECT_TRUE(says(with_summary(parsed(R"({"transient": {"outcome": "diverged"}, "contacts": []})")),
                   "diverged; take a smaller step there"));
  EXPECT_TRUE(says(with_summary(parsed(R"({"transient": {"outcome": "done"}, "contacts": [
    {"name": "tsp1", "work_rate": 1.0, "standard_error": {"work_rate": null}}]})")),
                   "has no contact \"support0\""));
  // a checksum that fits does not make a content
  EXPECT_TRUE(says(with_summary(parsed(R"({"transient": 1, "contacts": [1]})")), "diverged"));
  EXPECT_TRUE(says(with_summary(parsed(R"({"transient": {"outcome": "done"}, "contacts": 1})")),
                   "holds no results of a transient"));
  EXPECT_TRUE(
      says(with_summary(parsed(R"({"transient": {"outcome": "done"}, "contacts": [1, {}, {"name": 1}]})")),
           "has no contact \"support0\""));
  fs::remove(folder.path("other") / "summary.json");
  ASSERT_EQ(mkfifo((folder.path("other") / "summary.json").c_str(), 0600), 0);
  EXPECT_TRUE(says(refused_by_check(folder, study), "summary.json is no regular file"));
}

} // namespace fretwork::app::test::wear_input_test
