// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/modal_truncation.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::app {
namespace {

/// Whether the load acts on a node of the structure.
bool acts_on(const Fields::Load& load, const modal::Basis& basis) {
  return std::any_of(basis.nodes.begin(), basis.nodes.end(), [&](core::Index node) {
    return !load.force.segment<6>(6 * static_cast<Eigen::Index>(node)).isZero(0.0);
  });
}

/// Share of the power of a load above a frequency, Hz; its highest frequency is above it.
double share_above(const signals::TimeFunction& function, double frequency) {
  const auto* random = std::get_if<signals::Random>(&function);
  return random ? (random->high - std::max(random->low, frequency)) / (random->high - random->low) : 1.0;
}

std::string asked_for(const study::Modes& modes) {
  if (modes.up_to_hz)
    return fmt::format("modes.up_to_hz = {:g}", *modes.up_to_hz);
  return fmt::format("modes.count = {}{}", *modes.count, modes.number_given ? "" : ", the default");
}

} // namespace

double end_of_modes(const study::Modes& modes, const modal::Basis& basis) {
  if (basis.complete)
    return std::numeric_limits<double>::infinity();
  return modes.up_to_hz ? *modes.up_to_hz
                        : basis.omega.head(basis.true_modes()).maxCoeff() / (2.0 * std::numbers::pi);
}

std::string load_band_warning(const study::Study& study, const std::vector<modal::Basis>& bases,
                              const std::vector<Fields::Load>& loads) {
  if (study.modes.accuracy)
    return {};
  const Fields::Load* worst = nullptr;
  double highest = 0.0, reach = 0.0, beyond = 1.0;
  for (const Fields::Load& load : loads) {
    const double frequency = signals::highest_frequency(load.function);
    for (const modal::Basis& basis : bases)
      if (const double limit = end_of_modes(study.modes, basis);
          frequency > beyond * limit && acts_on(load, basis)) {
        worst = &load;
        highest = frequency;
        reach = limit;
        beyond = frequency / limit;
      }
  }
  if (!worst)
    return {};
  return fmt::format(
      "modal truncation: {} acts with up to {:.4g} Hz, but the modes end at {:.4g} Hz ({}); {:.0f} % "
      "of its power excites no mode, contact forces may be wrong by more; set modes.up_to_hz = "
      "{:.3g}, or modes.accuracy = 0.01 where contacts need more",
      worst->name, highest, reach, asked_for(study.modes), 100.0 * share_above(worst->function, reach),
      modes_above_loads * highest);
}

std::string more_modes(const study::Study& study) {
  return study.modes.accuracy
             ? fmt::format("set modes.accuracy below {:g}, or a higher modes.up_to_hz", *study.modes.accuracy)
             : "ask for more modes (modes.accuracy = 0.01 takes as many as the contacts need)";
}

std::string missing_flexibility_warning(const study::Study& study, const std::vector<BuiltScene>& scenes) {
  std::vector<std::string> names;
  double most = 0.0;
  std::string worst;
  std::size_t all = 0;
  for (const BuiltScene& built : scenes) {
    all += built.contacts.size();
    names.insert(names.end(), built.truncated.begin(), built.truncated.end());
    if (!built.truncated.empty() && built.lacking > most) {
      most = built.lacking;
      worst = built.lacking_at;
    }
  }
  if (names.empty())
    return {};
  return fmt::format(
      "modal truncation: the modes lack flexibility at {} of {} contact{}, up to {:.2g}/K_N (\"{}\"); "
      "their forces are too high, peaks by up to a factor {:.2g}; set modes.static_modes = "
      "\"all\", or {}",
      names.size(), all, all == 1 ? "" : "s", most, worst, std::sqrt(1.0 + most), more_modes(study));
}

} // namespace fretwork::app
