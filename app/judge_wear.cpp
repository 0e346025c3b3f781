// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/judge_wear.hpp"
#include "core/names.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace fretwork::app {
namespace {

using results::WearOfSupport;

constexpr std::size_t most_worn_named = 3; ///< in a message

/// One warning for all supports of which something is true.
template <class True>
void warn(results::RunResults& out, True is_true,
          const std::function<std::string(const WearOfSupport&)>& text) {
  std::vector<std::string> names;
  const WearOfSupport* first = nullptr;
  for (const auto& support : out.wear->supports)
    if (is_true(support)) {
      names.push_back(support.name);
      first = first ? first : &support;
    }
  if (first)
    out.warnings.push_back(
        fmt::format("wear of {}: {}", core::list_names(names, most_worn_named), text(*first)));
}

void warn_of_depths(results::RunResults& out) {
  warn(
      out, [](const WearOfSupport& s) { return !s.outside.empty(); },
      [](const WearOfSupport& s) { return s.outside; });
  warn(
      out, [](const WearOfSupport& s) { return s.share_above > 0.0; },
      [](const WearOfSupport& s) {
        return fmt::format("{:.3g} % of the time in contact is above force_max or speed_max and in no class "
                           "of kwu_epri; give larger ones",
                           100.0 * s.share_above);
      });
  warn(
      out, [](const WearOfSupport& s) { return s.initial_depth >= s.limit; },
      [](const WearOfSupport& s) {
        return fmt::format(
            "initial_wear = {:.3g} is at or above limit = {:.3g}: no life is left; give a higher limit "
            "where one is allowed",
            s.initial_depth / s.wall, s.limit / s.wall);
      });
  warn(
      out,
      [](const WearOfSupport& s) {
        return s.initial_depth > 0.0 && !s.support_depth.value.empty() &&
               s.support_depth.value.front() >= s.support_limit;
      },
      [](const WearOfSupport& s) {
        return fmt::format(
            "the support reaches support_limit ({:.3g} mm) before the tube reaches initial_wear, where it "
            "has lost {:.3g} mm; check support_coefficient and support_limit",
            1e3 * s.support_limit, 1e3 * s.support_depth.value.front());
      });
  warn(
      out, [](const WearOfSupport& s) { return s.depth.last().value > s.wall; },
      [](const WearOfSupport& s) {
        return fmt::format("after {:.4g} years the depth is {:.3g} mm and the wall {:.3g} mm: the tube is "
                           "worn through before; depths beyond the wall are those of a solid body",
                           s.time.back() / wear::year, 1e3 * s.depth.last().value, 1e3 * s.wall);
      });
  warn(
      out, [](const WearOfSupport& s) { return s.outside.empty() && std::isnan(s.depth.last().value); },
      [](const WearOfSupport& s) {
        return fmt::format("{:.3g} m3 after {:.4g} years have no depth, the scar leaves what geometry \"{}\" "
                           "describes; give fewer years",
                           s.volume.last().value, s.time.back() / wear::year, s.geometry);
      });
}

/// m; a depth that is no number is beyond the geometry, and so deeper than all others.
double depth_about_corners(const WearOfSupport& support) {
  return std::isnan(support.corner_depth) ? HUGE_VAL : support.corner_depth;
}

/// Whether corners of lands have a share of the work that matters, and scars about them would be deeper.
bool is_deeper_at_corners(const WearOfSupport& support) {
  constexpr double least_share = 0.05, least_excess = 1.05; // of the work, of the depth
  return support.corner_share > least_share &&
         depth_about_corners(support) > least_excess * support.depth.last().value;
}

std::string depth_text(double depth) {
  return std::isnan(depth) ? std::string("beyond its geometry") : fmt::format("{:.3g} mm", 1e3 * depth);
}

std::string years_text(double years) {
  return std::isnan(years)   ? std::string("unknown years")
         : std::isinf(years) ? std::string("never")
                             : fmt::format("{:.3g} years", years);
}

/// With the deepest of the scars about corners.
void note_corners(results::RunResults& out) {
  std::vector<std::string> names;
  const WearOfSupport* deepest = nullptr;
  for (const WearOfSupport& s : out.wear->supports)
    if (is_deeper_at_corners(s)) {
      names.push_back(s.name);
      if (!deepest || depth_about_corners(s) > depth_about_corners(*deepest))
        deepest = &s;
    }
  if (!deepest)
    return;
  out.notes.push_back(fmt::format(
      "wear of {}: {:.0f} % of the work of \"{}\" is at corners of lands, where scars are deeper. Its depth "
      "after {:.4g} years is {} about the middles of lands and at most {} about corners, its life {} and at "
      "least {}",
      core::list_names(names, most_worn_named), 100.0 * deepest->corner_share, deepest->name,
      deepest->time.back() / wear::year, depth_text(deepest->depth.last().value),
      depth_text(deepest->corner_depth), years_text(deepest->life.years.value),
      years_text(deepest->corner_years)));
}

/// Of tubes that are worn already: in which time the work rates would have worn as much.
void note_initial_wear(results::RunResults& out) {
  std::vector<std::string> names;
  std::vector<const WearOfSupport*> worn_so; // by that time
  for (const WearOfSupport& s : out.wear->supports)
    if (s.initial_depth > 0.0) {
      names.push_back(s.name);
      if (!std::isnan(s.initial_years))
        worn_so.push_back(&s);
    }
  if (names.empty())
    return;
  const auto [first, last] = std::minmax_element(worn_so.begin(), worn_so.end(),
                                                 [](const WearOfSupport* one, const WearOfSupport* other) {
                                                   return one->initial_years < other->initial_years;
                                                 });
  const auto at = [](const WearOfSupport& s) {
    return fmt::format("in {:.3g} years at \"{}\"", s.initial_years, s.name);
  };
  std::string when = worn_so.empty() ? "" : at(**first);
  if (worn_so.size() > 1)
    when += ", " + at(**last);
  if (const std::size_t never = names.size() - worn_so.size(); never > 0)
    when += fmt::format("{}never at {} of {}", when.empty() ? "" : ", ", never, names.size());
  out.notes.push_back(
      fmt::format("wear of {} goes on from initial_wear, at the gaps of the study; years count from "
                  "there; the work rates would have worn as much {}",
                  core::list_names(names, most_worn_named), when));
}

bool combines_states(const study::Wear& entry) {
  return entry.states.size() > 1 || entry.states.front().given || entry.states.front().results;
}

/// W, the largest work rate of a support that wears, by tubes.
std::map<std::size_t, double> largest_rates(const results::Wear& wear) {
  std::map<std::size_t, double> out;
  for (const WearOfSupport& support : wear.supports)
    if (support.tube >= 0) {
      double& largest = out[static_cast<std::size_t>(support.tube)];
      largest = std::max(largest, support.work_rate.value);
    }
  return out;
}

void warn_of_unworn(const std::vector<WornPlace>& places, const std::vector<PlacedContact>& placed,
                    results::RunResults& out) {
  std::vector<bool> wears(placed.size(), false);
  for (const WornPlace& place : places)
    for (const std::size_t c : place.contacts)
      wears[c] = true;
  std::map<std::string, double> left_out; // W, of supports: all points of a thickness
  for (std::size_t c = 0; c < placed.size(); ++c)
    if (!wears[c])
      left_out[placed[c].support] += out.contact_summaries[c].work_rate;
  const std::map<std::size_t, double> worn = largest_rates(*out.wear);
  const std::string* name = nullptr;
  double rate = 0.0, of_tube = 0.0; // W
  for (std::size_t c = 0; c < placed.size(); ++c) {
    if (wears[c])
      continue;
    const double own = left_out.at(placed[c].support);
    for (const core::Index node : {placed[c].node, placed[c].other})
      if (const auto structure = modal::structure_of(out.bases, node))
        if (const auto tube = worn.find(*structure);
            tube != worn.end() && own > std::max(tube->second, rate)) {
          name = &placed[c].support;
          rate = own;
          of_tube = tube->second;
        }
  }
  if (name)
    out.warnings.push_back(
        fmt::format("no [[wear]] names \"{}\", whose work rate of {:.3g} mW is above that of all supports of "
                    "its tube that wear ({:.3g} mW): the shortest life of these need not be that of the tube",
                    *name, 1e3 * rate, 1e3 * of_tube));
}

} // namespace

void judge_wear(const study::Study& study, const std::vector<WornPlace>& places,
                const std::vector<PlacedContact>& placed, results::RunResults& out) {
  if (!out.wear)
    return;
  warn_of_depths(out);
  note_corners(out);
  note_initial_wear(out);
  if (std::none_of(study.wear.begin(), study.wear.end(), combines_states))
    warn_of_unworn(places, placed, out);
}

} // namespace fretwork::app
