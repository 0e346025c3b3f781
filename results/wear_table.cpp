// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/figures.hpp"
#include "results/text_file.hpp"
#include "results/wear_json.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numeric>
#include <utility>

namespace fretwork::results {
namespace {

constexpr std::size_t most_supports = 12; // shown one by one; of more, the ten with the shortest lives
constexpr std::size_t most_tubes = 5;
constexpr std::size_t support_width = 16;
constexpr double millimetre = 1e3, cubic_millimetre = 1e9;

/// Three digits; a time of which round-off is the reciprocal is "never".
std::string figure_of_wear(double value) { return value > 1.0 / shown_as_zero ? "never" : figure(value, 3); }

/// 0.12 (0.11 to 0.13); a dash where there is no value, "never" where it is not reached.
std::string with_bounds(const Bounds& b, double factor) {
  if (std::isnan(b.value))
    return "-";
  const std::string low = figure_of_wear(factor * b.low), high = figure_of_wear(factor * b.high);
  if (!(b.low < b.high) || low == high)
    return figure_of_wear(factor * b.value);
  return fmt::format("{} ({} to {})", figure_of_wear(factor * b.value), low, high);
}

using Row = std::array<std::string, 7>;

/// Columns as wide as their widest text, numbers to the right.
std::vector<std::string> aligned(const std::vector<Row>& rows) {
  std::array<std::size_t, 7> width{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      width[i] = std::max(width[i], row[i].size());
  std::vector<std::string> lines;
  for (const Row& row : rows) {
    lines.push_back(fmt::format("  {:<{}}", row.front(), width.front()));
    for (std::size_t i = 1; i + 1 < row.size(); ++i)
      lines.back() += fmt::format("  {:>{}}", row[i], width[i]);
    if (!row.back().empty())
      lines.back() += "  " + row.back();
  }
  return lines;
}

std::string law_text(const WearOfSupport& s) {
  return std::isnan(s.coefficient) ? s.law : fmt::format("{} {:.3g}", s.law, s.coefficient);
}

std::string years_text(const WearLife& life) {
  return life.end == "outside_law" ? "outside the law" : with_bounds(life.years, 1.0);
}

Row row(const std::string& name, const WornScar& s, const std::string& law) {
  return {name,
          figure_of_wear(s.work_rate.value),
          with_bounds({s.volume.last().value}, cubic_millimetre),
          with_bounds(s.depth.last(), millimetre),
          with_bounds({s.scar_width}, millimetre),
          years_text(s.life),
          law};
}

/// A support, and below it the scars of its sides that have a share of its volume worth a row.
void add_support(std::vector<Row>& rows, const WearOfSupport& s) {
  constexpr double least_share = 0.05;
  rows.push_back(row(shortened(s.name, support_width), s, law_text(s)));
  for (const WearOfSide& side : s.sides)
    if (!(side.volume.last().value < least_share * s.volume.last().value))
      rows.push_back(row("  " + text_of_side(side.name), side, ""));
}

/// What the supports themselves lose, and when they reach their limits, of those that wear.
void add_supports_themselves(std::vector<std::string>& lines, const Wear& wear,
                             const std::vector<std::size_t>& shown) {
  std::vector<Row> rows{
      {"the supports themselves", "K m2/N", "worn mm3", "depth mm", "years to their limit", "limit mm", ""}};
  for (const std::size_t number : shown) {
    const WearOfSupport& s = wear.supports[number];
    const bool limited = !s.support_life.end.empty();
    if (s.support_coefficient > 0.0 || limited)
      rows.push_back({shortened(s.name, support_width), fmt::format("{:.3g}", s.support_coefficient),
                      with_bounds({s.support_volume.last().value}, cubic_millimetre),
                      with_bounds(s.support_depth.last(), millimetre),
                      limited ? years_text(s.support_life) : "no limit",
                      limited ? fmt::format("{:.3g}", millimetre * s.support_limit) : "", ""});
  }
  if (rows.size() == 1)
    return;
  const std::vector<std::string> own = aligned(rows);
  lines.insert(lines.end(), own.begin(), own.end());
}

/// What the intervals of depth and years are; nothing where there is none.
void add_confidence(std::vector<std::string>& lines, const Wear& wear) {
  const auto has_interval = [](const WearOfSupport& s) { return s.work_rate.low < s.work_rate.high; };
  if (std::none_of(wear.supports.begin(), wear.supports.end(), has_interval))
    return;
  const std::optional<double> confidence = wear.supports.front().confidence;
  const bool alike = std::all_of(wear.supports.begin(), wear.supports.end(),
                                 [&](const WearOfSupport& s) { return s.confidence == confidence; });
  lines.push_back(
      !alike       ? "  in brackets: intervals of the confidence of each [[wear]], else +- one standard error"
      : confidence ? fmt::format("  in brackets: intervals of {:.4g} % confidence", 100.0 * *confidence)
                   : "  in brackets: +- one standard error of the work rate");
}

/// What the depths of tubes begin at that were worn before.
void add_initial_depths(std::vector<std::string>& lines, const Wear& wear) {
  std::vector<double> depths; // of scars, m
  std::size_t worn = 0;
  for (const WearOfSupport& s : wear.supports) {
    const std::size_t before = depths.size();
    const auto add = [&](const WornScar& scar) {
      if (scar.initial_depth > 0.0)
        depths.push_back(scar.initial_depth);
    };
    if (s.sides.empty())
      add(s);
    for (const WearOfSide& side : s.sides)
      add(side);
    worn += depths.size() > before ? 1 : 0;
  }
  if (worn == 0)
    return;
  const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
  const std::string from = fmt::format("{:.3g}", millimetre * *least),
                    to = fmt::format("{:.3g}", millimetre * *most);
  std::string line = "  depths begin at " + (from == to ? to : from + " to " + to) + " mm (initial_wear)";
  if (worn < wear.supports.size())
    line += fmt::format(" at {} of {} supports", worn, wear.supports.size());
  lines.push_back(line);
}

/// Where coefficients of a bank are from, each once.
void add_sources(std::vector<std::string>& lines, const Wear& wear) {
  std::vector<std::string> distinct;
  for (const WearOfSupport& s : wear.supports) {
    if (std::isnan(s.coefficient) || s.source == given_source)
      continue;
    const std::string line = fmt::format("  K = {:.3g} m2/N: {}", s.coefficient, s.source);
    if (std::find(distinct.begin(), distinct.end(), line) == distinct.end())
      distinct.push_back(line);
  }
  lines.insert(lines.end(), distinct.begin(), distinct.end());
}

/// Which support ends the life of a tube, and whose scar has no depth.
std::string remark_of(const WearOfTube& tube) {
  std::string out = tube.first.empty() ? "" : "first: " + shortened(tube.first, support_width);
  if (tube.body == "support")
    out += " (the support)";
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : "; ") + text; };
  if (tube.unknown_lives > 0)
    add(fmt::format("{} unknown", tube.unknown_lives));
  if (std::isnan(tube.depth.value) && !tube.deepest.empty())
    add("beyond its geometry: " + shortened(tube.deepest, support_width));
  return out;
}

/// Tubes of several supports, the shortest lives where there are many.
void add_tubes(std::vector<Row>& rows, const Wear& wear) {
  std::vector<WearOfTube> tubes;
  std::copy_if(wear.tubes.begin(), wear.tubes.end(), std::back_inserter(tubes),
               [](const WearOfTube& t) { return t.supports > 1; });
  if (tubes.size() > most_tubes) {
    std::stable_sort(tubes.begin(), tubes.end(), [](const WearOfTube& a, const WearOfTube& b) {
      return a.years.value < b.years.value || (std::isnan(b.years.value) && !std::isnan(a.years.value));
    });
    tubes.resize(most_tubes);
  }
  for (const WearOfTube& t : tubes)
    rows.push_back({wear.tubes.size() > 1 ? fmt::format("tube {}", t.tube) : "all supports",
                    figure_of_wear(t.work_rate.value), with_bounds({t.volume.value}, cubic_millimetre),
                    with_bounds(t.depth, millimetre), "", with_bounds(t.years, 1.0), remark_of(t)});
}

std::string end_text(const GapOpening& opening) {
  if (opening.end == "life_reached")
    return "a tube has lost its limit";
  if (opening.end == "geometry_stands")
    return "the geometry stands";
  if (opening.end == "horizon_reached")
    return "the end of the time";
  if (opening.end == "stage_failed")
    return "the next stage failed";
  if (opening.end == "stage_refused")
    return "the next stage was refused";
  return opening.end == "stages_used" ? "no more stages" : "beyond the geometry";
}

/// Below the tube's: the lives of supports that have a limit.
void add_opened_supports(std::vector<std::string>& lines, const Wear& wear,
                         const std::vector<std::size_t>& shown) {
  bool any = false;
  for (const std::size_t s : shown) {
    const OpenedSupport& o = wear.opening->supports[s];
    if (o.support_life.end.empty())
      continue;
    if (!std::exchange(any, true))
      lines.push_back(fmt::format("  {:<60} {:>22} {:>22}", "lives of the supports, with opened gaps",
                                  "depth mm", "years to their limit"));
    lines.push_back(fmt::format("  {:<60} {:>22} {:>22}", shortened(wear.supports[s].name, support_width),
                                with_bounds(o.support_depth.last(), millimetre), years_text(o.support_life)));
  }
}

/// Gap and work rate from the first stage to the last, depth at the end, life.
void add_opening(std::vector<std::string>& lines, const Wear& wear, const std::vector<std::size_t>& shown) {
  const GapOpening& opening = *wear.opening;
  if (opening.time.empty())
    return;
  lines.push_back(fmt::format("  gaps opened in {} up to {:.4g} years: {}",
                              counted(static_cast<std::int64_t>(opening.time.size()), "stage"),
                              opening.time.back() / fretwork::wear::year, end_text(opening)));
  lines.push_back(fmt::format("  {:<16} {:>18} {:>22} {:>22} {:>22}", "", "gap mm", "work W", "depth mm",
                              "years to the limit"));
  for (const std::size_t s : shown) {
    const OpenedSupport& o = opening.supports[s];
    lines.push_back(
        fmt::format("  {:<16} {:>18} {:>22} {:>22} {:>22}", shortened(wear.supports[s].name, support_width),
                    fmt::format("{:.3g} -> {:.3g}", millimetre * o.gap.front(), millimetre * o.gap.back()),
                    fmt::format("{:.3g} -> {:.3g}", o.work_rate.value.front(), o.work_rate.value.back()),
                    with_bounds(o.depth.last(), millimetre), years_text(o.life)));
  }
  add_opened_supports(lines, wear, shown);
}

} // namespace

