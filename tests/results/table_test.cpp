// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/figures.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <regex>
#include <sstream>

namespace fretwork::results::table_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::size_t widest = 112; // columns a person's terminal shows without wrapping, roughly
constexpr std::size_t longest =
    45; // lines that fit a screen, five of them the contacts whose modes lack flexibility

/// A wrapped text as one line.
std::string unwrapped(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);)
    out.push_back(line);
  return out;
}

TEST(Figures, OfSentencesHaveNoExponent) {
  EXPECT_EQ(without_exponent(62'345.0, 2), "62 000");
  EXPECT_EQ(without_exponent(99.7, 2), "100");
  EXPECT_EQ(without_exponent(99.2, 2), "99");
  EXPECT_EQ(without_exponent(4.71, 2), "4.7");
  EXPECT_EQ(without_exponent(0.0, 3), "0");
  EXPECT_EQ(without_exponent(0.01234, 3), "0.0123");
  EXPECT_EQ(without_exponent(999.6, 3), "1 000");
  EXPECT_EQ(without_exponent(47'123.0, 3), "47 100");
  EXPECT_EQ(without_exponent(3e9, 3), "3 000 000 000");
}

TEST(TerminalTable, FitsAScreen) {
  RunResults results = made_up({.contacts = 60, .structures = 20, .modes = 40});
  results.warnings.assign(1, std::string(30, 'w') + " " + std::string(70, 'x') + " " + std::string(60, 'y'));
  for (int i = 0; i < 30; ++i)
    results.warnings.push_back("warning number " + std::to_string(i));
  results.notes = results.warnings;
  for (ContactFacts& contact : results.contacts)
    contact.static_flexibility = {3.0 / contact.normal_stiffness, 2.0 / contact.normal_stiffness,
                                  1.0 / contact.normal_stiffness};
  const auto table = lines(terminal_table(results, "folder.results"));
  EXPECT_LE(table.size(), longest);
  for (const std::string& line : table)
    EXPECT_LE(line.size(), widest) << line;
}

TEST(TerminalTable, GivesFiguresTheirStandardErrors) {
  RunResults results = made_up({.contacts = 1});
  post::ContactSummary& c = results.contact_summaries[0];
  const auto shows = [&](double value, double error, const char* text) {
    c.work_rate = value;
    c.error.work_rate = error;
    EXPECT_THAT(terminal_table(results), HasSubstr(" " + std::string(text) + " "));
  };
  shows(6.1283, 0.0512, "6.13+-0.05");   // one digit
  shows(6.1283, 0.0148, "6.128+-0.015"); // two where the first is 1
  shows(1234.56, 37.0, "1235+-37");      // never fewer than the digits before the point
  shows(0.0, 0.0, "0");
  shows(6.1283, std::numeric_limits<double>::quiet_NaN(), "6.13");
  shows(1.23e-6, 4.0e-8, "1.23e-06+-4e-08");
  shows(16.5452681, 3e-8, "16.5+-3e-08");
  shows(16.5452681, 3e-12, "16.5"); // round-off of what stands still
}

TEST(TerminalTable, ShowsRoundOffAsZero) {
  RunResults results = made_up({.contacts = 1});
  post::ContactSummary& c = results.contact_summaries[0];
  c.work_rate = 1.3e-41;
  c.error.work_rate = 1e-41;
  c.tangential_max = 2.5e-37;
  const std::string text = terminal_table(results);
  EXPECT_THAT(text, HasSubstr("over 1000 % standard error"));
  EXPECT_THAT(text, Not(HasSubstr("e-41")));
  EXPECT_THAT(text, Not(HasSubstr("e-37")));
  c.normal_max = 2803.0;
  c.tangential_max = 1.3e-13; // of directions, without friction
  for (auto& transient : results.transients)
    transient.report.energy.contact_damping = -4.3e-16; // of sums, without dampers
  const std::string undamped = terminal_table(results);
  EXPECT_THAT(undamped, Not(HasSubstr("e-13")));
  EXPECT_THAT(undamped, HasSubstr(" 2803 ")) << "no 2.8e+03";
  EXPECT_THAT(unwrapped(undamped), HasSubstr("contact damping 0 + friction"));
}

TEST(TerminalTable, BreaksNoNumber) {
  const std::string number = grouped(50666123);
  for (std::size_t before = 60; before < 100; ++before) {
    RunResults results = made_up();
    results.warnings = {std::string(before, 'w') + " " + number + " steps"};
    EXPECT_THAT(terminal_table(results), HasSubstr(number)) << before;
  }
  EXPECT_THAT(wrapped("a 1 234.5 b", 4), testing::ElementsAre("a 1", "234.5", "b")) << "two numbers";
}

TEST(TerminalTable, SaysOneNode) {
  RunResults results = made_up();
  results.model.nodes = 1;
  results.model.elements = 0;
  EXPECT_THAT(terminal_table(results), HasSubstr("1 node, 0 beams, "));
}

TEST(TerminalTable, ShowsNormalPositionAndSlidingOfFlatObstaclesApart) {
  RunResults results = made_up({.contacts = 1});
  results.contacts[0].obstacle = "bars_z";
  results.contacts[0].gap = 1e-4;
  results.contacts[0].rest = {0.0, 5e-3, 2e-5};
  post::ContactSummary& c = results.contact_summaries[0];
  c.y = {0.0, 1e-4, -3e-4, 4e-4};
  c.z = {0.0, 3e-5, -1.25e-4, 0.75e-4};
  c.radial_max = 5.4e-3; // of no use: nothing is round here
  c.penetration_max = 5e-6;
  const std::string text = terminal_table(results);
  EXPECT_THAT(text, testing::ContainsRegex("tsp1 +100 +-105 to 95 +30 +700\n"));
  EXPECT_THAT(text, testing::ContainsRegex(" flat +5 "));
  results.contacts[0].sides = {{1, "+z"}, {3, "-z"}}; // two bars, the node 20 um above their middle
  EXPECT_THAT(terminal_table(results), testing::ContainsRegex("tsp1 +120 and 80 +-105 to 95 +30 +700\n"));
  results.contacts[0].rest.z() = 1.4e-4; // beyond the upper bar
  EXPECT_THAT(terminal_table(results), testing::ContainsRegex("tsp1 +240 and -40 "));
  results.contacts[0].rest.z() = 5e-8;
  EXPECT_THAT(terminal_table(results), testing::ContainsRegex("tsp1 +100 "));
  EXPECT_THAT(text, Not(HasSubstr("5400")));
  results.contacts[0].obstacle = "circle";
  EXPECT_THAT(terminal_table(results), testing::ContainsRegex(" 5400 +5 "));
}

TEST(TerminalTable, ShowsWhatAVerificationFound) {
  RunResults results = made_up({.contacts = 1});
  EXPECT_THAT(terminal_table(results), HasSubstr("standard error of this window"));
  Verification v;
  v.step_max = 1e-5;
  v.factor = 2.77;
  v.contacts = {{{"work_rate", 1.0, 1.0, 0.1, true}}};
  v.sums = {{"work_rate", 2.0, 4.0, 0.5, false}};
  results.verification = v;
  const std::string text = terminal_table(results);
  EXPECT_THAT(text, HasSubstr("at half the step (1e-05 s): 1 of 2 figures agree within 2.8 standard"));
  EXPECT_THAT(text, testing::ContainsRegex("work_rate +2 +4 +-2 +0.5  differs"));
  results.verification->failure = "the run at half the step stopped";
  EXPECT_THAT(terminal_table(results), HasSubstr("verified    no: the run at half the step stopped"));
}

TEST(TerminalTable, ShowsEachOfAFewContactsWithoutATotalOfOne) {
  const std::string one = terminal_table(made_up({.contacts = 1}));
  EXPECT_THAT(one, HasSubstr("  tsp1 "));
  EXPECT_THAT(one, Not(HasSubstr("all contacts")));
  const std::string many = terminal_table(made_up({.contacts = 12}));
  EXPECT_THAT(many, HasSubstr("  tsp12 "));
  EXPECT_THAT(many, HasSubstr("all contacts"));
}

TEST(TerminalTable, ShowsTheTenContactsThatWearMostOfMany) {
  RunResults results = made_up({.contacts = 13});
  for (int c = 0; c < 13; ++c)
    results.contact_summaries[static_cast<std::size_t>(c)].work_rate = c;
  const auto table = lines(terminal_table(results));
  const auto row = [&](const std::string& name) {
    return std::find_if(table.begin(), table.end(),
                        [&](const auto& l) { return l.starts_with("  " + name + " "); });
  };
  EXPECT_LT(row("tsp13"), row("tsp12"));
  EXPECT_LT(row("tsp5"), row("tsp4"));
  EXPECT_NE(row("tsp4"), table.end());
  EXPECT_EQ(row("tsp3"), table.end());
  const std::string text = terminal_table(results);
  EXPECT_THAT(text, HasSubstr("the 10 of 13 contacts with the largest work rate"));
  EXPECT_THAT(text, HasSubstr("78")); // the total work rate, 0 + 1 + ... + 12
}

TEST(TerminalTable, ShowsTheContactsWhoseModesLackFlexibility) {
  RunResults results = made_up({.contacts = 6});
  EXPECT_THAT(terminal_table(results), Not(HasSubstr("static flexibility")));
  for (std::size_t c = 0; c < 6; ++c) {
    ContactFacts& contact = results.contacts[c];
    contact.normal_stiffness = 1e6;
    const double missing =
        c == 0 ? 0.9e-9 : 2e-9 * static_cast<double>(c); // the first: less than a thousandth
    contact.static_flexibility = {1e-6, 1e-6 - missing, missing};
  }
  const auto table = lines(terminal_table(results));
  const auto head = std::find_if(table.begin(), table.end(), [](const std::string& line) {
    return line.find("static flexibility") != std::string::npos;
  });
  ASSERT_LT(head + 4, table.end());
  EXPECT_THAT(*head, HasSubstr("static flexibility, worst 3 of 5 "));
  EXPECT_THAT(*(head + 1), HasSubstr("1e-06      9.9e-07        1e-08         0.01")) << "the worst first";
  EXPECT_THAT(*(head + 3), HasSubstr("0.006"));
  EXPECT_EQ(*(head + 4), "");
}

TEST(ModesTable, HasALineAModeAndTheirSum) {
  const RunResults results = made_up({.structures = 2, .modes = 10});
  const auto table = lines(modes_table(results));
  ASSERT_EQ(table.size(), 22u); // heads, modes, sum
  EXPECT_THAT(table[0], HasSubstr("effective mass, % of 10, 10, 10 kg"));
  EXPECT_THAT(table[1], HasSubstr("40.000")); // 4 of 10 kg, in y
  EXPECT_THAT(table[21], HasSubstr("all modes together"));
  for (const std::string& line : table)
    EXPECT_LE(line.size(), widest) << line;
  const auto many = lines(modes_table(made_up({.structures = 2, .modes = 40})));
  EXPECT_EQ(many.size(), 63u);
  EXPECT_THAT(many[61], HasSubstr("20 more in summary.json"));
}

TEST(ModesTable, HasStaticModesAfterTheSumOfTheOthers) {
  RunResults results = made_up({.modes = 4});
  results.bases[0].static_modes = 2;
  const auto table = lines(modes_table(results));
  ASSERT_EQ(table.size(), 6u); // heads, modes, sum, static modes
  EXPECT_THAT(table[3], HasSubstr("all modes together"));
  EXPECT_THAT(table[3], HasSubstr("80.000")); // 4 of 5 kg in y and in z
  EXPECT_THAT(table[4], HasSubstr("static"));
  EXPECT_THAT(table[5], HasSubstr("static"));
}

TEST(TerminalTable, NamesStepReasonEnergyWarningsAndFiles) {
  const std::string text = terminal_table(made_up(), "folder.results");
  EXPECT_THAT(text, HasSubstr("Straight tube on loose supports\n"));
  EXPECT_THAT(text, HasSubstr("80 000 steps of 2.5e-05 s"));
  EXPECT_THAT(text, HasSubstr("0.5 / contact frequency"));
  EXPECT_THAT(unwrapped(text),
              HasSubstr("loads 1.5 J + at the start 0.125 J = stored 0.25 + modal damping 1 + contact "
                        "damping 0.125 + friction 0.25"));
  EXPECT_THAT(text, HasSubstr("warning     contact \"tsp2\""));
  EXPECT_THAT(text, HasSubstr("note        made up"));
  EXPECT_THAT(text, HasSubstr("folder.results\n"));
  EXPECT_THAT(text, Not(HasSubstr("DIVERGED")));
}

TEST(TerminalTable, CallsTheWorkOfLoadsTheInputWhereNothingIsStoredAtTheStart) {
  RunResults results = made_up();
  results.transients.resize(1);
  transient::Energy& energy = results.transients[0].report.energy;
  energy.load_work += energy.initial;
  energy.initial = 1e-9;
  EXPECT_THAT(terminal_table(results, "folder.results"),
              HasSubstr(fmt::format("input {:.4g} J = stored ", energy.load_work)));
}

TEST(TerminalTable, SaysWhenARunDivergedOrDidNotConverge) {
  RunResults results = made_up();
  results.transients[0].report.outcome = transient::Outcome::diverged;
  results.transients[0].report.end_time = 0.5;
  results.transients[0].report.counts.unconverged = 1234;
  const std::string text = terminal_table(results);
  EXPECT_THAT(text, HasSubstr("DIVERGED    at 0.5 s"));
  EXPECT_THAT(text, HasSubstr("1 234 of 80 000 steps left contact forces"));
}

TEST(TerminalTable, IsShortWithModesOnly) {
  const std::string text = terminal_table(made_up({.outputs = 0}));
  EXPECT_THAT(text, HasSubstr("6: 0.5 0.5 2 2 4.5 4.5 Hz"));
  for (const char* absent : {"transient   ", "energy", "impacts"})
    EXPECT_THAT(text, Not(HasSubstr(absent)));
}

TEST(TerminalTable, CutsLongNamesBetweenCharacters) {
  RunResults results = made_up();
  results.contacts[0].name = "aaaaaaaaaaaaaa\xc3\xa9\xc3\xa9\xc3\xa9";
  EXPECT_THAT(terminal_table(results), HasSubstr("  aaaaaaaaaaaaaa... "));
}

} // namespace
} // namespace fretwork::results::table_test
