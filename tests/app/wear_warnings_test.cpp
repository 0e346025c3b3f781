// SPDX-License-Identifier: GPL-3.0-or-later
// What a run warns of its wear: depths that do not hold, and supports that were left out.
#include "worn_tubes.hpp"

namespace fretwork::app::test::wear_warnings_test {
namespace {

using namespace worn_tubes;

} // namespace

TEST(WearWarnings, BeyondTheWallIsTold) {
  const Workshop folder;
  const auto warnings = [&](const char* rate) {
    return with_given_rate(folder, archard, rate).summary["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings("0.05"), "mm and the wall 1.09 mm: the tube is worn through before"));
  EXPECT_FALSE(says(warnings("1e-4"), "worn through"));
}

TEST(WearWarnings, BeyondTheGeometryIsTold) {
  const Workshop folder;
  const Results run = with_given_rate(folder, archard, "10");
  EXPECT_TRUE(support(run)["depth_m"]["value"].is_null());
  EXPECT_GT(support(run)["volume_m3"]["value"], 0.0);
  EXPECT_EQ(support(run)["life_years"]["end"], "reached");
  EXPECT_TRUE(says(run.summary["warnings"].dump(), "have no depth, the scar leaves what geometry"));
}

// A life that leaves out the support that works most is not that of the tube. Other tubes have lives of their own.
TEST(WearWarnings, WarnsOfASupportWithoutAnEntryThatWorksMost) {
  const Workshop folder;
  const std::string study = worn_bundle(folder, 2, archard + "contacts = \"support0\"\n");
  const auto warned = [&](const std::string& text) {
    return says(folder.run_text(text).summary["warnings"].dump(), "no [[wear]] names \\\"inner\\\"");
  };
  const auto inner = [&](const std::string& gap) { // another hole at the same node
    return study +
           "[[contacts]]\nname = \"inner\"\ngroup = \"support0\"\naxis = [1.0, 0.0, 0.0]\ngap = " + gap +
           "\nnormal_stiffness = 1.0e6\ntangential_stiffness = 1.0e6\nfriction = 0.3\n";
  };
  EXPECT_TRUE(warned(inner("0.2e-5"))); // within the other, which does not touch
  EXPECT_FALSE(warned(inner("1.0e-4")));
  const std::string summary = folder.run_text(study).summary["warnings"].dump();
  EXPECT_FALSE(says(summary, "no [[wear]]")) << "support1 is that of another tube";
}

} // namespace fretwork::app::test::wear_warnings_test
