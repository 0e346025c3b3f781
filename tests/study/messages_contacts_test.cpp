// SPDX-License-Identifier: GPL-3.0-or-later
// What the program answers to a wrong contact.
#include "folder.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace fretwork::study::messages_contacts_test {
namespace {

struct Wrong {
  std::string keys;
  std::string said;
};

/// The message about a contact with these keys besides group, axis and stiffness must contain what is said.
void expect_said(const std::vector<Wrong>& cases, const std::string& common = "") {
  for (const Wrong& wrong : cases) {
    const std::string message = message_of(
        "[mesh]\nfile = \"a.msh\"\n[[contacts]]\ngroup = \"p\"\naxis = [1, 0, 0]\n" + common + wrong.keys);
    EXPECT_TRUE(message.starts_with("study.toml:")) << message;
    EXPECT_NE(message.find(wrong.said), std::string::npos) << wrong.keys << "\n" << message;
  }
}

TEST(MessagesOfContacts, SizesThatAreMissing) {
  expect_said(
      {{"", "contacts.p.gap: this required key is missing; give a number >= 0 in m"},
       {"obstacle = \"profile\"",
        "contacts.p.profile: this required key is missing; give polar points [[degrees, m], ...] of a hole"},
       {"obstacle = \"drilled\"", "contacts.p.tube_radius: this required key is missing"},
       {"obstacle = \"drilled\"\ntube_radius = 1", "contacts.p.hole_radius: this required key is missing"},
       {"obstacle = \"broached\"\ntube_radius = 1", "contacts.p.land_radius: this required key is missing"},
       {"obstacle = \"broached\"\ntube_radius = 1\nland_radius = 2",
        "contacts.p.lobe_radius: this required key is missing"},
       {"obstacle = \"broached\"\ntube_radius = 1\nland_radius = 2\nlobe_radius = 3",
        "contacts.p.land_angle: this required key is missing; give a number > 0 in degrees"},
       {"obstacle = \"egg_crate\"\ntube_radius = 1",
        "contacts.p.half_widths: this required key is missing; give two numbers [y, z] in m"},
       {"obstacle = \"ellipse\"\ntube_radius = 1",
        "contacts.p.semi_axes: this required key is missing; give two numbers [y, z] in m"},
       {"obstacle = \"bars_y\"\ntube_radius = 1",
        "contacts.p.bars: this required key is missing; give the distance (m) of a bar's face"},
       {"other = \"q\"", "contacts.p.distance_1: this required key is missing"},
       {"other = \"q\"\ndistance_1 = 1", "contacts.p.distance_2: this required key is missing"}},
      "normal_stiffness = 1\n");
}

TEST(MessagesOfContacts, SizesThatMakeNoObstacle) {
  const std::string broached = "obstacle = \"broached\"\ntube_radius = 1\nland_angle = 20\n";
  expect_said(
      {{"obstacle = \"profile\"\nprofile = [[0, 1], [90, 1]]", "contacts.p.profile = [[0, 1], [90, 1]]: "},
       {"obstacle = \"profile\"\nprofile = [[0, 1], [90]]",
        "contacts.p.profile[1] = [90]: an array of numbers (2) is expected, not of 1"},
       {"obstacle = \"profile\"\nprofile = [[0, 1], [90, -1], [180, 1]]", "contacts.p.profile = "},
       {"obstacle = \"drilled\"\ntube_radius = 1\nhole_radius = 0.9",
        "contacts.p.hole_radius = 0.9: drilled hole: hole radius = 0.9 m is less than the tube radius"},
       {broached + "land_radius = 0.9\nlobe_radius = 2",
        "contacts.p.land_radius = 0.9: broached hole: land radius = 0.9 m"},
       {broached + "land_radius = 1.1\nlobe_radius = 2\nlands = 18",
        "contacts.p.land_angle = 20: 18 lands of this angle leave no lobe between them; give less than 20 "
        "degrees"},
       {broached + "land_radius = 1.1\nlobe_radius = 2\nlands = 1",
        "contacts.p.lands = 1: an integer >= 2 is expected"},
       {broached + "land_radius = 1.1\nlobe_radius = 2\nlands = 400",
        "contacts.p.lands = 400: more lands than a hole has room for"},
       {"obstacle = \"egg_crate\"\ntube_radius = 1\nhalf_widths = [0.9, 2]",
        "contacts.p.half_widths = [0.9, 2]: egg crate: half width along y = 0.9 m"},
       {"obstacle = \"egg_crate\"\ntube_radius = 1\nhalf_widths = [2, 2, 2]",
        "contacts.p.half_widths = [2, 2, 2]: an array of numbers (2 in m) is expected, not of 3"},
       {"obstacle = \"ellipse\"\ntube_radius = 1\nsemi_axes = [0.9, 2]",
        "contacts.p.semi_axes = [0.9, 2]: elliptic hole: semi-axis along y = 0.9 m"},
       {"obstacle = \"bars_z\"\ntube_radius = 1\nbars = 0.9",
        "contacts.p.bars = 0.9: flat bars: distance = 0.9 m is less than the tube radius, 1 m"},
       {"obstacle = \"bars_z\"\ntube_radius = 1\nbars = [0.9, 1.0]",
        "contacts.p.bars = [0.9, 1]: flat bars: half the distance between the bars = 0.95 m"},
       {"obstacle = \"bars_z\"\ntube_radius = 1\nbars = [1]",
        "contacts.p.bars = [1]: an array of numbers (2 in m) is expected, not of 1"},
       {"other = \"q\"\nobstacle = \"circle_inside\"\ndistance_1 = 2\ndistance_2 = 1",
        "contacts.p.distance_2 = 1: the ring round the second node is smaller than what moves in it"},
       {"other = \"q\"\ndistance_1 = 0\ndistance_2 = 0",
        "contacts.p.distance_1 = 0: two bodies without size never meet"},
       {"other = \"q\"\ndistance_1 = -1\ndistance_2 = 0",
        "contacts.p.distance_1 = -1: a number >= 0 in m is expected"},
       {"other = \"q\"\nobstacle = \"plane_y\"\ndistance_1 = 1\ndistance_2 = 0\nside = 2",
        "contacts.p.side = 2: the side of the second node on which the first stays; give 1 or -1"}},
      "normal_stiffness = 1\n");
}

TEST(MessagesOfContacts, KeysOfAnotherObstacle) {
  expect_said(
      {{"gap = 0\ntube_radius = 1", "contacts.p.tube_radius = 1: does not belong to obstacle = \"circle\""},
       {"gap = 0\nobstacle = \"drilled\"", "contacts.p.gap = 0: does not belong to obstacle = \"drilled\""},
       {"gap = 0\nobstacle = \"bars_y\"\nhole_radius = 1",
        "does not belong to obstacle = \"bars_y\", whose sizes are tube_radius, bars; leave"},
       {"gap = 0\ndistance_1 = 1",
        "contacts.p.distance_1 = 1: belongs to a contact between two nodes; name the second one in other"},
       {"gap = 0\nside = 1", "contacts.p.side = 1: belongs to a contact between two nodes"},
       {"obstacle = \"circle_inside\"", "contacts.p.obstacle = \"circle_inside\": a ring that moves with a "
                                        "second node; name that node in other"},
       {"other = \"q\"\ngap = 0\ndistance_1 = 1",
        "contacts.p.distance_1 = 1: the gap at rest says how large"},
       {"other = \"q\"\nobstacle = \"circle_inside\"\ngap = 0",
        "contacts.p.gap = 0: the clearance of a ring is distance_2 - distance_1"},
       {"other = \"q\"\ntube_radius = 1", "contacts.p.tube_radius = 1: between two nodes"},
       {"other = \"q\"\ndistance_1 = 1\ndistance_2 = 1\nside = 1",
        "contacts.p.side = 1: round bodies meet on any side; leave it out"}},
      "normal_stiffness = 1\n");
  for (const char* fixed :
       {"stop_y", "stop_z", "profile", "ellipse", "drilled", "broached", "egg_crate", "bars_y", "bars_z"})
    expect_said({{std::string("other = \"q\"\nobstacle = \"") + fixed + "\"",
                  std::string("contacts.p.obstacle = \"") + fixed +
                      "\": an obstacle fixed in space; between two nodes take circle"}});
}

TEST(MessagesOfContacts, Thickness) {
  expect_said({{"thickness = 0", "contacts.p.thickness = 0: a number > 0 in m is expected"},
               {"thickness_points = 3",
                "contacts.p.thickness_points = 3: belongs to a support with a thickness; give thickness (m)"},
               {"thickness = 1\nthickness_points = 1",
                "contacts.p.thickness_points = 1: an integer >= 2 is expected"},
               {"thickness = 1\nthickness_points = 1001",
                "contacts.p.thickness_points = 1001: each point is a contact of its own; give at most 1000"}},
              "gap = 0\nnormal_stiffness = 1\n");
  expect_said({{"other = \"q\"\ndistance_1 = 1\ndistance_2 = 1\nthickness = 1\nnormal_stiffness = 1",
                "contacts.p.thickness = 1: belongs to a support fixed in space"}});
}

TEST(MessagesOfContacts, NormalLaw) {
  const std::string hunt = "normal_stiffness = 1\nnormal_law = \"hunt_crossley\"\n";
  expect_said(
      {{"",
        "contacts.p.normal_stiffness: this required key is missing; give a number > 0 in N/m, or \"wall\""},
       {"normal_stiffness = \"wal\"",
        "contacts.p.normal_stiffness = \"wal\": unknown; did you mean \"wall\"?"},
       {"normal_stiffness = 1\nnormal_law = \"hunt\"",
        "contacts.p.normal_law = \"hunt\": unknown; did you mean \"hunt_crossley\"? available: "
        "\"reference\", \"hunt_crossley\""},
       {hunt + "normal_damping = 1", "contacts.p.normal_damping = 1: belongs to normal_law = \"reference\"; "
                                     "give normal_dissipation (s/m)"},
       {"normal_stiffness = 1\nnormal_dissipation = 1",
        "contacts.p.normal_dissipation = 1: belongs to normal_law = \"hunt_crossley\"; name that law"},
       {hunt + "normal_dissipation = -1",
        "contacts.p.normal_dissipation = -1: a number >= 0 in s/m is expected"}},
      "gap = 0\n");
}

TEST(MessagesOfContacts, Restitution) {
  const std::string hunt = "normal_law = \"hunt_crossley\"\n";
  expect_said(
      {{"restitution = 0",
        "contacts.p.restitution = 0: a number > 0 is expected; 0 would need an infinite damper"},
       {"restitution = 1.1", "contacts.p.restitution = 1.1: an impact does not gain speed"},
       {"restitution = 0.5\nnormal_damping = 1",
        "contacts.p.normal_damping = 1: restitution already gives the damper; keep one of the two"},
       {hunt + "restitution = 0.5\nrestitution_velocity = 1\nnormal_dissipation = 1",
        "contacts.p.normal_dissipation = 1: restitution already gives the damper"},
       {hunt + "restitution = 0.5",
        "contacts.p.restitution_velocity: this required key is missing; give the speed of impact (m/s)"},
       {hunt + "restitution = 0.5\nrestitution_velocity = 0",
        "contacts.p.restitution_velocity = 0: a number > 0 in m/s is expected"},
       {hunt + "restitution = 0.5\nrestitution_velocity = 1\nrestitution_mass = 1",
        "contacts.p.restitution_mass = 1: with normal_law = \"hunt_crossley\" what an impact loses does not"},
       {"restitution = 0.5\nrestitution_velocity = 1",
        "contacts.p.restitution_velocity = 1: with normal_law = \"reference\" the restitution is the same"},
       {"restitution = 0.5\nrestitution_mass = 0",
        "contacts.p.restitution_mass = 0: a number > 0 in kg is expected"},
       {"restitution_mass = 1",
        "contacts.p.restitution_mass = 1: belongs to restitution, which is not given"},
       {"restitution_velocity = 1", "contacts.p.restitution_velocity = 1: belongs to restitution"}},
      "gap = 0\nnormal_stiffness = 1\n");
}

TEST(MessagesOfContacts, FrictionDirection) {
  expect_said({{"friction_direction = \"axiale\"",
                "contacts.p.friction_direction = \"axiale\": unknown; did you mean \"axial\"? available: "
                "\"both\", \"axial\", \"transverse\""}},
              "gap = 0\nnormal_stiffness = 1\n");
}

TEST(MessagesOfContacts, DirectionOfWhatIsNotRound) {
  for (const std::string keys :
       {"obstacle = \"broached\"\ntube_radius = 9.5e-3\nland_radius = 9.7e-3\nlobe_radius = 11e-3\n"
        "land_angle = 20",
        "obstacle = \"bars_y\"\ntube_radius = 1\nbars = 1.1"}) {
    const std::string message =
        message_of("[mesh]\nfile = \"a.msh\"\n[[contacts]]\ngroup = \"p\"\nnormal_stiffness = 1\n" + keys);
    EXPECT_NE(message.find("needs its direction; give y_axis, or axis (and angle)"), std::string::npos)
        << message;
  }
}

} // namespace
} // namespace fretwork::study::messages_contacts_test
