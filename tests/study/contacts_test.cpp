// SPDX-License-Identifier: GPL-3.0-or-later
// Every obstacle and law a study can name, as read.
#include "contact/support_shapes.hpp"
#include "folder.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::study::contacts_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double subtraction = 1e-16; ///< m: of two lengths of a centimetre

/// The one contact of a study with these keys, directed along x.
Contact contact_with(const std::string& keys) {
  return read_text("[mesh]\nfile = \"a.msh\"\n[[contacts]]\nname = \"c\"\ngroup = \"p\"\naxis = [1, 0, 0]\n"
                   "normal_stiffness = 1e6\n" +
                   keys)
      .contacts.at(0);
}

Contact law(const std::string& keys) {
  return read_text("[mesh]\nfile = \"a.msh\"\n[[contacts]]\nname = \"c\"\ngroup = \"p\"\ngap = 0.1\n" + keys)
      .contacts.at(0);
}

TEST(ReadObstacle, Circle) {
  EXPECT_EQ(std::get<contact::Circle>(contact_with("gap = 1e-3").shape).gap, 1e-3);
}

TEST(ReadObstacle, AttachedToTheBaseOrTheGround) {
  EXPECT_FALSE(contact_with("gap = 1e-3").grounded);
  EXPECT_FALSE(contact_with("gap = 1e-3\nattached_to = \"base\"").grounded);
  EXPECT_TRUE(contact_with("gap = 1e-3\nattached_to = \"ground\"").grounded);
}

TEST(ReadBaseMotion, TakesItsStateAtTheStart) {
  const std::string text =
      "[mesh]\nfile = \"a.msh\"\n[[base_motion]]\ndirection = [0, 2, 0]\nconstant = 1.5\n";
  const BaseMotion rest = read_text(text).base_motions.at(0);
  EXPECT_FALSE(rest.velocity0);
  EXPECT_FALSE(rest.displacement0);
  const BaseMotion moving = read_text(text + "velocity0 = -0.5\ndisplacement0 = 0.25\n").base_motions.at(0);
  EXPECT_EQ(moving.velocity0, -0.5);
  EXPECT_EQ(moving.displacement0, 0.25);
}

TEST(ReadObstacle, PlanesAndStops) {
  using contact::PlaneAxis;
  for (const auto& [letter, axis] : {std::pair{"y", PlaneAxis::y}, std::pair{"z", PlaneAxis::z}}) {
    const auto planes = std::get<contact::PlanePair>(
        contact_with(std::string("gap = 2e-3\nobstacle = \"plane_") + letter + "\"").shape);
    EXPECT_EQ(planes.gap, 2e-3);
    EXPECT_EQ(planes.axis, axis);
    const auto stop = std::get<contact::Stop>(
        contact_with(std::string("gap = 3e-3\nobstacle = \"stop_") + letter + "\"").shape);
    EXPECT_EQ(stop.gap, 3e-3);
    EXPECT_EQ(stop.axis, axis);
  }
}

TEST(ReadObstacle, ProfileInDegreesAndMetres) {
  const Contact read =
      contact_with("obstacle = \"profile\"\nprofile = [[0, 1e-3], [90, 2e-3], [180, 1e-3], [270, 2e-3]]");
  const auto& profile = std::get<contact::Profile>(read.shape);
  ASSERT_EQ(profile.vertices().size(), 4u);
  EXPECT_EQ(profile.vertices()[0].y, 1e-3);
  EXPECT_EQ(profile.vertices()[1].z, 2e-3);
}

TEST(ReadObstacle, DrilledHole) {
  const Contact read = contact_with("obstacle = \"drilled\"\ntube_radius = 9.5e-3\nhole_radius = 9.7e-3");
  EXPECT_NEAR(std::get<contact::Circle>(read.shape).gap, 2e-4, subtraction);
}

