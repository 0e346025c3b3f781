// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/wear_file.hpp"
#include "contact/sides.hpp"
#include "results/text_file.hpp"
#include <algorithm>

namespace fretwork::results {
namespace {

struct NumberOf {
  const char* name;
  double WearOfSupport::*value;
};
constexpr NumberOf figures[] = {{"coefficient", &WearOfSupport::coefficient},
                                {"support_coefficient", &WearOfSupport::support_coefficient},
                                {"radius", &WearOfSupport::radius},
                                {"wall", &WearOfSupport::wall},
                                {"length", &WearOfSupport::length},
                                {"clearance", &WearOfSupport::clearance},
                                {"inclination", &WearOfSupport::inclination},
                                {"limit", &WearOfSupport::limit},
                                {"support_limit", &WearOfSupport::support_limit},
                                {"impact_index", &WearOfSupport::impact_index},
                                {"sliding_index", &WearOfSupport::sliding_index},
                                {"share_above", &WearOfSupport::share_above},
                                {"corner_share", &WearOfSupport::corner_share},
                                {"corner_depth", &WearOfSupport::corner_depth},
                                {"corner_years", &WearOfSupport::corner_years}};
struct SizeOf {
  const char* name;
  double WornScar::*value;
};
constexpr SizeOf scar_sizes[] = {{"initial_depth", &WornScar::initial_depth},
                                 {"initial_years", &WornScar::initial_years},
                                 {"scar_width", &WornScar::scar_width},
                                 {"scar_length", &WornScar::scar_length},
                                 {"scar_half_angle", &WornScar::scar_half_angle}};
constexpr const char* units =
    "coefficient, support_coefficient: m2/N; radius, wall, length, clearance, limit, support_limit, "
    "initial_depth, scar_width, "
    "scar_length, corner_depth: m; corner_years, initial_years: years; inclination, scar_half_angle: rad; "
    "work_rate (value, "
    "low, high): W; life_years, "
    "support_life_years (value, low, high): years, infinity: never";

struct TextOf {
  const char* name;
  std::string WearOfSupport::*value;
};
constexpr TextOf texts[] = {{"name", &WearOfSupport::name},
                            {"law", &WearOfSupport::law},
                            {"source", &WearOfSupport::source},
                            {"geometry", &WearOfSupport::geometry},
                            {"form", &WearOfSupport::form}};

struct CurvesOf {
  const char* name;
  const char* unit;
  WearCurves WornScar::*value;
};
constexpr CurvesOf curves[] = {{"volume", "m3", &WornScar::volume},
                               {"support_volume", "m3", &WornScar::support_volume},
                               {"depth", "m", &WornScar::depth},
                               {"support_depth", "m", &WornScar::support_depth}};

struct ListOf {
  const char* name;
  const char* unit;
  std::vector<double> WearOfSupport::*value;
};
constexpr ListOf lists[] = {{"time", "s", &WearOfSupport::time},
                            {"sector_work_rate", "W", &WearOfSupport::sector_rates},
                            {"sector_depth", "m", &WearOfSupport::sector_depth},
                            {"sector_support_depth", "m", &WearOfSupport::sector_support_depth}};

void write_rate(const h5::Group& group, const wear::WorkRate& w) {
  const double values[] = {w.value, w.low, w.high};
  group.set<double>("work_rate", values, {3});
  group.set("work_rate_has_interval", std::int64_t{w.has_interval});
  group.set("work_rate_low_at_zero", std::int64_t{w.low_at_zero});
}

std::array<double, 3> three(const h5::Group& group, const char* name) {
  const auto values = group.values<double>(name);
  if (values.size() != 3)
    throw h5::Failure(std::string(name) + " of wear");
  return {values[0], values[1], values[2]};
}

wear::WorkRate read_rate(const h5::Group& group) {
  const auto v = three(group, "work_rate");
  return {v[0], v[1], v[2], group.integer("work_rate_low_at_zero") != 0,
          group.integer("work_rate_has_interval") != 0};
}

void write_life(const h5::Group& group, const std::string& name, const WearLife& life) {
  const double values[] = {life.years.value, life.years.low, life.years.high};
  group.set<double>(name + "_years", values, {3});
  group.set(name + "_end", life.end);
}

WearLife read_life(const h5::Group& group, const std::string& name) {
  const auto v = three(group, (name + "_years").c_str());
  return {group.text(name + "_end"), {v[0], v[1], v[2]}};
}

/// n rows of value, low, high.
void write_curves(const h5::Group& group, const char* name, const char* unit, const WearCurves& c) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < c.value.size(); ++i)
    rows.insert(rows.end(), {c.value[i], c.low[i], c.high[i]});
  group.write<double>(name, rows, {c.value.size(), 3}, std::string(unit) + ": value, low, high");
}

