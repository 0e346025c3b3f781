// SPDX-License-Identifier: GPL-3.0-or-later
// [[support_motion]] and obstacles that supports carry.
#include "core/error.hpp"
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::support_motion_test {
namespace {

const std::string mesh = "[mesh]\nfile = \"a.msh\"\n";
const std::string motion = "[[support_motion]]\ngroup = \"plate\"\ndirection = [0, 0, 2]\n";
const std::string contact = "[[contacts]]\ngroup = \"p\"\ngap = 1e-3\nnormal_stiffness = 1e6\n";

std::string refused(const std::string& text) {
  try {
    (void)read_text(mesh + text);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no error";
}

void expect_refused(const std::string& text, const std::string& part) {
  const std::string message = refused(text);
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(ReadSupportMotion, TakesAccelerationsAndDisplacements) {
  const Study study = read_text(mesh + motion + "constant = 1.5\nvelocity0 = -0.5\ndisplacement0 = 0.25\n" +
                                motion + "quantity = \"displacement\"\ntable = [[0, 0], [1, 2]]\n");
  ASSERT_EQ(study.support_motions.size(), 2u);
  const SupportMotion &a = study.support_motions[0], &b = study.support_motions[1];
  EXPECT_EQ(a.group, "plate");
  EXPECT_EQ(a.direction, Vec3(0, 0, 1));
  EXPECT_FALSE(a.by_displacement);
  EXPECT_EQ(a.function, signals::TimeFunction(signals::Constant{1.5}));
  EXPECT_EQ(a.velocity0, -0.5);
  EXPECT_EQ(a.displacement0, 0.25);
  EXPECT_TRUE(b.by_displacement);
  EXPECT_EQ(b.function, signals::TimeFunction(signals::Table{{0, 1}, {0, 2}}));
}

TEST(ReadSupportMotion, CarriesObstacles) {
  const auto carrier = [](const std::string& more) {
    return read_text(mesh + motion + "constant = 1.5\n" + contact + more).contacts.at(0).carrier;
  };
  EXPECT_FALSE(carrier(""));
  EXPECT_FALSE(carrier("attached_to = \"ground\"\n"));
  EXPECT_EQ(carrier("attached_to = \"plate\"\n"), "plate");
  expect_refused(motion + "constant = 1.5\n" + contact + "attached_to = \"plat\"\n",
                 "contacts.p.attached_to = \"plat\": unknown; did you mean \"plate\"? available: \"base\", "
                 "\"ground\", \"plate\"");
}

TEST(ReadSupportMotion, RefusesWhatCannotBeMoved) {
  const std::string displacement = motion + "quantity = \"displacement\"\n";
  expect_refused(displacement + "random = { rms = 1, band = [1, 2] }\n",
                 "a random displacement is not available");
  expect_refused(displacement + "table = [[0, 0], [1, 0], [1, 2]]\n", "a jump of displacement");
  expect_refused(displacement + "constant = 1\nvelocity0 = 1\n", "says by itself how the support starts");
  expect_refused(displacement + "constant = 1\ndisplacement0 = 1\n", "says by itself how the support starts");
  expect_refused(motion + "quantity = \"speed\"\nconstant = 1\n",
                 "available: \"acceleration\", \"displacement\"");
  expect_refused(motion, "no time function");
  expect_refused("[[support_motion]]\ngroup = \"plate\"\nconstant = 1\n", "support_motion.plate.direction");
}

TEST(ReadSupportMotion, IsPartOfTheInputs) {
  const Folder folder;
  folder.write("s.csv", "0,0\n1,2\n");
  const std::string file = motion + "table = \"s.csv\"\n", rows = motion + "table = [[0, 0], [1, 2]]\n";
  EXPECT_EQ(canonical_text(folder.write("a.toml", file), {}, {"support_motion"}),
            canonical_text(folder.write("b.toml", rows), {}, {"support_motion"}));
}

} // namespace
} // namespace fretwork::study::support_motion_test
