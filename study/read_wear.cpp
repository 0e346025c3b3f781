// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/contact_readers.hpp"
#include "study/readers.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::study {
namespace {

namespace fs = std::filesystem;

constexpr double sum_of_shares = 1e-9; ///< digits of shares that people write

const Keys wear_keys{{"name",
                      "contacts",
                      "one_support",
                      "law",
                      "coefficient",
                      "materials",
                      "coefficient_class",
                      "support_coefficient",
                      "constants",
                      "geometry",
                      "form",
                      "tube_radius",
                      "wall",
                      "length",
                      "clearance",
                      "half_angle",
                      "lands",
                      "inclination",
                      "limit",
                      "support_limit",
                      "initial_wear",
                      "years",
                      "confidence",
                      "sectors",
                      "states"}};

const Choices<WearGeometry> geometries{{{"obstacle", WearGeometry::obstacle},
                                        {"flat_bar", WearGeometry::flat_bar},
                                        {"drilled_hole", WearGeometry::drilled_hole},
                                        {"lands", WearGeometry::lands},
                                        {"ring", WearGeometry::ring},
                                        {"tube_on_tube", WearGeometry::tube_on_tube},
                                        {"sectors", WearGeometry::sectors}}};

enum class LawKind { archard, edf_mz, kwu_epri };

void read_contact_names(const TableReader& table, Wear& wear) {
  const Value* found = table.find("contacts");
  if (!found)
    return;
  const std::string path = table.path("contacts");
  if (!found->array())
    wear.contacts = {to_text(*found, path)};
  else
    for (const Value& name : to_array(*found, path, "names of contacts, or patterns with * and ?"))
      wear.contacts.push_back(to_text(name, path));
}

/// K of the tube: a value, or the pair of materials whose value the bank has.
double read_coefficient(const TableReader& table, Wear& wear) {
  const std::string help = "the coefficient of the tube in m2/N, or materials = \"690_405\" for a value of "
                           "the bank (doc/wear.md): it has no default";
  wear.materials = table.optional_text("materials");
  wear.coefficient_class = table.optional_text("coefficient_class");
  if (wear.materials && table.has("coefficient"))
    table.fail_at("materials", "coefficient and materials both give the coefficient; keep one");
  if (wear.coefficient_class && !wear.materials)
    table.fail_at("coefficient_class", "names the class of geometry in the bank; it belongs to materials");
  if (wear.materials)
    return 0.0;
  (void)table.required("coefficient", help);
  return table.number("coefficient", {Range::at_least_zero, "m2/N"});
}

fretwork::wear::EdfMz read_edf_mz(const TableReader& table) {
  for (const char* key : {"coefficient", "materials", "coefficient_class"})
    if (table.has(key))
      table.fail_at(key, "law = \"edf_mz\" has constants of its own; leave it out, or take \"archard\"");
  fretwork::wear::EdfMz law;
  const Value* found = table.find("constants");
  if (!found)
    return law;
  const TableReader constants(*found, table.path("constants"), {{"a", "b", "n", "s"}});
  law.a = constants.number_or("a", law.a, {Range::above_zero, "m3/s/W^b"});
  law.b = constants.number_or("b", law.b, {Range::above_zero});
  law.n = constants.number_or("n", law.n, {Range::above_zero, "1/s"});
  law.s = constants.number_or("s", law.s, {Range::at_least_zero, "m3/s"});
  return law;
}

void read_kwu_epri(const TableReader& table, Wear& wear) {
  const Value& found = table.required("constants", "{ k1, k2, force_max, speed_max }");
  const TableReader constants(found, table.path("constants"),
                              {{"k1", "k2", "k", "force", "force_max", "speed_max"}});
  wear.kwu.k1 = constants.number("k1", {Range::above_zero});
  wear.kwu.k2 = constants.number("k2", {Range::above_zero, "s2/N/m2"});
  wear.kwu.k = constants.number_or("k", wear.kwu.k, {Range::above_zero});
  wear.kwu.force = constants.number_or("force", wear.kwu.force, {Range::above_zero, "N"});
  wear.kwu_maxima.force = constants.number("force_max", {Range::above_zero, "N"});
  wear.kwu_maxima.speed = constants.number("speed_max", {Range::above_zero, "m/s"});
}

void read_law(const TableReader& table, Wear& wear) {
  const LawKind kind = table.choice(
      "law", LawKind::archard,
      Choices<LawKind>{
          {{"archard", LawKind::archard}, {"edf_mz", LawKind::edf_mz}, {"kwu_epri", LawKind::kwu_epri}}});
  switch (kind) {
  case LawKind::archard:
    if (table.has("constants"))
      table.fail_at("constants", "law = \"archard\" has only its coefficient; leave it out");
    wear.law = fretwork::wear::Archard{read_coefficient(table, wear)};
    break;
  case LawKind::edf_mz:
    wear.law = read_edf_mz(table);
    break;
  case LawKind::kwu_epri:
    wear.law = fretwork::wear::KwuEpri{read_coefficient(table, wear)};
    read_kwu_epri(table, wear);
    break;
  }
  wear.support_coefficient = table.number_or("support_coefficient", 0.0, {Range::at_least_zero, "m2/N"});
}

/// The sizes that a geometry has; those of the obstacle follow from the contact.
std::vector<std::string> sizes_of(WearGeometry geometry) {
  switch (geometry) {
  case WearGeometry::obstacle:
  case WearGeometry::flat_bar:
  case WearGeometry::tube_on_tube:
    return {"inclination"};
  case WearGeometry::drilled_hole:
    return {"inclination", "clearance"};
  case WearGeometry::lands:
    return {"inclination", "clearance", "half_angle", "lands"};
  case WearGeometry::sectors:
    return {"clearance"};
  case WearGeometry::ring:
    return {};
  }
  return {};
}

void read_geometry(const TableReader& table, Wear& wear) {
  wear.geometry = table.choice("geometry", WearGeometry::obstacle, geometries);
  const auto own = sizes_of(wear.geometry);
  for (const char* key : {"inclination", "clearance", "half_angle", "lands"})
    if (table.has(key) && std::find(own.begin(), own.end(), key) == own.end())
      table.fail_at(key, "does not belong to geometry = \"" + name_of(wear.geometry) +
                             "\"; leave it out, or take the geometry that has it");
  using fretwork::wear::Form;
  wear.form = table.choice("form", Form::exact,
                           Choices<Form>{{{"exact", Form::exact}, {"reference", Form::reference}}});
  if (wear.geometry == WearGeometry::sectors && table.has("form"))
    table.fail_at("form", "sectors have one form only; leave it out");
  if (wear.geometry == WearGeometry::sectors && !std::holds_alternative<fretwork::wear::Archard>(wear.law))
    table.fail_at("geometry", "sectors share the volume by their work, which only law = \"archard\" allows");
  for (const auto& [key, to] : {std::pair("tube_radius", &wear.tube_radius),
                                {"wall", &wear.wall},
                                {"length", &wear.length},
                                {"clearance", &wear.clearance}})
    *to = table.optional_number(key, {Range::above_zero, "m"});
  if (wear.geometry == WearGeometry::lands) {
    (void)table.required("half_angle",
                         "half of a land's angle at the middle of the hole, degrees; of a broached contact "
                         "geometry = \"obstacle\" takes it from land_angle");
    wear.half_angle = degree * table.number("half_angle", {Range::above_zero, "degrees"});
    wear.lands = read_lands(table, 4);
  }
  const double inclination = table.number_or("inclination", 0.0, {Range::at_least_zero, "degrees"});
  if (inclination >= 90.0)
    table.fail_at("inclination", "an angle below 90 degrees between tube and support is expected");
  wear.inclination = degree * inclination;
}

fretwork::wear::WorkRate read_work_rate(const TableReader& table) {
  const Value& found = *table.find("work_rate");
  if (!found.array())
    return fretwork::wear::work_rate(table.number("work_rate", {Range::at_least_zero, "W"}));
  const auto given = *table.optional_numbers("work_rate", 3, {Range::at_least_zero, "W"});
  if (!(given[0] <= given[1] && given[1] <= given[2]))
    table.fail_at("work_rate", "[lower end, value, upper end] of the interval is expected, in rising order");
  return fretwork::wear::work_rate_between(given[0], given[1], given[2]);
}

WearState read_state(const TableReader& table, const fs::path& folder, std::size_t number) {
  WearState state;
  state.share = table.number("share", {Range::at_least_zero});
  if (table.has("results") && table.has("work_rate"))
    table.fail_at("results", "results and work_rate both give the work rates of the state; keep one");
  if (const auto results = table.optional_text("results"))
    state.results = fs::absolute(folder / *results).lexically_normal();
  if (table.has("work_rate"))
    state.given = read_work_rate(table);
  const std::string otherwise = state.results ? state.results->filename().string()
                                : state.given ? fmt::format("state {}", number + 1)
                                              : "this run";
  state.name = table.optional_text("name").value_or(otherwise);
  return state;
}

void read_states(const TableReader& table, const fs::path& folder, Wear& wear) {
  const Value* found = table.find("states");
  if (!found)
    return;
  wear.states.clear();
  double sum = 0.0;
  int of_this_run = 0;
  const std::string path = table.path("states");
  const Array& items = to_array(*found, path, "operating states [{ share = 0.8 }, ...]");
  for (std::size_t i = 0; i < items.size(); ++i) {
    const TableReader state(items[i], fmt::format("{}[{}]", path, i),
                            {{"name", "share", "results", "work_rate"}});
    wear.states.push_back(read_state(state, folder, i));
    sum += wear.states.back().share;
    of_this_run += wear.states.back().results || wear.states.back().given ? 0 : 1;
  }
  if (of_this_run > 1)
    table.fail_at("states", "a state without results and work_rate is this run, which can be one of them "
                            "only; name the results folder of the others");
  if (std::abs(sum - 1.0) > sum_of_shares)
    table.fail_at(
        "states",
        fmt::format("the shares sum to {:g}; they are shares of the whole time: {}", sum,
                    sum < 1.0
                        ? fmt::format("add {{ share = {:g}, work_rate = 0 }} for time at rest", 1.0 - sum)
                        : "give smaller ones"));
  if (std::holds_alternative<fretwork::wear::KwuEpri>(wear.law) && (wear.states.size() > 1 || !of_this_run))
    table.fail_at("states", "law = \"kwu_epri\" takes the forces and speeds of this run; leave states out");
}

} // namespace

