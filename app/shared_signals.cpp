// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shared_signals.hpp"
#include "app/build_fields.hpp"
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace fretwork::app {
namespace {

/// Random functions of the study with the names that messages have for them.
std::vector<std::pair<std::string, const signals::Random*>> random_functions(const study::Study& study) {
  std::vector<std::pair<std::string, const signals::Random*>> out;
  const auto add = [&](std::string name, const signals::TimeFunction& function) {
    if (const auto* random = std::get_if<signals::Random>(&function))
      out.emplace_back(std::move(name), random);
  };
  for (std::size_t e = 0; e < study.loads.size(); ++e)
    add(name_of_load(study.loads[e], e), study.loads[e].function);
  for (std::size_t e = 0; e < study.base_motions.size(); ++e)
    add(fmt::format("[[base_motion]] entry {}", e + 1), study.base_motions[e].acceleration);
  for (std::size_t e = 0; e < study.support_motions.size(); ++e)
    add(name_of_support_motion(study.support_motions[e], e), study.support_motions[e].function);
  return out;
}

} // namespace

std::vector<SharedSignal> shared_signals(const study::Study& study) {
  std::map<std::tuple<std::uint64_t, double, double>, std::string>
      signals; // seed and band: the first of them
  std::vector<SharedSignal> out;
  for (const auto& [name, random] : random_functions(study)) {
    const auto [first, is_new] = signals.try_emplace({random->seed, random->low, random->high}, name);
    if (!is_new)
      out.push_back({first->second, name, random->seed});
  }
  return out;
}

std::string text_of(const SharedSignal& shared) {
  return fmt::format("{} and {} follow one random signal: they have the same seed {} and band", shared.first,
                     shared.second, shared.seed);
}

} // namespace fretwork::app
