// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <time.h>

namespace fretwork::bench {

/// Processor time of this thread, s: what others take of the processor does not count.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace fretwork::bench
