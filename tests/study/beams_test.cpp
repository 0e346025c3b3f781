// SPDX-License-Identifier: GPL-3.0-or-later
// Sections that shear and turn, axial forces, and what changes along a group of beams.
#include "folder.hpp"
#include "study/study.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::beams_test {
namespace {

std::string with(const std::string& section, const std::string& beams) {
  return "[mesh]\nfile = \"a.msh\"\n[materials.m]\nyoung_modulus = 2e11\npoisson_ratio = 0.3\ndensity = "
         "7800\n"
         "[sections.s]\nshape = \"pipe\"\nouter_diameter = 0.04\nthickness = 0.005\n" +
         section +
         "[sections.thin]\nshape = \"pipe\"\nouter_diameter = 0.03\nthickness = 0.004\n"
         "[sections.bar]\nshape = \"rectangle\"\nheight_y = 0.1\nheight_z = 0.1\n"
         "[sections.slat]\nshape = \"rectangle\"\nheight_y = 0.2\nheight_z = 0.1\n"
         "[sections.free]\nshape = \"general\"\narea = 1\niy = 1\niz = 1\ntorsion_constant = 1\n"
         "[[beams]]\ngroup = \"g\"\nmaterial = \"m\"\n" +
         beams;
}

const std::string plain = "section = \"s\"\n";

fem::Section section(const std::string& keys) { return read_text(with(keys, plain)).sections.at("s"); }
void expect_message(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = message_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\"\nlacks: " << part;
}

Beams beams(const std::string& keys) { return read_text(with("", keys)).beams.at(0); }

TEST(ReadSections, ShearAndTurnOnlyWhereAsked) {
  EXPECT_EQ(section("").shear, fem::Shear{});
  EXPECT_FALSE(section("").rotary_inertia);
  EXPECT_EQ(section("shear = false\n").shear, fem::Shear{});
  EXPECT_EQ(section("shear = true\n").shear, fem::Shear(fem::ShapeShear{}));
  const fem::Shear given(fem::ShearCoefficients{0.5, 0.6});
  EXPECT_EQ(section("shear_coefficient_y = 0.5\nshear_coefficient_z = 0.6\n").shear, given);
  EXPECT_EQ(section("shear = true\nshear_coefficient_y = 0.5\nshear_coefficient_z = 0.6\n").shear, given);
  EXPECT_TRUE(section("rotary_inertia = true\n").rotary_inertia);
}

TEST(ReadSections, TellsWhatMakesNoShear) {
  expect_message(with("shear_coefficient_y = 0.5\n", plain),
                 {"sections.s.shear_coefficient_y = 0.5: one coefficient only; give both"});
  expect_message(with("shear_coefficient_y = 0\nshear_coefficient_z = 0.6\n", plain),
                 {"sections.s.shear_coefficient_y = 0: a number > 0"});
  expect_message(with("shear = false\nshear_coefficient_y = 1\nshear_coefficient_z = 1\n", plain),
                 {"sections.s.shear_coefficient_y = 1: of no effect with shear = false"});
  expect_message(
      with("[sections.other]\nshape = \"general\"\narea = 1\niy = 1\niz = 1\ntorsion_constant = 1\n"
           "shear = true\n",
           plain),
      {"sections.other.shear = true: there is no formula for this shape; give shear_coefficient_y"});
}

TEST(ReadBeams, TakesAnAxialForce) { EXPECT_EQ(beams(plain + "axial_force = -250\n").axial_force, -250.0); }

TEST(ReadBeams, TakesAnAxialForceThatChangesAlongTheGroup) {
  const Beams read = beams(plain + "axial_force = [-250, 40]\nfrom = \"root\"\n");
  EXPECT_EQ(read.axial_force, -250.0);
  ASSERT_TRUE(read.taper);
  EXPECT_EQ(read.taper->axial_force, 40.0);
  EXPECT_EQ(read.taper->section, read.section);
  expect_message(with("", plain + "axial_force = [-250, 40]\n"), {"axial_force", "two values need from"});
}

TEST(ReadBeams, TakesPairsFromAnEnd) {
  const Beams read = beams("section = [\"s\", \"thin\"]\nadded_mass = [0.1, 0.3]\nfluid_inside = [0, 700]\n"
                           "fluid_outside = { density = [1000, 900], confinement = 2 }\nfrom = \"root\"\n");
  EXPECT_EQ(read.section, "s");
  EXPECT_EQ(read.added_mass, 0.1);
  EXPECT_EQ(read.fluid, (fem::Fluid{0.0, 1000.0, 2.0}));
  ASSERT_TRUE(read.taper);
  EXPECT_EQ(read.taper->from, "root");
  EXPECT_EQ(read.taper->section, "thin");
  EXPECT_EQ(read.taper->added_mass, 0.3);
  EXPECT_EQ(read.taper->fluid, (fem::Fluid{700.0, 900.0, 2.0}));
}

TEST(ReadBeams, TellsWhatMakesNoTaper) {
  expect_message(with("", "section = [\"s\", \"thin\"]\n"),
                 {"beams.g.section = [\"s\", \"thin\"]: two values need from, the physical point"});
  expect_message(with("", plain + "added_mass = [0, 1]\n"),
                 {"beams.g.added_mass = [0, 1]: two values need from"});
  expect_message(with("", plain + "fluid_outside = { density = [1, 2] }\n"),
                 {"beams.g.fluid_outside.density = [1, 2]: two values need from"});
  expect_message(with("", "section = [\"s\", \"s\", \"s\"]\nfrom = \"p\"\n"),
                 {"beams.g.section", "the name of a [sections.name], or two of them, is expected"});
  expect_message(with("", "section = [\"s\", \"bar\"]\nfrom = \"p\"\n"),
                 {"beams.g.section", "the two differ in shape, in shear or in rotary_inertia"});
  expect_message(with("", "section = [\"s\", \"thi\"]\nfrom = \"p\"\n"),
                 {"there is no [sections.thi]; did you mean \"thin\"?"});
  expect_message(with("", plain + "added_mass = [0, -1]\nfrom = \"p\"\n"), {"beams.g.added_mass", "-1"});
  expect_message(
      with("", "section = [\"bar\", \"slat\"]\nfrom = \"p\"\n"),
      {"beams.g.orientation: this required key is missing", "the section \"slat\" has different iy and iz"});
  expect_message(with("", "section = \"free\"\nfluid_outside = { density = 1 }\n"),
                 {"the section \"free\" is neither a pipe nor a circle"});
}

} // namespace
} // namespace fretwork::study::beams_test
