// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpi_counter.hpp"
#include "core/mpi.hpp"

namespace fretwork::core {
namespace {

constexpr int counters = 2, owner = 0;

} // namespace

SharedCounters::SharedCounters(MPI_Comm comm) : comm_(comm) {
  const MPI_Aint bytes = rank(comm) == owner ? counters * static_cast<MPI_Aint>(sizeof(std::int64_t)) : 0;
  MPI_Win_allocate(bytes, sizeof(std::int64_t), MPI_INFO_NULL, comm, static_cast<void*>(&memory_), &window_);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
  if (rank(comm) == owner) {
    for (int i = 0; i < counters; ++i)
      memory_[i] = 0;
    MPI_Win_sync(window_);
  }
  MPI_Barrier(comm);
}

SharedCounters::~SharedCounters() {
  MPI_Win_unlock_all(window_);
  MPI_Win_free(&window_);
}

std::int64_t SharedCounters::add(int which, std::int64_t increment) {
  std::int64_t before = 0;
  MPI_Fetch_and_op(&increment, &before, MPI_INT64_T, owner, which, MPI_SUM, window_);
  MPI_Win_flush(owner, window_);
  return before;
}

void SharedCounters::progress() const {
  int found = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, comm_, &found, MPI_STATUS_IGNORE);
}

} // namespace fretwork::core
