// SPDX-License-Identifier: GPL-3.0-or-later
// The motion that a run found under its fluidelastic laws: lines of the terminal.
#include "core/names.hpp"
#include "results/figures.hpp"
#include "results/flow_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>

namespace fretwork::results {
namespace {

constexpr std::size_t most_laws_shown = 4, most_tubes_named = 3;
constexpr double milli = 1e3;
constexpr double least_share = 1e-3; // relative: a smaller error, and a smaller power, is left out

std::string place_text(const LawMotion::Place& place, const LawAtWork& law) {
  std::string text = fmt::format(
      "{} \"{}\" moves along {}{} by {} mm rms, {} mm at most ({:.2g} % of the diameter)",
      place.contact ? "contact" : "node", place.name, place.axis, place.contact ? "_loc" : "",
      figure(milli * place.rms, 3), figure(milli * place.largest, 3), 100.0 * place.largest / law.diameter);
  if (place.frequency)
    text += fmt::format(", at {:.4g} Hz, V/(f D) = {:.3g}", *place.frequency,
                        law.reduced_velocity(*place.frequency));
  return text;
}

std::string growth_text(const post::Growth& growth) {
  return growth.significant ? fmt::format("STILL GROWS by {} 1/s", with_error(growth.rate, growth.error))
                            : std::string("does not grow");
}

std::string motion_text(const LawAtWork& law) {
  const LawMotion& motion = *law.motion;
  std::string text = core::list_names(law.tubes, most_tubes_named) + ", unstable without contacts: " +
                     (motion.place ? place_text(*motion.place, law) : "no contact or observed node moves");
  return motion.growth ? text + "; " + growth_text(*motion.growth) : text;
}

/// Without what is less than a thousandth of the largest power.
std::string power_text(const LawMotion& motion) {
  const post::PowerBalance& p = motion.power;
  double least = 0.0;
  for (const post::MeanPower& one :
       {p.loads, p.fluid, p.modal_damping, p.contact_damping, p.friction, p.stored})
    least = std::max(least, least_share * std::abs(one.mean));
  const auto shown = [&](const char* name, const post::MeanPower& one) {
    const double mean = milli * one.mean, error = milli * one.error;
    if (!(std::abs(one.mean) > least || one.error > least))
      return std::string();
    return fmt::format("{} {}", name,
                       error > least_share * std::abs(mean) ? with_error(mean, error) : figure(mean, 4));
  };
  const auto sum = [&](std::initializer_list<std::string> terms) {
    std::string text;
    for (const std::string& term : terms)
      if (!term.empty())
        text += (text.empty() ? "" : " + ") + term;
    return text.empty() ? std::string("0") : text;
  };
  return fmt::format(
      "{}, powers in mW: {} = {}", core::list_names(motion.tubes, most_tubes_named),
      sum({shown("fluid", p.fluid), shown("loads", p.loads)}),
      sum({shown("modal damping", p.modal_damping), shown("contact damping", p.contact_damping),
           shown("friction", p.friction), shown("stored", p.stored)}));
}

} // namespace

std::vector<std::string> law_motion_lines(const RunResults& results) {
  std::vector<std::string> out, stable;
  std::vector<std::vector<std::string>> balanced; // tubes whose powers have been shown
  std::size_t unstable = 0;
  for (const LawAtWork& law : results.laws) {
    if (!law.motion) {
      stable.insert(stable.end(), law.tubes.begin(), law.tubes.end());
      continue;
    }
    if (++unstable > most_laws_shown)
      continue;
    out.push_back(motion_text(law));
    if (std::find(balanced.begin(), balanced.end(), law.motion->tubes) != balanced.end())
      continue;
    balanced.push_back(law.motion->tubes);
    out.push_back(power_text(*law.motion));
  }
  if (unstable > most_laws_shown)
    out.push_back(fmt::format("and {} more in summary.json", unstable - most_laws_shown));
  if (!stable.empty())
    out.push_back(core::list_names(stable, most_tubes_named) + ": stable without contacts");
  return out;
}

} // namespace fretwork::results
