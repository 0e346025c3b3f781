// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/child_process.hpp"
#include <gtest/gtest.h>

using fretwork::core::run_child;

TEST(ChildProcess, GivesStatusAndBothOutputs) {
  const auto result = run_child({"sh", "-c", "echo out; echo err >&2; exit 7"});
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(result.output, "out\nerr\n");
}

TEST(ChildProcess, TellsASignal) { EXPECT_EQ(run_child({"sh", "-c", "kill -SEGV $$"}).status, 128 + 11); }

TEST(ChildProcess, TellsAMissingProgram) {
  const auto result = run_child({"no-such-program-anywhere"});
  EXPECT_EQ(result.status, 127);
  EXPECT_NE(result.output.find("no-such-program-anywhere"), std::string::npos);
}

TEST(ChildProcess, ReadsMoreThanAPipeHolds) {
  EXPECT_EQ(run_child({"sh", "-c", "head -c 1000000 /dev/zero | tr '\\0' x"}).output.size(), 1000000u);
}