WearCurves read_curves(const h5::Group& group, const char* name) {
  const auto rows = group.read<double>(name);
  if (rows.size() % 3 != 0)
    throw h5::Failure(std::string(name) + " of wear");
  WearCurves c;
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    c.value.push_back(rows[i]);
    c.low.push_back(rows[i + 1]);
    c.high.push_back(rows[i + 2]);
  }
  return c;
}

void write_states(const h5::Group& group, const std::vector<WearStateRate>& states) {
  const h5::Group all = group.create("states");
  for (std::size_t j = 0; j < states.size(); ++j) {
    const h5::Group state = all.create(std::to_string(j));
    state.set("name", states[j].name);
    state.set("share", states[j].share);
    write_rate(state, states[j].work_rate);
  }
}

void write_scar(const h5::Group& group, const WornScar& s) {
  group.set("outside_law", s.outside);
  for (const SizeOf& size : scar_sizes)
    group.set(size.name, s.*size.value);
  write_rate(group, s.work_rate);
  write_life(group, "life", s.life);
  write_life(group, "support_life", s.support_life);
  for (const CurvesOf& which : curves)
    write_curves(group, which.name, which.unit, s.*which.value);
  write_states(group, s.states);
}

void write_support(const h5::Group& group, const WearOfSupport& s, std::size_t index) {
  for (const TextOf& text : texts)
    group.set(text.name, s.*text.value);
  group.set("index", static_cast<std::int64_t>(index));
  group.set("node", s.node);
  group.set("tube", s.tube);
  for (const NumberOf& figure : figures)
    group.set(figure.name, s.*figure.value);
  group.set("units", std::string(units));
  group.write<std::int64_t>("contacts", s.contacts, {s.contacts.size()}, "numbers of contacts");
  write_scar(group, s);
  for (const ListOf& list : lists)
    if (!(s.*list.value).empty())
      group.write<double>(list.name, s.*list.value, {(s.*list.value).size()}, list.unit);
  if (s.sides.empty())
    return;
  const h5::Group sides = group.create("sides");
  for (const WearOfSide& side : s.sides)
    write_scar(sides.create(side.name), side);
}

/// @param times  number of instants of the curves, at least one
void read_scar(const h5::Group& group, std::size_t times, WornScar& s) {
  s.outside = group.text("outside_law");
  for (const SizeOf& size : scar_sizes)
    s.*size.value = group.number(size.name);
  s.work_rate = read_rate(group);
  s.life = read_life(group, "life");
  s.support_life = read_life(group, "support_life");
  for (const CurvesOf& which : curves) {
    s.*which.value = read_curves(group, which.name);
    if (const std::size_t length = (s.*which.value).value.size(); length != times || length == 0)
      throw h5::Failure(std::string(which.name) + " of wear of unequal length");
  }
  const h5::Group states = group.open("states");
  for (std::size_t j = 0; states.has(std::to_string(j)); ++j) {
    const h5::Group state = states.open(std::to_string(j));
    s.states.push_back({state.text("name"), state.number("share"), read_rate(state)});
  }
}

/// Depths by sector for all sectors or none.
void check_lengths(const WearOfSupport& s) {
  for (const auto* depth : {&s.sector_depth, &s.sector_support_depth})
    if (depth->size() != s.sector_depth.size() || (!depth->empty() && depth->size() != s.sector_rates.size()))
      throw h5::Failure("depths of wear by sector of unequal length");
}

