// SPDX-License-Identifier: GPL-3.0-or-later
// A run takes the same memory however many steps it makes.
#include "program.hpp"
#include <sys/resource.h>

namespace fretwork::app::test::memory_test {
namespace {

/// kB: the largest of all child processes so far.
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss;
}

/// Half a second of the straight tube.
long peak_memory_with(const std::string& step, const std::string& every) {
  const Workshop folder;
  (void)folder.run(example("straight_tube"), "results",
                   {"--set", "transient.duration=0.5", "--set", "transient.step=" + step, "--set",
                    "output.statistics_from=0", "--set", "output.every=" + every});
  return peak_memory();
}

TEST(Memory, DoesNotGrowWithTheSteps) {
  constexpr long pages = 1024; // kB: what the loader and the allocator do differs from run to run
  const long few = peak_memory_with("1e-5", "1e-3"), many = peak_memory_with("2.5e-7", "1e-3");
  EXPECT_LT(many, few + pages); // two million steps more: a number kept of each would be 16 MB
  EXPECT_GT(peak_memory_with("1e-5", "1e-5"), many + pages) << "this test cannot see memory grow";
}

} // namespace
} // namespace fretwork::app::test::memory_test
