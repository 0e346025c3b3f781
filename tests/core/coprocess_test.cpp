// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coprocess.hpp"
#include <gtest/gtest.h>

namespace fretwork::core {
namespace {

const std::vector<std::string> environment{"PATH=/usr/bin:/bin", "WORD=hello"};
const std::function<void()> nothing = [] {};

TEST(Coprocess, AnswersLineByLineInTheGivenEnvironment) {
  Coprocess echo({"sh", "-c", "while read -r line; do echo \"$WORD $line\"; done"}, environment);
  for (const char* line : {"one", "two words"}) {
    echo.write(line);
    EXPECT_EQ(echo.read(nothing), std::string("hello ") + line);
  }
}

TEST(Coprocess, LinesMayBeLongAndComeTogether) {
  constexpr std::size_t length = 1'000'000; // more than a socket holds
  Coprocess echo({"sh", "-c", "read -r line; echo \"$line\"; echo second"}, environment);
  const std::string line(length, 'x');
  echo.write(line);
  EXPECT_EQ(echo.read(nothing), line);
  EXPECT_EQ(echo.read(nothing), "second");
}

TEST(Coprocess, SaysHowAProgramEnded) {
  Coprocess crashes({"sh", "-c", "read -r line; kill -SEGV $$"}, environment);
  crashes.write("go");
  EXPECT_EQ(crashes.read(nothing), std::nullopt);
  EXPECT_EQ(crashes.end(), "signal 11 (SIGSEGV)");
  Coprocess ends({"sh", "-c", "exit 7"}, environment);
  EXPECT_EQ(ends.read(nothing), std::nullopt);
  ends.write("which nobody reads"); // is no signal to this process
  EXPECT_EQ(ends.end(), "exit status 7");
  Coprocess absent({"no-such-program-anywhere"}, environment);
  EXPECT_EQ(absent.read(nothing), std::nullopt);
  EXPECT_EQ(absent.end(), "exit status 127");
}

TEST(Coprocess, WhileItWaitsOtherWorkGoesOn) {
  int calls = 0;
  Coprocess slow({"sh", "-c", "sleep 0.5; echo done"}, environment);
  EXPECT_EQ(slow.read([&] { ++calls; }), "done");
  EXPECT_GE(calls, 1);
}

} // namespace
} // namespace fretwork::core
