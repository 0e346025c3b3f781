// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::contact_defaults_test {
namespace {

const std::string mesh = "[mesh]\nfile = \"a.msh\"\n";
const std::string two =
    "[[contacts]]\ngroup = \"a\"\n[[contacts]]\ngroup = \"b\"\nnormal_stiffness = 2e6\nrestitution = 0.8\n";

TEST(ContactDefaults, AreTakenWhereAContactDoesNotSayOtherwise) {
  const Study study =
      read_text(mesh +
                "[contact_defaults]\ngap = 1e-4\nnormal_stiffness = 1e6\nnormal_damping = 5\nfriction = 0.3\n"
                "tangential_stiffness = 3e5\n" +
                two);
  ASSERT_EQ(study.contacts.size(), 2u);
  EXPECT_EQ(study.contacts[0].normal_stiffness, 1e6);
  EXPECT_EQ(study.contacts[0].normal_damping, 5.0);
  EXPECT_EQ(study.contacts[1].normal_stiffness, 2e6);
  EXPECT_EQ(study.contacts[1].restitution->value, 0.8);
  EXPECT_EQ(study.contacts[1].normal_damping, 0.0) << "its restitution gives the damper";
  for (const Contact& contact : study.contacts) {
    EXPECT_EQ(gap_of(contact), 1e-4);
    EXPECT_EQ(contact.friction_static, 0.3);
  }
}

TEST(ContactDefaults, CanBeOverridden) {
  const Study study = read_text(mesh + "[[contacts]]\ngroup = \"a\"\nnormal_stiffness = 1e6\n",
                                {"contact_defaults.gap=2e-4"});
  EXPECT_EQ(gap_of(study.contacts[0]), 2e-4);
}

TEST(ContactDefaults, ArePartOfTheInputs) {
  const Folder folder;
  const auto text = [&](const std::string& gap) {
    return canonical_text(folder.write("study.toml", mesh + "[contact_defaults]\ngap = " + gap + "\n" + two),
                          {}, {"contacts"});
  };
  EXPECT_NE(text("1e-4"), text("2e-4"));
}

TEST(ContactDefaults, OfOneContactAreRefused) {
  EXPECT_NE(message_of(mesh + "[contact_defaults]\ngroup = \"a\"\n" + two)
                .find("study.toml:4: contact_defaults.group: belongs to one contact"),
            std::string::npos);
  EXPECT_NE(
      message_of(mesh + "[contact_defaults]\ngap = 1\n").find("has no [[contacts]] that would take them"),
      std::string::npos);
  EXPECT_NE(message_of(mesh + "[contact_defaults]\ngpa = 1\n" + two).find("did you mean \"gap\""),
            std::string::npos);
}

TEST(Clearance, OfADrilledHoleIsRadial) {
  const std::string drilled =
      mesh +
      "[[contacts]]\ngroup = \"a\"\nobstacle = \"drilled\"\nnormal_stiffness = 1e6\ntube_radius = 0.01\n";
  const Study study = read_text(drilled + "clearance = 2e-4\n");
  EXPECT_EQ(gap_of(study.contacts[0]), 2e-4);
  EXPECT_EQ(study.contacts[0].tube_radius, 0.01);
  EXPECT_NE(message_of(drilled + "clearance = 2e-4\nhole_radius = 0.0102\n").find("keep one"),
            std::string::npos);
  EXPECT_NE(message_of(drilled).find("hole_radius"), std::string::npos);
}

TEST(Loads, HaveNames) {
  const std::string load =
      contact("[[loads]]\nname = \"turbulence\"\ngroup = \"p\"\ndirection = [1, 0, 0]\nconstant = 1\n");
  EXPECT_EQ(read_text(load).loads[0].name, "turbulence");
  EXPECT_EQ(read_text(load, {"loads.turbulence.constant=5"}).loads[0].function,
            signals::TimeFunction(signals::Constant{5}));
}

} // namespace
} // namespace fretwork::study::contact_defaults_test
