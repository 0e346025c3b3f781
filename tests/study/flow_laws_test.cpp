// SPDX-License-Identifier: GPL-3.0-or-later
// [flow_laws.NAME] as values, and every message about them.
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::flow_laws_test {
namespace {

/// A flow with the law "bundle". @param law  the lines of its table
std::string study_with(const std::string& law, const std::string& name = "bundle") {
  return "[mesh]\nfile = \"a.msh\"\n[flow_laws." + name + "]\n" + law +
         "[[flow]]\ngroup = \"tube\"\nfrom = \"foot\"\nlaw = \"bundle\"\n"
         "[[flow.zones]]\nname = \"water\"\ndensity = 740\nviscosity = 1.23e-7\n";
}
const std::string rational = "law = \"rational\"\nstiffness = -4\ndamping = -0.4\n";
const std::string unsteady =
    "law = \"quasi_unsteady\"\ndrag = 0.2\ngradients = -15.5\nmemory = [[1.25, 0.05], [-0.12, 0.3]]\n";

flow::FluidelasticLaw law_of(const std::string& text) { return read_text(text).flows.at(0).law.value(); }

} // namespace

TEST(FlowLawKeys, ANumberIsThatOfLiftAlone) {
  const flow::FluidelasticLaw law = law_of(study_with(rational));
  EXPECT_EQ(law.stiffness, Eigen::Matrix2d({{0.0, 0.0}, {0.0, -4.0}}));
  EXPECT_EQ(law.damping, Eigen::Matrix2d({{0.0, 0.0}, {0.0, -0.4}}));
  EXPECT_TRUE(law.lags.empty());
  EXPECT_FALSE(law.range.has_value());
}

TEST(FlowLawKeys, MatricesAreInTheOrderDragLift) {
  const flow::FluidelasticLaw law =
      law_of(study_with("law = \"rational\"\nstiffness = [[1, 2], [3, 4]]\ndamping = 0\nlags = [0.4, 2]\n"
                        "lag_forces = [5, [[6, 7], [8, 9]]]\nrange = [1, 3]\n"));
  EXPECT_EQ(law.stiffness, Eigen::Matrix2d({{1.0, 2.0}, {3.0, 4.0}}));
  ASSERT_EQ(law.lags.size(), 2u);
  EXPECT_EQ(law.lags[0].rate, 0.4);
  EXPECT_EQ(law.lags[0].force.real(), Eigen::Matrix2d({{0.0, 0.0}, {0.0, 5.0}}));
  EXPECT_EQ(law.lags[1].rate, 2.0);
  EXPECT_EQ(law.lags[1].force.real(), Eigen::Matrix2d({{6.0, 7.0}, {8.0, 9.0}}));
  EXPECT_EQ(law.range, (std::array<double, 2>{1.0, 3.0}));
}

TEST(FlowLawKeys, QuasiUnsteadyForcesAreTheSteadyOnesWithMemory) {
  const flow::FluidelasticLaw law = law_of(study_with(unsteady + "lift = 0.1\n"));
  EXPECT_EQ(law.stiffness, Eigen::Matrix2d({{0.0, 0.0}, {0.0, -15.5}}));
  EXPECT_EQ(law.damping, Eigen::Matrix2d({{-0.4, 0.1}, {-0.2, -0.2}}));
  ASSERT_EQ(law.lags.size(), 2u);
  EXPECT_EQ(law.lags[0].rate, 0.05);
  EXPECT_EQ(law.lags[0].force(1, 1).real(), 1.25 * 15.5);
  EXPECT_FALSE(law.steady.has_value());
}

TEST(FlowLawKeys, TheForceAtRestIsThatOfDragAndLift) {
  const flow::FluidelasticLaw law = law_of(study_with(unsteady + "lift = 0.1\nsteady = true\n"));
  EXPECT_EQ(law.steady, (std::array<double, 2>{0.2, 0.1}));
}

const std::string of_two =
    "law = \"rational\"\nstiffness = [[0, 0, 0, 0], [0, -4, 0, 3], [0, 0, 0, 0], [0, -3, 0, -4]]\n"
    "damping = -0.4\nlags = [0.4]\nlag_forces = [[[1, 2], [3, 4]]]\n";
const std::string second = "[[flow]]\ngroup = \"other\"\nfrom = \"foot\"\nlaw = \"bundle\"\n"
                           "[[flow.zones]]\nname = \"water\"\ndensity = 740\nviscosity = 1.23e-7\n";

TEST(FlowLawKeys, SmallMatricesOfALawOfSeveralTubesAreThoseOfEach) {
  const flow::FluidelasticLaw law = law_of(study_with(of_two) + second);
  ASSERT_EQ(law.tubes(), 2);
  EXPECT_EQ(law.stiffness(1, 3), 3.0);
  EXPECT_EQ(law.stiffness(3, 1), -3.0);
  EXPECT_EQ(law.damping, Eigen::MatrixXd(Eigen::Vector4d(0.0, -0.4, 0.0, -0.4).asDiagonal()));
  EXPECT_EQ(law.lags.at(0).force.real(),
            Eigen::Matrix4d({{1, 2, 0, 0}, {3, 4, 0, 0}, {0, 0, 1, 2}, {0, 0, 3, 4}}));
  const flow::FluidelasticLaw quasi =
      law_of(study_with("law = \"quasi_steady\"\ndrag = 0.2\nlift = 0.1\n"
                        "gradients = [[0, 0, 0, 0], [0, 1, 0, 2], [0, 0, 0, 0], [0, 3, 0, 4]]\n") +
             second);
  EXPECT_EQ(quasi.stiffness(3, 1), 3.0);
  EXPECT_EQ(quasi.damping.bottomRightCorner(2, 2), Eigen::Matrix2d({{-0.4, 0.1}, {-0.2, -0.2}}));
  EXPECT_TRUE(quasi.damping.topRightCorner(2, 2).isZero(0.0));
}

TEST(FlowLawKeys, StabilityDiagramsHaveFactorsPointsAndModes) {
  const Study study = read_text(study_with(rational) +
                                "[[stability]]\n[[stability]]\nfactors = [0.5, 3]\npoints = 51\nmodes = 4\n"
                                "elastic = true\nsticking = true\n");
  EXPECT_EQ(study.stabilities.at(0).factors, (std::array<double, 2>{0.0, 2.0}));
  EXPECT_EQ(study.stabilities[0].points, 101);
  EXPECT_EQ(study.stabilities[0].modes, 10);
  EXPECT_EQ(study.stabilities.at(1).factors, (std::array<double, 2>{0.5, 3.0}));
  EXPECT_EQ(study.stabilities[1].points, 51);
  EXPECT_EQ(study.stabilities[1].modes, 4);
  EXPECT_TRUE(study.stabilities[1].elastic && study.stabilities[1].sticking);
  const std::pair<std::string, std::string> wrong[] = {
      {"factors = [2, 1]", "[first, last] factor of all velocities"},
      {"factors = [-1, 1]", "stability.0.factors[0] = -1: a number >= 0"},
      {"points = 1", "stability.0.points = 1: an integer >= 2"},
      {"points = 20000", "stability.0.points = 20000: at most 10000"},
      {"modes = 0", "stability.0.modes = 0: an integer >= 1"}};
  for (const auto& [keys, message] : wrong)
    EXPECT_NE(message_of(study_with(rational) + "[[stability]]\n" + keys + "\n").find(message),
              std::string::npos)
        << message;
}

TEST(FlowLawKeys, TablesAndConnors) {
  const std::string rows =
      "law = \"table\"\ntable = [[2, -1, 0.1], [3, -1.5, 0.2], [4, -2, 0.4], [6, -2, 0.9]]\n";
  const flow::FluidelasticLaw table = law_of(study_with(rows));
  EXPECT_EQ(table.lags.size(), 2u);
  EXPECT_EQ(table.range, (std::array<double, 2>{2.0, 6.0}));
  EXPECT_EQ(law_of(study_with(rows + "fit = 1\n")).lags.size(), 1u);
  EXPECT_EQ(law_of(study_with(rows + "range = [1, 9]\n")).range, (std::array<double, 2>{1.0, 9.0}));
  const flow::FluidelasticLaw connors = law_of(study_with("law = \"connors\"\nconstant = 3.0\n"));
  EXPECT_NEAR(connors.stiffness(0, 1), 2.792526803, 1e-9); // 8 pi/9
  EXPECT_EQ(connors.stiffness(1, 0), -connors.stiffness(0, 1));
  EXPECT_FALSE(connors.frozen.has_value());
  const flow::FluidelasticLaw frozen = law_of(study_with(rows + "fit = 0\n"));
  ASSERT_TRUE(frozen.frozen.has_value());
  EXPECT_EQ(frozen.frozen->damping.at(5.0), 0.65);
  EXPECT_EQ(frozen.frozen->stiffness.at(1.0), -1.0) << "constant beyond the rows";
  const flow::FluidelasticLaw damping =
      law_of(study_with("law = \"connors\"\nconstant = 2\nform = \"damping\"\n"));
  ASSERT_TRUE(damping.frozen.has_value());
  EXPECT_EQ(damping.frozen->connors, 1.0);
}

TEST(FlowLawMessages, NameTheKeyAndTheCure) {
  const std::string at = "flow_laws.bundle.";
  const std::pair<std::string, std::string> cases[] = {
      {study_with("stiffness = 1\n"), at + "law: this required key is missing"},
      {study_with("law = \"steady\"\n"), at + "law = \"steady\": unknown; available"},
      {study_with(rational + "memory = [[1, 2]]\n"), at + "memory = "},
      {study_with("law = \"rational\"\ndamping = 0\n"),
       at + "stiffness: this required key is missing; give a number (lift alone) or [[a, b], [c, d]]"},
      {study_with("law = \"rational\"\ndamping = 0\nstiffness = [[1, 2]]\n"),
       at + "stiffness: 1 rows; give a number"},
      {study_with("law = \"rational\"\ndamping = 0\nstiffness = [[1], [2]]\n"), at + "stiffness"},
      {study_with(rational + "lags = [0.4]\n"), "lags and lag_forces belong together; give both, or neither"},
      {study_with(rational + "lags = [0.4, 1]\nlag_forces = [1]\n"),
       "one for each of the 2 lags is expected"},
      {study_with(rational + "lags = [-0.4]\nlag_forces = [1]\n"), at + "lags"},
      {study_with(rational + "range = [3, 1]\n"),
       "[least, largest] reduced velocity is expected, in this order"},
      {study_with("law = \"quasi_unsteady\"\ndrag = -1\ngradients = 1\nmemory = [[1, 1]]\n"),
       at + "drag = -1"},
      {study_with("law = \"quasi_unsteady\"\ndrag = 1\ngradients = 1\nmemory = [[1, 0]]\n"),
       "does not decay; give rates above 0"},
      {study_with("law = \"quasi_steady\"\ndrag = 1\ngradients = 1\ndelay = -1\n"), at + "delay = -1"},
      {study_with("law = \"table\"\ntable = [[1, 1, 1], [2, 1, 1]]\n"),
       "2 rows do not determine 2 lags; give more rows, or a smaller fit"},
      {study_with("law = \"table\"\ntable = [[1, 1, 1], [1, 2, 2], [3, 1, 1]]\n"), "has two rows; give one"},
      {study_with("law = \"table\"\ntable = [[0, 1, 1]]\n"), "give reduced velocities above 0"},
      {study_with("law = \"table\"\ntable = [[1, 1]]\n"), at + "table"},
      {study_with("law = \"table\"\nfit = 4\ntable = [[1, 1, 1]]\n"), "at most 3 lags are fitted"},
      {study_with("law = \"connors\"\nconstant = 3\nform = \"frozen\"\n"),
       at + "form = \"frozen\": unknown; available: "},
      {study_with("law = \"connors\"\nconstant = 0\n"), at + "constant = 0"},
      {study_with(of_two),
       "law \"bundle\" is of 2 tubes and has 1 [[flow]]; give one for each tube, in the order of the rows"},
      {study_with("law = \"rational\"\ndamping = 0\nstiffness = [[1, 2, 3], [4, 5, 6], [7, 8, 9]]\n"),
       at + "stiffness: 3 rows; give a number"},
      {study_with(of_two + "range = [1, 2]\n")
           .replace(study_with(of_two + "range = [1, 2]\n").find("damping = -0.4"), 14,
                    "damping = [[1,0,0,0,0,0],[0,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,"
                    "0,0,0,1]]"),
       at + "stiffness: 4 rows, another matrix of the law has 6; give as many, or two for each tube"},
      {study_with(rational, "array"), "law = \"bundle\""}};
  for (const auto& [text, expected] : cases) {
    const std::string message = message_of(text);
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\nlacks: " << expected;
  }
}

} // namespace fretwork::study::flow_laws_test