std::vector<std::string> wear_lines(const Wear& wear) {
  std::vector<std::size_t> shown(wear.supports.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  const auto life = [&](std::size_t s) {
    const double years = first_life(wear.supports[s]).value;
    return std::isnan(years) ? std::numeric_limits<double>::infinity() : years;
  };
  if (shown.size() > most_supports) {
    std::stable_sort(shown.begin(), shown.end(), [&](auto a, auto b) { return life(a) < life(b); });
    shown.resize(10);
  }
  const bool alike = std::all_of(wear.supports.begin(), wear.supports.end(), [&](const WearOfSupport& s) {
    return s.time == wear.supports.front().time && s.limit == wear.supports.front().limit;
  });
  const WearOfSupport& first = wear.supports.front();
  std::vector<Row> rows = {
      {alike && !first.time.empty() ? fmt::format("in {:.4g} years", first.time.back() / fretwork::wear::year)
                                    : "wear",
       "work W", "worn mm3", "depth mm", "scar mm",
       alike ? fmt::format("years to {:.3g} mm", millimetre * first.limit) : "years to the limit",
       "law, m2/N"}};
  for (const std::size_t s : shown)
    add_support(rows, wear.supports[s]);
  const std::size_t supports_end = rows.size();
  add_tubes(rows, wear);
  std::vector<std::string> lines = aligned(rows);
  if (shown.size() < wear.supports.size())
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(supports_end),
                 fmt::format("  the 10 of {} supports with the shortest lives", wear.supports.size()));
  add_confidence(lines, wear);
  add_initial_depths(lines, wear);
  add_sources(lines, wear);
  if (wear.opening)
    add_opening(lines, wear, shown);
  add_supports_themselves(lines, wear, shown);
  return lines;
}

} // namespace fretwork::results