TEST(ReadObstacle, BroachedHole) {
  const Contact read = contact_with("obstacle = \"broached\"\ntube_radius = 9.5e-3\nland_radius = 9.7e-3\n"
                                    "lobe_radius = 11e-3\nlands = 4\nland_angle = 20");
  const contact::BroachedSpace wanted(9.5e-3, {9.7e-3, 11e-3, 4, 20.0 * degree});
  const auto& space = std::get<contact::BroachedSpace>(read.shape);
  for (const double angle : {0.0, 0.3, 0.7, 1.1}) {
    const double y = 1.9e-4 * std::cos(angle), z = 1.9e-4 * std::sin(angle);
    EXPECT_EQ(space.locate(y, z).gap, wanted.locate(y, z).gap) << angle;
  }
}

TEST(ReadObstacle, BroachedHoleHasThreeLandsByDefault) {
  const std::string sizes = "obstacle = \"broached\"\ntube_radius = 9.5e-3\nland_radius = 9.7e-3\n"
                            "lobe_radius = 11e-3\nland_angle = 20\n";
  EXPECT_EQ(std::get<contact::BroachedSpace>(contact_with(sizes).shape).hole().lands, 3);
}

TEST(ReadObstacle, EggCrate) {
  const Contact read =
      contact_with("obstacle = \"egg_crate\"\ntube_radius = 9.5e-3\nhalf_widths = [9.7e-3, 9.8e-3]");
  const auto& profile = std::get<contact::Profile>(read.shape);
  ASSERT_EQ(profile.vertices().size(), 4u);
  EXPECT_NEAR(profile.locate(0.0, 0.0).gap, 2e-4, subtraction);
  EXPECT_NEAR(profile.locate(0.0, 2.5e-4).gap, 5e-5, subtraction);
}

TEST(ReadObstacle, EllipticHole) {
  const Contact read =
      contact_with("obstacle = \"ellipse\"\ntube_radius = 9.5e-3\nsemi_axes = [9.7e-3, 9.8e-3]");
  EXPECT_NEAR(contact::locate(read.shape, 2.5e-4, 0.0).gap, -5e-5, subtraction);
  EXPECT_NEAR(contact::locate(read.shape, 0.0, 2.5e-4).gap, 5e-5, subtraction);
  EXPECT_FALSE(is_round(read.obstacle));
}

TEST(ReadObstacle, OneBarIsAStop) {
  const Contact read = contact_with("obstacle = \"bars_z\"\ntube_radius = 9.5e-3\nbars = 9.6e-3");
  const auto stop = std::get<contact::Stop>(read.shape);
  EXPECT_EQ(stop.axis, contact::PlaneAxis::z);
  EXPECT_NEAR(stop.gap, 1e-4, subtraction);
  EXPECT_EQ(read.offset, (std::array<double, 2>{}));
}

TEST(ReadObstacle, TwoBarsAreAPairOfPlanesThatMayBeAsideOfTheTube) {
  const Contact read = contact_with(
      "obstacle = \"bars_y\"\ntube_radius = 9.5e-3\nbars = [9.6e-3, 9.8e-3]\noffset = [1e-3, 2e-3]");
  const auto planes = std::get<contact::PlanePair>(read.shape);
  EXPECT_EQ(planes.axis, contact::PlaneAxis::y);
  EXPECT_NEAR(planes.gap, 2e-4, subtraction);
  EXPECT_NEAR(read.offset[0], 1e-3 + 1e-4, subtraction);
  EXPECT_EQ(read.offset[1], 2e-3);
}

TEST(ReadObstacle, BetweenTwoNodes) {
  const std::string sizes = "other = \"q\"\ndistance_1 = 9.5e-3\ndistance_2 = 10e-3\n";
  const Contact round = contact_with(sizes);
  EXPECT_EQ(round.other, "q");
  EXPECT_NEAR(std::get<contact::RoundPair>(round.shape).distance, 19.5e-3, subtraction);
  const Contact ring = contact_with(sizes + "obstacle = \"circle_inside\"");
  EXPECT_NEAR(std::get<contact::Circle>(ring.shape).gap, 5e-4, subtraction);
  const Contact flat = contact_with(sizes + "obstacle = \"plane_z\"");
  EXPECT_EQ(std::get<contact::FacingPlanes>(flat.shape).axis, contact::PlaneAxis::z);
  EXPECT_FALSE(flat.side);
  const Contact sided = contact_with(sizes + "obstacle = \"plane_y\"\nside = -1");
  EXPECT_EQ(std::get<contact::FacingPlanes>(sided.shape).side, -1.0);
  EXPECT_EQ(sided.side, -1.0);
}

