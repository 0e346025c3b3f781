// SPDX-License-Identifier: GPL-3.0-or-later
// Shared counters: whichever rank takes, every number is given once.
#include "core/mpi.hpp"
#include "core/mpi_counter.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace fretwork::core {
namespace {

TEST(SharedCounters, EveryNumberIsGivenOnce) {
  constexpr int numbers = 3000;
  std::vector<int> taken(numbers, 0), all(numbers, 0);
  {
    SharedCounters counters(MPI_COMM_WORLD);
    for (std::int64_t next = counters.add(0, 1); next < numbers; next = counters.add(0, 1)) {
      ++taken[static_cast<std::size_t>(next)];
      counters.add(1, 10);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(counters.add(1, 0), 10 * numbers); // the other counter is one of its own
    MPI_Barrier(MPI_COMM_WORLD);
  }
  MPI_Allreduce(taken.data(), all.data(), numbers, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(std::count(all.begin(), all.end(), 1), numbers);
}

} // namespace
} // namespace fretwork::core

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const fretwork::core::MpiSession mpi(argc, argv);
  return RUN_ALL_TESTS();
}
