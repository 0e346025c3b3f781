// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random loads and motions of a study that are one signal: those of one seed and band.
#pragma once
#include "study/study.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace fretwork::app {

/// A random load or motion, and the first before it that follows the same signal.
struct SharedSignal {
  std::string first, second; ///< what messages call them
  std::uint64_t seed;
};
[[nodiscard]] std::vector<SharedSignal> shared_signals(const study::Study& study);

/// `A and B follow one random signal: they have the same seed 1 and band`
[[nodiscard]] std::string text_of(const SharedSignal& shared);

} // namespace fretwork::app
