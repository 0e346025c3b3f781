// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/text_file.hpp"
#include "results/wear_json.hpp"
#include <fmt/format.h>
#include <iterator>
#include <numbers>

namespace fretwork::results {
namespace {

constexpr const char* curve_suffix = "_wear.csv";
constexpr const char* sector_suffix = "_wear_sectors.csv";
constexpr const char* sides_suffix = "_wear_sides.csv";
constexpr const char* opening_name = "gap_opening.csv";

/// A text cell: between quotes, those in it doubled.
std::string cell(const std::string& text) {
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string value_and_bounds(const Bounds& b) { return fmt::format("{},{},{}", b.value, b.low, b.high); }

std::string bounds_head(const char* name, const char* unit) {
  return fmt::format("{0} [{1}],{0}_low [{1}],{0}_high [{1}]", name, unit);
}

/// Figures of one scar: work rate; volumes and depths; sizes and life.
struct ScarCells {
  std::string rate, depths, sizes;
};

ScarCells cells_of(const WornScar& s) {
  return {value_and_bounds({s.work_rate.value, s.work_rate.low, s.work_rate.high}),
          fmt::format("{},{},{},{}", value_and_bounds(s.volume.last()), value_and_bounds(s.depth.last()),
                      value_and_bounds(s.support_volume.last()), value_and_bounds(s.support_depth.last())),
          fmt::format("{},{},{},{},{},{},{},{}", s.scar_width, s.scar_length, s.life.end,
                      value_and_bounds(s.life.years), s.support_life.end,
                      value_and_bounds(s.support_life.years), s.initial_depth, s.initial_years)};
}

ScarCells scar_heads() {
  return {bounds_head("work_rate", "W"),
          fmt::format("{},{},{},{}", bounds_head("volume", "m3"), bounds_head("depth", "m"),
                      bounds_head("support_volume", "m3"), bounds_head("support_depth", "m")),
          fmt::format("scar_width [m],scar_length [m],life_end,{},support_life_end,{},initial_depth "
                      "[m],initial_years [years]",
                      bounds_head("life", "years"), bounds_head("support_life", "years"))};
}

std::string sides_text(const WearOfSupport& s) {
  const ScarCells heads = scar_heads();
  std::string text = fmt::format("side,{},{},{}\n", heads.rate, heads.depths, heads.sizes);
  for (const WearOfSide& side : s.sides) {
    const ScarCells cells = cells_of(side);
    text += fmt::format("{},{},{},{}\n", side.name, cells.rate, cells.depths, cells.sizes);
  }
  return text;
}

std::string supports_text(const Wear& wear) {
  const ScarCells heads = scar_heads();
  std::string text = fmt::format("support,tube,law,coefficient [m2/N],source,{},geometry,{},{}\n", heads.rate,
                                 heads.depths, heads.sizes);
  for (const WearOfSupport& s : wear.supports) {
    const ScarCells cells = cells_of(s);
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", cell(s.name), s.tube, s.law, s.coefficient,
                        cell(s.source), cells.rate, s.geometry, cells.depths, cells.sizes);
  }
  return text;
}

std::string curves_text(const WearOfSupport& s) {
  std::string text =
      fmt::format("time [s],{},{},{},{}\n", bounds_head("volume", "m3"), bounds_head("depth", "m"),
                  bounds_head("support_volume", "m3"), bounds_head("support_depth", "m"));
  for (std::size_t i = 0; i < s.time.size(); ++i) {
    text += fmt::format("{}", s.time[i]);
    for (const WearCurves* c : {&s.volume, &s.depth, &s.support_volume, &s.support_depth})
      text += ',' + value_and_bounds({c->value[i], c->low[i], c->high[i]});
    text += '\n';
  }
  return text;
}

std::string sectors_text(const WearOfSupport& s) {
  const bool deep = !s.sector_depth.empty();
  std::string text = "from [rad],to [rad],work_rate [W]";
  text += deep ? ",depth [m],support_depth [m]\n" : "\n";
  const auto n = static_cast<double>(s.sector_rates.size());
  for (std::size_t k = 0; k < s.sector_rates.size(); ++k) {
    const auto angle = [&](double at) { return std::numbers::pi * (2.0 * at / n - 1.0); };
    text += fmt::format("{},{},{}", angle(static_cast<double>(k)), angle(static_cast<double>(k) + 1.0),
                        s.sector_rates[k]);
    text += deep ? fmt::format(",{},{}\n", s.sector_depth[k], s.sector_support_depth[k]) : "\n";
  }
  return text;
}

std::string opening_text(const Wear& wear) {
  std::string text = fmt::format("support,stage,end [s],gap [m],{},{},{}\n", bounds_head("work_rate", "W"),
                                 bounds_head("depth", "m"), bounds_head("support_depth", "m"));
  for (std::size_t s = 0; s < wear.opening->supports.size(); ++s) {
    const OpenedSupport& opened = wear.opening->supports[s];
    for (std::size_t i = 0; i < wear.opening->time.size(); ++i) {
      text += fmt::format("{},{},{},{}", cell(wear.supports[s].name), i + 1, wear.opening->time[i],
                          opened.gap[i]);
      for (const WearCurves* c : {&opened.work_rate, &opened.depth, &opened.support_depth})
        text += ',' + value_and_bounds({c->value[i], c->low[i], c->high[i]});
      text += '\n';
    }
  }
  return text;
}

} // namespace

bool is_wear_csv(const std::string& file_name) {
  return file_name == "wear.csv" || file_name == opening_name || file_name.ends_with(curve_suffix) ||
         file_name.ends_with(sector_suffix) || file_name.ends_with(sides_suffix);
}

void export_wear_csv(const std::filesystem::path& directory, const Wear& wear) {
  write_text(directory / "wear.csv", supports_text(wear));
  if (wear.opening)
    write_text(directory / opening_name, opening_text(wear));
  for (const WearOfSupport& s : wear.supports) {
    write_text(directory / (path_name(s.name) + curve_suffix), curves_text(s));
    write_text(directory / (path_name(s.name) + sector_suffix), sectors_text(s));
    if (!s.sides.empty())
      write_text(directory / (path_name(s.name) + sides_suffix), sides_text(s));
  }
}

} // namespace fretwork::results