std::string name_of(WearGeometry geometry) {
  const auto& all = geometries.available;
  return std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.second == geometry; })
      ->first;
}

/// A share of the wall, or one by sides.
void read_initial_wear(const TableReader& table, Wear& wear) {
  const Value* found = table.find("initial_wear");
  if (!found)
    return;
  const auto share = [](const Value& value, const std::string& path) {
    const double out = value.string() ? 1.0 : to_number(value, path, {Range::at_least_zero});
    if (out >= 1.0) // "20%" and metres too
      fail(value, path, "a share of the wall below 1 is expected, such as 0.2 for 20 %");
    return out;
  };
  const std::string path = table.path("initial_wear");
  if (const Table* sides = found->table())
    for (const auto& [side, value] : *sides)
      wear.initial_wear_of[side] = share(value, path + "." + side);
  else
    wear.initial_wear = share(*found, path);
}

std::vector<Wear> read_wear(const TableReader& root, const fs::path& folder) {
  std::vector<Wear> all;
  std::string general;
  for (const Entry& entry : array_entries(root, "wear")) {
    const TableReader table(*entry.value, entry.path, wear_keys);
    Wear wear;
    wear.path = entry.path;
    if (!root.has("contacts"))
      table.fail_table("there are no [[contacts]] that could wear; add them, or leave [[wear]] out");
    wear.name = table.optional_text("name").value_or("");
    read_contact_names(table, wear);
    if (wear.contacts.empty() && !general.empty())
      table.fail_table("a second entry for all contacts that no other names (the first: " + general +
                       "); give contacts = \"name\"");
    if (wear.contacts.empty())
      general = entry.value->where.text();
    wear.one_support = table.optional_flag("one_support").value_or(false);
    if (wear.one_support && wear.name.empty())
      table.fail_at("one_support", "contacts that wear one scar need the name of their support; give name");
    read_law(table, wear);
    read_geometry(table, wear);
    wear.limit = table.number_or("limit", wear.limit, {Range::above_zero});
    if (wear.limit > 1.0)
      table.fail_at("limit", "a share of the wall of at most 1 is expected");
    wear.support_limit = table.optional_number("support_limit", {Range::above_zero, "m"});
    read_initial_wear(table, wear);
    wear.years = table.number_or("years", wear.years, {Range::above_zero, "years"});
    wear.confidence = table.optional_number("confidence", {Range::above_zero});
    if (wear.confidence && *wear.confidence >= 1.0)
      table.fail_at("confidence", "a share below 1 is expected, such as 0.95");
    const auto sectors = table.optional_integer("sectors", 1).value_or(wear.sectors);
    if (sectors > fretwork::wear::SectorWork::most)
      table.fail_at("sectors", "at most 3600 sectors, a tenth of a degree each, are expected");
    wear.sectors = static_cast<int>(sectors);
    read_states(table, folder, wear);
    all.push_back(wear);
  }
  return all;
}

