// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/vortex_shedding.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::flow {
namespace {

/// The nearest point of each zone; zone -1 where it has none.
std::vector<SheddingCoincidence> nearest(const Sampling& sampling, Eigen::Index mode, double strouhal) {
  std::vector<SheddingCoincidence> out(sampling.zones,
                                       SheddingCoincidence{static_cast<int>(mode), -1, 0, 0, 0});
  std::vector<double> least(sampling.zones, std::numeric_limits<double>::infinity());
  for (const Station& station : sampling.stations) {
    if (station.flow.phase != Phase::liquid || station.flow.velocity == 0.0)
      continue;
    const auto zone = static_cast<std::size_t>(station.flow.zone);
    const double shedding = strouhal * station.flow.velocity / station.tube.outer_diameter,
                 away = std::abs(sampling.frequency(mode) - shedding) / shedding;
    if (away >= least[zone])
      continue;
    least[zone] = away;
    out[zone] = {static_cast<int>(mode), away <= shedding_band ? station.flow.zone : -1, station.tube.s,
                 station.flow.velocity, shedding};
  }
  return out;
}

} // namespace

std::vector<SheddingCoincidence> shedding_coincidences(const Sampling& sampling, double strouhal) {
  if (!(strouhal > 0.0) || !std::isfinite(strouhal))
    throw core::Error(fmt::format("Strouhal number = {:g}; give a number > 0, that of the bundle", strouhal));
  std::vector<SheddingCoincidence> out;
  const Eigen::VectorXd share = transverse_share(sampling);
  for (Eigen::Index i = 0; i < sampling.modes(); ++i) {
    if (share(i) < least_transverse_share)
      continue;
    for (const SheddingCoincidence& it : nearest(sampling, i, strouhal))
      if (it.zone >= 0)
        out.push_back(it);
  }
  return out;
}

} // namespace fretwork::flow
