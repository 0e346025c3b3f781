// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/contact_table.hpp"
#include "results/contact_position.hpp"
#include "results/figures.hpp"
#include "results/text_file.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace fretwork::results {
namespace {

constexpr std::size_t contact_width = 18; // of a contact
constexpr std::size_t most_contacts = 12; // shown one by one; of more, the ten with the largest work rate
constexpr std::size_t most_flat = 4;      // of those shown
constexpr double micro = 1e6;             // um in a metre

/// The cells of a row, as text.
struct Cells {
  std::string name, impacts, closed, normal_rms, normal_max, tangential_max, radius, penetration, work,
      friction;
};

std::string row(const Cells& c) {
  return fmt::format("  {:<18} {:>7} {:>7} {:>11} {:>7} {:>7} {:>8} {:>6} {:>13} {:>13}", c.name, c.impacts,
                     c.closed, c.normal_rms, c.normal_max, c.tangential_max, c.radius, c.penetration, c.work,
                     c.friction);
}

std::string contact_row(const ContactFacts& facts, const post::ContactSummary& c) {
  return row({.name = shortened(facts.name, contact_width),
              .impacts = grouped(c.impacts),
              .closed = fmt::format("{:.2f}", 100.0 * c.contact_time_ratio),
              .normal_rms = with_error(c.normal_rms, c.error.normal_rms),
              .normal_max = figure(c.normal_max, 3),
              .tangential_max = figure(without_round_off(c.tangential_max, c.normal_max), 3),
              .radius = flat_position_of(facts, c) ? "flat" : figure(micro * c.radial_max, 4),
              .penetration = figure(micro * c.penetration_max, 3),
              .work = with_error(c.work_rate, c.error.work_rate),
              .friction = with_error(c.friction_power, c.error.friction_power)});
}

std::string sums_row(const RunResults& results) {
  std::int64_t impacts = 0;
  double work = 0.0, friction = 0.0;
  for (const post::ContactSummary& c : results.contact_summaries) {
    impacts += c.impacts;
    work += c.work_rate;
    friction += c.friction_power;
  }
  const post::StandardErrors& e = results.errors_of_sums;
  Cells cells;
  cells.name = "all contacts";
  cells.impacts = grouped(impacts);
  cells.work = with_error(work, e.work_rate);
  cells.friction = with_error(friction, e.friction_power);
  return row(cells);
}

/// Of a flat obstacle, um: "100"; where the two sides differ at rest "60 and 140", the negative one first.
std::string gap_text(const ContactFacts& facts) {
  const auto unequal = unequal_clearances_of(facts);
  return unequal ? fmt::format("{} and {}", figure(micro * unequal->negative, 3),
                               figure(micro * unequal->positive, 3))
                 : figure(micro * facts.gap, 4);
}

/// Normal position and sliding of the flat obstacles among those shown.
std::vector<std::string> flat_lines(const RunResults& results, const std::vector<std::size_t>& shown) {
  std::vector<std::string> lines;
  std::size_t left = 0;
  for (const std::size_t c : shown) {
    const ContactFacts& facts = results.contacts[c];
    const auto flat = flat_position_of(facts, results.contact_summaries[c]);
    if (!flat)
      continue;
    if (lines.size() == most_flat) {
      ++left;
      continue;
    }
    lines.push_back(fmt::format(
        "  {:<18} {:>14} {:>23} {:>23} {:>23}", shortened(facts.name, contact_width), gap_text(facts),
        fmt::format("{} to {}", figure(micro * flat->normal.min, 4), figure(micro * flat->normal.max, 4)),
        figure(micro * flat->normal.std, 3), figure(micro * (flat->sliding.max - flat->sliding.min), 4)));
  }
  if (!lines.empty())
    lines.insert(lines.begin(),
                 fmt::format("  {:<18} {:>14} {:>23} {:>23} {:>23}",
                             left > 0 ? fmt::format("flat, {} more", left) : "flat obstacles", "gap um",
                             "normal position um", "its deviation um", "range of sliding um"));
  return lines;
}

} // namespace

std::vector<std::string> contact_lines(const RunResults& results) {
  const auto& all = results.contact_summaries;
  std::vector<std::size_t> shown(all.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  const bool slide =
      std::any_of(all.begin(), all.end(), [](const post::ContactSummary& c) { return c.work_rate > 0.0; });
  const auto rank = [&](std::size_t c) { return slide ? all[c].work_rate : all[c].normal_max; };
  if (all.size() > most_contacts) {
    std::stable_sort(shown.begin(), shown.end(),
                     [&](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
    shown.resize(10);
  }
  std::vector<std::string> lines{row({"contact", "impacts", "closed%", "FN rms N", "FNmax N", "FTmax N",
                                      "r max um", "pen um", "work W", "friction W"})};
  for (const std::size_t c : shown)
    lines.push_back(contact_row(results.contacts[c], all[c]));
  if (shown.size() < all.size())
    lines.push_back(fmt::format("  the 10 of {} contacts with the largest {}", all.size(),
                                slide ? "work rate" : "normal force, where none slides"));
  if (all.size() > 1)
    lines.push_back(sums_row(results));
  const std::vector<std::string> flat = flat_lines(results, shown);
  lines.insert(lines.end(), flat.begin(), flat.end());
  return lines;
}

} // namespace fretwork::results
