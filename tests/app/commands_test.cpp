// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program.
#include "program.hpp"
#include <fmt/format.h>

namespace fretwork::app::test {
namespace {

TEST(Commands, HelpNamesThemAll) {
  const Workshop folder;
  const Outcome help = folder.fretwork({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"run", "mesh", "modes", "transient", "check", "report", "export"})
    EXPECT_TRUE(says(help.out, command));
}

} // namespace
} // namespace fretwork::app::test