std::optional<GapOpening> read_gap_opening(const TableReader& root, const std::vector<Wear>& wear) {
  const Value* found = root.find("gap_opening");
  if (!found)
    return {};
  const TableReader table(*found, "gap_opening",
                          {{"stages", "years", "gap_share", "wall_share", "least_wall_share"}});
  if (wear.empty())
    table.fail_table("there is no [[wear]] that could open gaps; add it, or leave [gap_opening] out");
  GapOpening out;
  out.stages = table.optional_integer("stages", 1).value_or(out.stages);
  out.years = 0.0;
  for (const Wear& entry : wear)
    out.years = std::max(out.years, entry.years);
  out.years = table.number_or("years", out.years, {Range::above_zero, "years"});
  out.gap_share = table.number_or("gap_share", out.gap_share, {Range::above_zero});
  out.wall_share = table.number_or("wall_share", out.wall_share, {Range::above_zero});
  out.least_wall_share = table.number_or("least_wall_share", std::min(out.least_wall_share, out.wall_share),
                                         {Range::above_zero});
  if (out.least_wall_share > out.wall_share)
    table.fail_at("least_wall_share", fmt::format("above wall_share = {:g}, of which it is the lower bound; "
                                                  "give at most as much",
                                                  out.wall_share));
  return out;
}

} // namespace fretwork::study
