// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/totals.hpp"
#include "results/write.hpp"
#include <fmt/format.h>

namespace fretwork::results {
namespace {

constexpr std::size_t most_modes = 60;

std::string shares(const core::Vec3& masses, const core::Vec3& whole) {
  std::string text;
  for (int d = 0; d < 3; ++d)
    text += fmt::format(" {:>8.3f}", whole[d] > 0.0 ? 100.0 * masses[d] / whole[d] : 0.0);
  return text;
}

} // namespace

std::string modes_table(const RunResults& results) {
  core::Vec3 whole = core::Vec3::Zero(), kept = core::Vec3::Zero();
  for (const modal::Basis& basis : results.bases) {
    whole += basis.moving_mass;
    kept += basis.participation.topRows(basis.true_modes()).colwise().squaredNorm().transpose();
  }
  const std::vector<ModeOf> modes = sorted_modes(results.bases);
  std::string text = fmt::format(
      "  {:>5} {:>9} {:>14} {:>10} {:>11}   effective mass, % of {:.4g}, {:.4g}, {:.4g} kg: x y z\n", "mode",
      "structure", "Hz", "damping %", "mesh error", whole.x(), whole.y(), whole.z());
  for (std::size_t k = 0; k < std::min(most_modes, modes.size()); ++k) {
    const auto& [structure, mode, frequency] = modes[k];
    const modal::Basis& basis = results.bases[structure];
    text += fmt::format("  {:>5} {:>9} {:>14.8g} {:>10.3g} {:>11.1e} {}\n", k + 1, structure, frequency,
                        100.0 * basis.damping(mode), basis.error(mode),
                        shares(basis.participation.row(mode).cwiseAbs2().transpose(), whole));
  }
  if (modes.size() > most_modes)
    text += fmt::format("  ... {} more in summary.json\n", modes.size() - most_modes);
  text += fmt::format("  {:<53} {}\n", "all modes together", shares(kept, whole));
  for (const auto& [structure, mode, frequency] : sorted_static_modes(results.bases))
    text += fmt::format("  {:>5} {:>9} {:>14.8g} {:>10.3g}\n", "static", structure, frequency,
                        100.0 * results.bases[structure].damping(mode));
  return text;
}

} // namespace fretwork::results
