// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/growth.hpp"
#include "post/batch_means.hpp"
#include "wear/student.hpp"
#include <array>
#include <cmath>
#include <numeric>

namespace fretwork::post {
namespace {

constexpr std::size_t compared_blocks = 16, fewest_in_block = 4;
constexpr double growth_probability = 0.99;
constexpr double least_growth = 1.02; ///< of the rms: what statistics do not show

} // namespace

std::optional<Growth> amplitude_growth(std::span<const double> energies, double step) {
  const std::size_t length = energies.size() / (2 * compared_blocks);
  if (length < fewest_in_block)
    return {};
  const std::span<const double> used = energies.last(2 * compared_blocks * length);
  const auto sum = [&](std::size_t block) {
    const auto values = used.subspan(block * length, length);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  std::array<double, compared_blocks> lengths, logarithms;
  lengths.fill(1.0);
  for (std::size_t k = 0; k < compared_blocks; ++k) {
    const double before = sum(k), after = sum(compared_blocks + k);
    if (!(before > 0.0 && after > 0.0 && std::isfinite(before) && std::isfinite(after)))
      return {};
    logarithms[k] = 0.5 * std::log(after / before);
  }
  const double mean = std::accumulate(logarithms.begin(), logarithms.end(), 0.0) / compared_blocks,
               time = static_cast<double>(compared_blocks * length) * step,
               half = 0.5 * static_cast<double>(energies.size()) * step; // blocks may leave some out
  const BatchEstimate estimate = batch_means(lengths, logarithms);
  const double quantile =
      wear::student_factor(estimate.batches - 1.0, 2.0 * growth_probability - 1.0); // of one side
  return Growth{mean / time, estimate.error / time, std::exp(mean / time * half),
                mean > std::log(least_growth) && mean > quantile * estimate.error};
}

} // namespace fretwork::post