TEST(ReadObstacle, BetweenTwoNodesTakesTheirGapAtRest) {
  for (const char* kind : {"circle", "plane_y", "plane_z"}) {
    const Contact pair = contact_with(std::string("other = \"q\"\ngap = 2e-4\nobstacle = \"") + kind + "\"");
    EXPECT_EQ(pair.pair_gap, 2e-4) << kind;
  }
  EXPECT_FALSE(contact_with("gap = 2e-4").pair_gap) << "of one node the obstacle has it";
}

TEST(ReadObstacle, TellsItsNameInTheFile) {
  for (const char* name : {"circle", "plane_y", "plane_z", "stop_y", "stop_z"})
    EXPECT_EQ(name_of(contact_with(std::string("gap = 1\nobstacle = \"") + name + "\"").obstacle), name);
  EXPECT_TRUE(is_round(ObstacleKind::drilled));
  EXPECT_FALSE(is_round(ObstacleKind::broached));
}

TEST(ReadThickness, OnePointWithoutAndTwoWith) {
  EXPECT_EQ(contact_with("gap = 0").points, 1);
  const Contact two = contact_with("gap = 0\nthickness = 0.03");
  EXPECT_EQ(two.points, 2);
  EXPECT_EQ(two.thickness, 0.03);
  EXPECT_EQ(contact_with("gap = 0\nthickness = 0.03\nthickness_points = 5").points, 5);
}

TEST(ReadNormalLaw, WallHasNoValueYet) {
  EXPECT_FALSE(law("normal_stiffness = \"wall\"").normal_stiffness);
  EXPECT_EQ(law("normal_stiffness = 2e6").normal_stiffness, 2e6);
}

TEST(ReadNormalLaw, DampersOfBothLaws) {
  const Contact plain = law("normal_stiffness = 1\nnormal_damping = 5");
  EXPECT_EQ(plain.normal_damper, NormalDamper::reference);
  EXPECT_EQ(plain.normal_damping, 5.0);
  const Contact other = law("normal_stiffness = 1\nnormal_law = \"hunt_crossley\"\nnormal_dissipation = 0.4");
  EXPECT_EQ(other.normal_damper, NormalDamper::hunt_crossley);
  EXPECT_EQ(other.normal_dissipation, 0.4);
  EXPECT_FALSE(other.restitution);
}

TEST(ReadNormalLaw, RestitutionOfBothLaws) {
  const Contact plain = law("normal_stiffness = 1\nrestitution = 0.7\nrestitution_mass = 0.2");
  ASSERT_TRUE(plain.restitution);
  EXPECT_EQ(plain.restitution->value, 0.7);
  EXPECT_EQ(plain.restitution->mass, 0.2);
  EXPECT_FALSE(law("normal_stiffness = 1\nrestitution = 1").restitution->mass);
  const Contact other = law("normal_stiffness = 1\nnormal_law = \"hunt_crossley\"\nrestitution = 0.7\n"
                            "restitution_velocity = 0.1");
  EXPECT_EQ(other.restitution->velocity, 0.1);
}

TEST(ReadFriction, Directions) {
  for (const auto& [name, x, t] :
       {std::tuple{"both", 1.0, 1.0}, std::tuple{"axial", 1.0, 0.0}, std::tuple{"transverse", 0.0, 1.0}}) {
    const Contact read = law(std::string("normal_stiffness = 1\nfriction_direction = \"") + name + "\"");
    EXPECT_EQ(read.friction_along.x, x) << name;
    EXPECT_EQ(read.friction_along.t, t) << name;
  }
  EXPECT_EQ(law("normal_stiffness = 1").friction_along.x, 1.0);
}

} // namespace
} // namespace fretwork::study::contacts_test
