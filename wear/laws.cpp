// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/laws.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include "wear/kwu_epri.hpp"
#include "wear/root.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::wear {

namespace {

constexpr double sum_of_shares = 1e-9; ///< shares are given to a few digits and must not lose a second a year

WornVolume steady(double rate) { return {rate, rate, 0.0}; }

LawResult apply_to(const Archard& law, std::span<const OperatingState> states) {
  double work_rate = 0.0;
  for (const auto& state : states)
    work_rate += state.share * state.work_rate;
  return {steady(law.coefficient * work_rate), {}};
}

LawResult apply_to(const EdfMz& law, std::span<const OperatingState> states) {
  double initial = 0.0;
  for (const auto& state : states)
    initial += state.share * law.a * std::pow(state.work_rate, law.b);
  if (initial < law.s)
    return {{},
            OutsideLaw{
                "edf_mz", "V0", initial, law.s, 0,
                fmt::format("edf_mz does not apply: its initial rate V0 = A W^b = {:.4g} m3/s is below its "
                            "final rate S = {:.4g} m3/s; it needs a work rate of at least {:.4g} W: take "
                            "archard with a coefficient",
                            initial, law.s, least_work_rate(law))}};
  return {WornVolume{initial, law.s, law.n}, {}};
}

LawResult apply_to(const KwuEpri& law, std::span<const OperatingState> states) {
  double rate = 0.0;
  for (std::size_t j = 0; j < states.size(); ++j) {
    const auto& state = states[j];
    if (!(state.work_rate > 0.0) || !(state.share > 0.0))
      continue; // at rest: nothing wears, and there are no indices
    if (!state.indices)
      throw core::Error(
          fmt::format("kwu_epri: operating state {} has no impact and sliding indices; count the "
                      "classes of its contact forces and speeds, or take archard",
                      j + 1));
    check_not_negative("kwu_epri", "impact index Si", state.indices->impact, "");
    check_not_negative("kwu_epri", "sliding index Sg", state.indices->sliding, "");
    if (state.indices->impact < state.indices->sliding)
      return {{},
              OutsideLaw{
                  "kwu_epri", "Si", state.indices->impact, state.indices->sliding, j,
                  fmt::format("kwu_epri does not apply: in operating state {} the impact index Si = {:.4g} "
                              "is below the sliding index Sg = {:.4g}: take archard with a coefficient",
                              j + 1, state.indices->impact, state.indices->sliding)}};
    rate += state.share * law.coefficient * combined_index(*state.indices) * state.work_rate;
  }
  return {steady(rate), {}};
}

} // namespace

std::string_view name_of(const Law& law) {
  static constexpr std::array<std::string_view, 3> names = {"archard", "edf_mz", "kwu_epri"};
  static_assert(std::variant_size_v<Law> == names.size());
  return names[law.index()];
}

double WornVolume::at(double time) const {
  if (!(decay > 0.0))
    return initial_rate * time;
  return final_rate * time + (initial_rate - final_rate) * -std::expm1(-decay * time) / decay;
}

std::optional<double> WornVolume::time_of(double volume) const {
  if (!(volume > 0.0))
    return 0.0;
  if (!(initial_rate > 0.0))
    return std::nullopt;
  if (!(decay > 0.0) || initial_rate == final_rate)
    return volume / initial_rate;
  if (!(final_rate > 0.0)) {
    const double share = volume * decay / initial_rate; // of all that is ever worn
    return share < 1.0 ? std::optional(-std::log1p(-share) / decay) : std::nullopt;
  }
  // between the times of the initial and of the final rate, beyond round-off
  constexpr double wider = 1e-12;
  return root_of_positive([&](double time) { return at(time) - volume; },
                          volume / initial_rate * (1.0 - wider), volume / final_rate * (1.0 + wider));
}

std::optional<double> AgedVolume::time_of(double volume) const {
  if (volume <= before)
    return 0.0;
  const auto time = law.time_of(law.at(age) + volume - before);
  return time ? std::optional(*time - age) : time;
}

void check(const Law& law) {
  if (const auto* archard = std::get_if<Archard>(&law))
    return check_not_negative("archard", "coefficient", archard->coefficient, "m2/N");
  if (const auto* kwu = std::get_if<KwuEpri>(&law))
    return check_not_negative("kwu_epri", "coefficient", kwu->coefficient, "m2/N");
  const auto& edf = std::get<EdfMz>(law);
  check_positive("edf_mz", "a", edf.a, "m3/s/W^b");
  check_positive("edf_mz", "b", edf.b, "");
  check_positive("edf_mz", "n", edf.n, "1/s");
  check_not_negative("edf_mz", "s", edf.s, "m3/s");
}

void check(std::span<const OperatingState> states) {
  if (states.empty())
    throw core::Error("wear: there is no operating state; give at least one with its share of the time");
  double sum = 0.0;
  for (std::size_t j = 0; j < states.size(); ++j) {
    const std::string where = fmt::format("operating state {}", j + 1);
    check_not_negative(where, "share of the time", states[j].share, "");
    check_not_negative(where, "work rate", states[j].work_rate, "W");
    sum += states[j].share;
  }
  if (std::abs(sum - 1.0) > sum_of_shares)
    throw core::Error(
        fmt::format("wear: the shares of the time of the {} operating states sum to {:.10g}, not to "
                    "1; add a state at rest (work rate 0) or change a share",
                    states.size(), sum));
}

LawResult worn_volume(const Law& law, std::span<const OperatingState> states) {
  check(law);
  check(states);
  return std::visit([&](const auto& one) { return apply_to(one, states); }, law);
}

LawResult worn_volume(const Law& law, double work_rate) {
  const OperatingState always{1.0, work_rate};
  return worn_volume(law, {&always, 1});
}

double least_work_rate(const EdfMz& law) { return std::pow(law.s / law.a, 1.0 / law.b); }

} // namespace fretwork::wear
