// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Numbers that ranks share by one-sided operations: no rank answers for another.
#pragma once
#include <cstdint>
#include <mpi.h>

namespace fretwork::core {

/// Two counters in the memory of rank 0, which any rank increases (MPI_Fetch_and_op). Collective to make and to end.
class SharedCounters {
public:
  explicit SharedCounters(MPI_Comm comm);
  ~SharedCounters();
  SharedCounters(const SharedCounters&) = delete;
  SharedCounters& operator=(const SharedCounters&) = delete;

  /// Increases a counter. @param which  0 or 1   @return its value before
  std::int64_t add(int which, std::int64_t increment);
  /// Lets operations of other ranks on this rank's memory advance, where the network does not do so by itself.
  void progress() const;

private:
  MPI_Comm comm_;
  MPI_Win window_ = MPI_WIN_NULL;
  std::int64_t* memory_ = nullptr;
};

} // namespace fretwork::core