WearOfSupport read_support(const h5::Group& group) {
  WearOfSupport s;
  for (const TextOf& text : texts)
    s.*text.value = group.text(text.name);
  s.node = group.integer("node");
  s.tube = group.integer("tube");
  for (const NumberOf& figure : figures)
    s.*figure.value = group.number(figure.name);
  s.contacts = group.read<std::int64_t>("contacts");
  for (const ListOf& list : lists)
    if (group.has(list.name))
      s.*list.value = group.read<double>(list.name);
  check_lengths(s);
  read_scar(group, s.time.size(), s);
  if (!group.has("sides"))
    return s;
  const h5::Group sides = group.open("sides");
  std::vector<std::string> names = sides.children();
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return contact::side_number(a) < contact::side_number(b);
  });
  for (const std::string& name : names) {
    WearOfSide& side = s.sides.emplace_back();
    side.name = name;
    read_scar(sides.open(name), s.time.size(), side);
  }
  return s;
}

struct OpenedCurves {
  const char* name;
  const char* unit;
  WearCurves OpenedSupport::*value;
};
constexpr OpenedCurves opened_curves[] = {{"work_rate", "W", &OpenedSupport::work_rate},
                                          {"depth", "m", &OpenedSupport::depth},
                                          {"support_depth", "m", &OpenedSupport::support_depth}};

void write_opening(const h5::Group& root, const Wear& wear) {
  const GapOpening& opening = *wear.opening;
  const h5::Group all = root.create("gap_opening");
  all.set("end", opening.end);
  all.set("reason", opening.reason);
  all.write<double>("time", opening.time, {opening.time.size()}, "s, at the end of each stage");
  const h5::Group supports = all.create("supports");
  for (std::size_t s = 0; s < opening.supports.size(); ++s) {
    const OpenedSupport& opened = opening.supports[s];
    const h5::Group group = supports.create(path_name(wear.supports[s].name));
    group.write<double>("gap", opened.gap, {opened.gap.size()}, "m, during each stage");
    for (const OpenedCurves& which : opened_curves)
      write_curves(group, which.name, which.unit, opened.*which.value);
    write_life(group, "life", opened.life);
    write_life(group, "support_life", opened.support_life);
  }
}

GapOpening read_opening(const h5::Group& root, const Wear& wear) {
  const h5::Group all = root.open("gap_opening"), supports = all.open("supports");
  GapOpening out{all.text("end"), all.text("reason"), all.read<double>("time"), {}};
  for (const WearOfSupport& s : wear.supports) {
    const h5::Group group = supports.open(path_name(s.name));
    OpenedSupport opened;
    opened.gap = group.read<double>("gap");
    for (const OpenedCurves& which : opened_curves)
      opened.*which.value = read_curves(group, which.name);
    opened.life = read_life(group, "life");
    opened.support_life = read_life(group, "support_life");
    for (const OpenedCurves& which : opened_curves)
      if ((opened.*which.value).value.size() != out.time.size() || opened.gap.size() != out.time.size())
        throw h5::Failure("stages of gap opening of unequal length");
    out.supports.push_back(std::move(opened));
  }
  return out;
}

} // namespace

void write_wear(const h5::Group& root, const Wear& wear) {
  const h5::Group all = root.create("wear");
  for (std::size_t s = 0; s < wear.supports.size(); ++s)
    write_support(all.create(path_name(wear.supports[s].name)), wear.supports[s], s);
  if (wear.opening)
    write_opening(root, wear);
}

Wear read_wear(const h5::Group& root) {
  const h5::Group all = root.open("wear");
  std::vector<std::pair<std::int64_t, std::string>> order;
  for (const std::string& name : all.children())
    order.emplace_back(all.open(name).integer("index"), name);
  std::sort(order.begin(), order.end());
  Wear wear;
  for (const auto& entry : order)
    wear.supports.push_back(read_support(all.open(entry.second)));
  wear.tubes = wear_by_tube(wear.supports);
  if (root.has("gap_opening"))
    wear.opening = read_opening(root, wear);
  return wear;
}

} // namespace fretwork::results
