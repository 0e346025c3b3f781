// SPDX-License-Identifier: GPL-3.0-or-later
// [[wear]]: what is read, and what the program answers to a wrong entry.
#include "folder.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace fretwork::study::wear_test {
namespace {

constexpr double digits = 1e-15; ///< of degrees turned into radians

std::string wear_entry(const std::string& keys) { return contact("[[wear]]\n" + keys); }

Wear read_entry(const std::string& keys) { return read_text(wear_entry(keys)).wear.at(0); }

TEST(Wear, HasDefaultsForAllButTheCoefficient) {
  const Wear wear = read_entry("coefficient = 1e-14");
  EXPECT_EQ(std::get<fretwork::wear::Archard>(wear.law).coefficient, 1e-14);
  EXPECT_TRUE(wear.contacts.empty());
  EXPECT_FALSE(wear.one_support);
  EXPECT_EQ(wear.support_coefficient, 0.0);
  EXPECT_EQ(wear.geometry, WearGeometry::obstacle);
  EXPECT_EQ(wear.form, fretwork::wear::Form::exact);
  EXPECT_FALSE(wear.tube_radius || wear.wall || wear.length || wear.clearance || wear.support_limit);
  EXPECT_EQ(wear.limit, 0.4);
  EXPECT_EQ(wear.years, 40.0);
  EXPECT_EQ(wear.sectors, 36);
  ASSERT_EQ(wear.states.size(), 1u);
  EXPECT_EQ(wear.states[0].share, 1.0);
  EXPECT_FALSE(wear.states[0].results || wear.states[0].given);
}

TEST(Wear, ReadsEveryKey) {
  const Wear wear = read_entry(R"(name = "plate"
contacts = ["c", "d*"]
one_support = true
materials = "690_405"
coefficient_class = "four_lands"
support_coefficient = 2e-15
geometry = "lands"
form = "reference"
tube_radius = 9.5e-3
wall = 1.1e-3
length = 0.03
clearance = 2e-4
half_angle = 10
lands = 3
inclination = 0.5
limit = 0.3
support_limit = 1e-3
years = 60
sectors = 72)");
  EXPECT_EQ(wear.path, "wear.plate");
  EXPECT_EQ(wear.name, "plate");
  EXPECT_EQ(wear.contacts, (std::vector<std::string>{"c", "d*"}));
  EXPECT_TRUE(wear.one_support);
  EXPECT_EQ(wear.materials, "690_405");
  EXPECT_EQ(wear.coefficient_class, "four_lands");
  EXPECT_EQ(wear.support_coefficient, 2e-15);
  EXPECT_EQ(wear.geometry, WearGeometry::lands);
  EXPECT_EQ(wear.form, fretwork::wear::Form::reference);
  EXPECT_EQ(wear.tube_radius, 9.5e-3);
  EXPECT_EQ(wear.wall, 1.1e-3);
  EXPECT_EQ(wear.length, 0.03);
  EXPECT_EQ(wear.clearance, 2e-4);
  EXPECT_NEAR(*wear.half_angle, std::numbers::pi / 18.0, digits);
  EXPECT_EQ(wear.lands, 3);
  EXPECT_NEAR(wear.inclination, std::numbers::pi / 360.0, digits);
  EXPECT_EQ(wear.limit, 0.3);
  EXPECT_EQ(wear.support_limit, 1e-3);
  EXPECT_EQ(wear.years, 60.0);
  EXPECT_EQ(wear.sectors, 72);
}

TEST(Wear, ReadsTheLawsWithTheirConstants) {
  EXPECT_EQ(std::get<fretwork::wear::EdfMz>(read_entry("law = \"edf_mz\"").law).s, 1.14e-16);
  const auto edf = std::get<fretwork::wear::EdfMz>(
      read_entry("law = \"edf_mz\"\nconstants = { a = 2e-13, b = 1.1, n = 3e-8, s = 0 }").law);
  EXPECT_EQ(edf.a, 2e-13);
  EXPECT_EQ(edf.b, 1.1);
  EXPECT_EQ(edf.n, 3e-8);
  EXPECT_EQ(edf.s, 0.0);
  const Wear kwu = read_entry("law = \"kwu_epri\"\ncoefficient = 5e-15\nconstants = { k1 = 4, k2 = 40, "
                              "force_max = 50, speed_max = 0.05 }");
  EXPECT_EQ(std::get<fretwork::wear::KwuEpri>(kwu.law).coefficient, 5e-15);
  EXPECT_EQ(kwu.kwu.k1, 4.0);
  EXPECT_EQ(kwu.kwu.k2, 40.0);
  EXPECT_EQ(kwu.kwu.k, 5.0);
  EXPECT_EQ(kwu.kwu.force, 10.0);
  EXPECT_EQ(kwu.kwu_maxima.force, 50.0);
  EXPECT_EQ(kwu.kwu_maxima.speed, 0.05);
}

TEST(Wear, ReadsOperatingStates) {
  const Folder folder;
  const Study study = read(folder.write("study.toml", wear_entry(R"(coefficient = 1e-14
states = [{ share = 0.7 }, { name = "half power", share = 0.2, results = "half.results" }, { share = 0.05, work_rate = 0 },
          { share = 0.05, work_rate = [1e-3, 2e-3, 4e-3] }])")));
  const auto& states = study.wear.at(0).states;
  ASSERT_EQ(states.size(), 4u);
  EXPECT_EQ(states[0].name, "this run");
  EXPECT_FALSE(states[0].results || states[0].given);
  EXPECT_EQ(states[1].name, "half power");
  EXPECT_EQ(states[1].results, folder.path() / "half.results");
  EXPECT_EQ(states[2].given->value, 0.0);
  EXPECT_FALSE(states[2].given->has_interval);
  EXPECT_EQ(states[3].name, "state 4");
  EXPECT_EQ(states[3].given->low, 1e-3);
  EXPECT_EQ(states[3].given->value, 2e-3);
  EXPECT_EQ(states[3].given->high, 4e-3);
}

TEST(Wear, IsAddressedByItsName) {
  const Study study =
      read_text(wear_entry("name = \"all\"\ncoefficient = 1e-14"), {"wear.all.coefficient=2e-14"});
  EXPECT_EQ(std::get<fretwork::wear::Archard>(study.wear[0].law).coefficient, 2e-14);
}

struct Wrong {
  std::string keys, said;
};

TEST(MessagesOfWear, NameTheKeyTheValueAndTheCure) {
  const std::string k = "coefficient = 1e-14\n";
  const std::string kwu = "law = \"kwu_epri\"\n" + k;
  const std::vector<Wrong> cases{
      {"", "wear.0.coefficient: this required key is missing; give the coefficient of the tube in m2/N, or "
           "materials = \"690_405\""},
      {"coefficient = -1", "wear.0.coefficient = -1: a number >= 0 in m2/N is expected"},
      {"coeficient = 1", "wear.0.coeficient = 1: unknown key; did you mean \"coefficient\"?"},
      {k + "materials = \"690_405\"",
       "wear.0.materials = \"690_405\": coefficient and materials both give the coefficient"},
      {k + "coefficient_class = \"any\"",
       "coefficient_class = \"any\": names the class of geometry in the bank"},
      {k + "law = \"archad\"", "wear.0.law = \"archad\": unknown; did you mean \"archard\"?"},
      {k + "constants = { a = 1 }", "law = \"archard\" has only its coefficient; leave it out"},
      {"law = \"edf_mz\"\n" + k, "law = \"edf_mz\" has constants of its own; leave it out"},
      {"law = \"edf_mz\"\nconstants = { c = 1 }", "wear.0.constants.c = 1: unknown key"},
      {"law = \"edf_mz\"\nconstants = { a = 0 }", "wear.0.constants.a = 0: a number > 0 in m3/s/W^b"},
      {kwu, "wear.0.constants: this required key is missing; give { k1, k2, force_max, speed_max }"},
      {kwu + "constants = { k1 = 4 }", "wear.0.constants.k2: this required key is missing"},
      {kwu + "constants = { k1 = 4, k2 = 40, force_max = 50, speed_max = 0 }",
       "wear.0.constants.speed_max = 0: a number > 0 in m/s"},
      {kwu + "constants = { k1 = 4, k2 = 40, force_max = 50, speed_max = 1 }\nstates = [{ share = 0.5 }, { "
             "share = 0.5, work_rate = 0 }]",
       "law = \"kwu_epri\" takes the forces and speeds of this run; leave states out"},
      {k + "contacts = []", "the array is empty; give names of contacts, or patterns with * and ?"},
      {k + "contacts = 3", "a string between quotes is expected"},
      {k + "one_support = true", "contacts that wear one scar need the name of their support; give name"},
      {k + "geometry = \"hole\"", "wear.0.geometry = \"hole\": unknown"},
      {k + "clearance = 1e-4",
       "wear.0.clearance = 0.0001: does not belong to geometry = \"obstacle\"; leave it out"},
      {k + "geometry = \"ring\"\ninclination = 1", "does not belong to geometry = \"ring\""},
      {k + "geometry = \"flat_bar\"\nlands = 4", "does not belong to geometry = \"flat_bar\""},
      {k + "geometry = \"lands\"",
       "wear.0.half_angle: this required key is missing; give half of a land's angle"},
      {k + "geometry = \"lands\"\nhalf_angle = 10\nlands = 1", "an integer >= 2 is expected"},
      {k + "geometry = \"lands\"\nhalf_angle = 10\nlands = 400", "more lands than a hole has room for"},
      {k + "geometry = \"sectors\"\nform = \"exact\"", "sectors have one form only; leave it out"},
      {"law = \"edf_mz\"\ngeometry = \"sectors\"", "which only law = \"archard\" allows"},
      {k + "form = \"peer\"", "wear.0.form = \"peer\": unknown"},
      {k + "inclination = 90", "an angle below 90 degrees between tube and support is expected"},
      {k + "length = 0", "wear.0.length = 0: a number > 0 in m is expected"},
      {k + "wall = -1", "wear.0.wall = -1: a number > 0 in m is expected"},
      {k + "tube_radius = 0", "wear.0.tube_radius = 0: a number > 0 in m is expected"},
      {k + "limit = 1.5", "wear.0.limit = 1.5: a share of the wall of at most 1 is expected"},
      {k + "limit = 0", "wear.0.limit = 0: a number > 0"},
      {k + "initial_wear = 20",
       "wear.0.initial_wear = 20: a share of the wall below 1 is expected, such as 0.2"},
      {k + "initial_wear = \"20%\"",
       "wear.0.initial_wear = \"20%\": a share of the wall below 1 is expected, such as 0.2"},
      {k + "initial_wear = -0.1", "wear.0.initial_wear = -0.1: a number >= 0"},
      {k + "initial_wear = { \"+y\" = 1.0 }", "wear.0.initial_wear.+y = 1: a share of the wall below 1"},
      {k + "support_limit = 0", "wear.0.support_limit = 0: a number > 0 in m is expected"},
      {k + "support_coefficient = -1", "wear.0.support_coefficient = -1: a number >= 0 in m2/N"},
      {k + "years = 0", "wear.0.years = 0: a number > 0 in years is expected"},
      {k + "sectors = 0", "wear.0.sectors = 0: an integer >= 1 is expected"},
      {k + "sectors = 4000", "wear.0.sectors = 4000: at most 3600 sectors"},
      {k + "states = [{ share = 0.7 }]",
       "the shares sum to 0.7; they are shares of the whole time: add { share = 0.3, work_rate = 0 }"},
      {k + "states = [{ share = 0.8 }, { share = 0.3, work_rate = 0.01 }]",
       "the shares sum to 1.1; they are shares of the whole time: give smaller ones"},
      {k + "states = [{ share = 0.5 }, { share = 0.5 }]",
       "a state without results and work_rate is this run, which can be one of them only"},
      {k + "states = [{ work_rate = 1 }]", "wear.0.states[0].share: this required key is missing"},
      {k + "states = [{ share = -1 }]", "wear.0.states[0].share = -1: a number >= 0 is expected"},
      {k + "states = [{ share = 1, power = 3 }]", "wear.0.states[0].power = 3: unknown key"},
      {k + "states = [{ share = 1, results = \"a\", work_rate = 1 }]",
       "wear.0.states[0].results = \"a\": results and work_rate both give the work rates of the state"},
      {k + "states = [{ share = 1, work_rate = [2, 1, 3] }]",
       "[lower end, value, upper end] of the interval is expected, in rising order"},
      {k + "[[wear]]\ncoefficient = 2e-14",
       "wear.1: a second entry for all contacts that no other names (the first: study.toml:"}};
  for (const Wrong& wrong : cases) {
    const std::string message = message_of(wear_entry(wrong.keys));
    EXPECT_TRUE(message.starts_with("study.toml:")) << wrong.keys << "\n" << message;
    EXPECT_NE(message.find(wrong.said), std::string::npos) << wrong.keys << "\n" << message;
  }
}

TEST(GapOpening, HasTheYearsOfTheWear) {
  const std::string wear =
      "coefficient = 1e-14\nyears = 60\ncontacts = \"c\"\n[[wear]]\ncoefficient = 1e-14\n";
  const Study study = read_text(wear_entry(wear + "[gap_opening]\n"));
  EXPECT_EQ(study.gap_opening->stages, 20);
  EXPECT_EQ(study.gap_opening->years, 60.0);
  EXPECT_EQ(study.gap_opening->gap_share, 0.1);
  EXPECT_EQ(study.gap_opening->wall_share, 0.05);
  EXPECT_EQ(study.gap_opening->least_wall_share, 0.005);
  EXPECT_FALSE(read_text(wear_entry(wear)).gap_opening);
  EXPECT_EQ(read_text(wear_entry(wear), {"gap_opening.stages=7"}).gap_opening->stages, 7);
  const Study given = read_text(wear_entry(
      wear +
      "[gap_opening]\nstages = 5\nyears = 10\ngap_share = 0.2\nwall_share = 0.1\nleast_wall_share = 0.01"));
  EXPECT_EQ(given.gap_opening->stages, 5);
  EXPECT_EQ(given.gap_opening->years, 10.0);
  EXPECT_EQ(given.gap_opening->gap_share, 0.2);
  EXPECT_EQ(given.gap_opening->wall_share, 0.1);
  EXPECT_EQ(given.gap_opening->least_wall_share, 0.01);
}

TEST(MessagesOfWear, NameTheKeyOfGapOpening) {
  const std::string wear = "coefficient = 1e-14\n[gap_opening]\n";
  const std::vector<Wrong> cases{
      {wear + "stages = 0", "gap_opening.stages = 0: an integer >= 1 is expected"},
      {wear + "years = 0", "gap_opening.years = 0: a number > 0 in years is expected"},
      {wear + "gap_share = -1", "gap_opening.gap_share = -1: a number > 0"},
      {wear + "wall_share = 0", "gap_opening.wall_share = 0: a number > 0"},
      {wear + "least_wall_share = 0.06",
       "gap_opening.least_wall_share = 0.06: above wall_share = 0.05, of which it is the lower bound"},
      {wear + "stage = 3", "gap_opening.stage = 3: unknown key; did you mean \"stages\"?"}};
  for (const Wrong& wrong : cases) {
    const std::string message = message_of(wear_entry(wrong.keys));
    EXPECT_NE(message.find(wrong.said), std::string::npos) << wrong.keys << "\n" << message;
  }
  EXPECT_NE(message_of(contact("[gap_opening]\n")).find("there is no [[wear]] that could open gaps"),
            std::string::npos);
}

TEST(MessagesOfWear, NeedsContacts) {
  EXPECT_NE(message_of("[mesh]\nfile = \"a.msh\"\n[[wear]]\ncoefficient = 1e-14")
                .find("wear.0: there are no [[contacts]] that could wear"),
            std::string::npos);
}

} // namespace
} // namespace fretwork::study::wear_test
