// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `[[turbulence]]` and `[[response]]` as typed, checked values: random forces of the flow along tubes, and what linear modes make of them.
#pragma once
#include "flow/patches.hpp"
#include "study/flow.hpp"
#include <cstdint>

namespace fretwork::study {

/// Two frequencies, Hz, 0 <= low < high.
struct Band {
  double low, high;
};

struct Turbulence {
  std::string name;
  std::vector<std::string> flows; ///< names; empty: all
  std::vector<std::string> zones; ///< names; empty: all with velocity that no other entry names
  flow::Spectrum spectrum; ///< of `two_phase` without the density of the liquid, which is that of the zone
  double correlation_length = 0.0; ///< m, > 0
  double lift = 1.0, drag = 1.0;   ///< weights of the spectrum, >= 0, one of them > 0
  flow::Scaling scaling = flow::Scaling::local;
  std::optional<double> running_velocity; ///< m/s, of zone_mean
  bool two_sided = false;
  std::optional<Band> band; ///< none: by the spectra
  std::uint32_t seed = 1;
  double ramp = 0.0; ///< s
};

struct Response {
  std::string name;
  Pinned pinned = Pinned::contacts;
  std::vector<std::string> contacts;            ///< of Pinned::named
  std::optional<double> damping = std::nullopt; ///< one ratio for all modes, instead of that of the study
  double duration = 3600.0;                     ///< s, of the expected maxima
  double probability = 0.5;                     ///< that they are not exceeded
};

} // namespace fretwork::study
