// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Linear response to turbulence by spectra, as plain data.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::results {

/// One displacement.
struct ResponsePoint {
  std::string name;                              ///< of the observed node or the contact
  std::string direction;                         ///< x, y, z; of contacts y_loc, z_loc
  double rms = 0.0, rms_velocity = 0.0;          ///< m, m/s
  double up_crossings = 0.0, irregularity = 0.0; ///< 1/s; L2/sqrt(L0 L4)
  std::optional<double> maximum = std::nullopt;  ///< m; none where fewer than one up-crossing is expected
  double share_outside = 0.0;                    ///< of the variance, from outside the range of the spectra
  double share_above = 0.0; ///< what forces above the band would add to the variance, relative
};

struct LinearResponse {
  std::string name;
  std::vector<std::string> pinned; ///< names of the contacts at which the modes are held
  Eigen::Index modes = 0;
  double frequency = 0.0, damping = 0.0; ///< of the lowest mode: Hz, ratio to critical
  bool by_flow =
      false; ///< damping is that of tubes which their supports hold (flow/damping.hpp, set of stability)
  double duration = 0.0, probability = 0.0; ///< s; of the expected maxima
  std::vector<ResponsePoint> points;
};

} // namespace fretwork::results
