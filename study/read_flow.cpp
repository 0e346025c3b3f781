// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/flow_laws.hpp"
#include "study/flow_tables.hpp"
#include "study/readers.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

using enum Range;

const std::vector<std::string> single_phase_keys{"density", "viscosity"};
const std::vector<std::string> two_phase_keys{"liquid",        "gas",     "surface_tension",
                                              "void_fraction", "quality", "mass_flux"};

const Choices<flow::Phase> phases{{{"liquid", flow::Phase::liquid},
                                   {"gas", flow::Phase::gas},
                                   {"two_phase", flow::Phase::two_phase},
                                   {"none", flow::Phase::none}}};
const Choices<flow::Arrangement> arrangements{{{"single", flow::Arrangement::single},
                                               {"triangle", flow::Arrangement::triangle},
                                               {"rotated_triangle", flow::Arrangement::rotated_triangle},
                                               {"square", flow::Arrangement::square},
                                               {"rotated_square", flow::Arrangement::rotated_square}}};

/// A zone being read.
struct ZoneTable {
  const TableReader& table;
  const std::filesystem::path& folder;

  [[nodiscard]] flow::Table<double> values(const std::string& key, const Quantity& quantity) const {
    (void)table.required(key, "a number, rows [s, value] or a file of them");
    return read_flow_table(table, key, folder, quantity);
  }
  /// @throws core::Error for keys of the other kind of fluid
  void refuse(const std::vector<std::string>& keys, const std::string& problem) const {
    for (const std::string& key : keys)
      if (table.has(key))
        table.fail_at(key, problem);
  }
};

flow::SinglePhase read_single_phase(const ZoneTable& zone, flow::Phase phase) {
  zone.refuse(two_phase_keys, "belongs to phase = \"two_phase\"; leave it out, or give that phase");
  return {phase, zone.values("density", {above_zero, "kg/m3"}),
          zone.table.number("viscosity", {above_zero, "m2/s"})};
}

/// Density and viscosity of one phase.
void read_phase(const TableReader& zone, const char* key, double& density, double& viscosity) {
  (void)zone.required(key, "the density (kg/m3) and the viscosity (m2/s) of the phase: { density = ..., "
                           "viscosity = ... }");
  const TableReader phase(*zone.find(key), zone.path(key), {single_phase_keys});
  density = phase.number("density", {above_zero, "kg/m3"});
  viscosity = phase.number("viscosity", {above_zero, "m2/s"});
}

void check_share(const TableReader& zone, const char* key, const flow::Table<double>& share) {
  if (std::any_of(share.values.begin(), share.values.end(), [](double value) { return value > 1.0; }))
    zone.fail_at(key, "a share from 0 to 1 is expected");
}

flow::TwoPhase read_two_phase(const ZoneTable& zone) {
  const TableReader& table = zone.table;
  zone.refuse(single_phase_keys, "two-phase flow has those of its phases; give them in liquid and gas");
  flow::TwoPhase out;
  read_phase(table, "liquid", out.phases.liquid_density, out.phases.liquid_viscosity);
  read_phase(table, "gas", out.phases.gas_density, out.phases.gas_viscosity);
  if (out.phases.liquid_density <= out.phases.gas_density)
    table.fail_at("liquid", "its density is not above that of the gas; exchange the two");
  if (table.has("void_fraction") == table.has("quality"))
    table.fail_table("void_fraction or quality says how much of the flow is gas; give one of them");
  if (table.has("void_fraction")) {
    zone.refuse({"mass_flux", "surface_tension"}, "belongs to quality; leave it out");
    flow::GivenVoidFraction given{zone.values("void_fraction", {at_least_zero})};
    check_share(table, "void_fraction", given.alpha);
    out.content = std::move(given);
    return out;
  }
  flow::Quality quality{zone.values("quality", {at_least_zero})};
  check_share(table, "quality", quality.x);
  if (table.has("mass_flux")) {
    quality.mass_flux = zone.values("mass_flux", {above_zero, "kg/m2/s"});
    out.phases.surface_tension = table.number("surface_tension", {above_zero, "N/m"});
  } else {
    zone.refuse({"surface_tension"}, "belongs to mass_flux; give both, or leave it out");
  }
  out.content = std::move(quality);
  return out;
}

flow::Bundle read_bundle(const TableReader& zone) {
  flow::Bundle bundle{zone.choice("arrangement", flow::Arrangement::single, arrangements)};
  if (!flow::is_single(bundle))
    bundle.pitch = zone.number("pitch", {above_zero, "m"});
  else if (zone.has("pitch"))
    zone.fail_at("pitch", "a single tube has none; give arrangement, or leave it out");
  return bundle;
}

std::vector<double> read_connors(const TableReader& zone) {
  const Value* found = zone.find("connors_constant");
  if (!found)
    return {};
  if (!found->array())
    return {zone.number("connors_constant", {above_zero})};
  return to_numbers(*found, zone.path("connors_constant"), 0, {above_zero});
}

/// What every zone has.
flow::Extent read_extent(const TableReader& table, std::size_t number) {
  flow::Extent out{table.optional_text("name").value_or(std::to_string(number + 1)),
                   table.number_or("from", 0.0, {at_least_zero, "m"}),
                   table.optional_number("to", {above_zero, "m"}).value_or(end_of_tube)};
  if (out.to <= out.from)
    table.fail_at(table.has("to") ? "to" : "from", "a zone from " + std::to_string(out.from) + " m to " +
                                                       std::to_string(out.to) +
                                                       " m has no length; let to be larger");
  return out;
}

flow::Zone read_zone(const ZoneTable& zone, const flow::Extent& extent, flow::Phase phase) {
  const TableReader& table = zone.table;
  flow::Zone out{extent, {}, {}};
  out.velocity = read_velocity(table, zone.folder);
  if (phase == flow::Phase::two_phase)
    out.fluid = read_two_phase(zone);
  else
    out.fluid = read_single_phase(zone, phase);
  if (table.has("fluid_inside"))
    out.inner_density = zone.values("fluid_inside", {at_least_zero, "kg/m3"});
  out.bundle = read_bundle(table);
  if (table.has("mass_flux") && flow::is_single(out.bundle))
    table.fail_at("mass_flux", "the void fraction that follows from it is that of a bundle; give arrangement "
                               "and pitch, or leave it out");
  out.connors_constants = read_connors(table);
  return out;
}

/// Adds a zone to those with or without fluid.
void add_zone(Flow& out, const Entry& entry, std::size_t number, const std::filesystem::path& folder) {
  std::vector<std::string> of_fluids{"direction",   "velocity", "fluid_inside",
                                     "arrangement", "pitch",    "connors_constant"};
  for (const auto* more : {&single_phase_keys, &two_phase_keys})
    of_fluids.insert(of_fluids.end(), more->begin(), more->end());
  Keys keys{{"name", "from", "to", "phase"}};
  keys.known.insert(keys.known.end(), of_fluids.begin(), of_fluids.end());
  const TableReader table(*entry.value, entry.path, keys);
  const ZoneTable zone{table, folder};
  const flow::Extent extent = read_extent(table, number);
  const flow::Phase phase = table.choice("phase", flow::Phase::liquid, phases);
  if (phase != flow::Phase::none) {
    out.zones.push_back(read_zone(zone, extent, phase));
    return;
  }
  zone.refuse(of_fluids, "phase = \"none\" is a zone without fluid inside and outside; leave it out, or give "
                         "the phase of the fluid");
  out.dry.push_back(extent);
}

/// Entries of an array of tables inside an entry, with whole paths.
std::vector<Entry> entries_in(const TableReader& table, const std::string& key) {
  std::vector<Entry> entries = array_entries(table, key);
  const std::string before = table.path(key).substr(0, table.path(key).size() - key.size());
  for (Entry& entry : entries)
    entry.path = before + entry.path;
  return entries;
}

std::vector<std::string> read_groups(const TableReader& table) {
  const Value& value = table.required("group", "the name of a physical curve, or an array of them");
  if (!value.array())
    return {to_text(value, table.path("group"))};
  std::vector<std::string> groups;
  for (const Value& item : to_array(value, table.path("group"), "an array of names of curves"))
    groups.push_back(to_text(item, table.path("group")));
  return groups;
}

std::vector<FlowSupport> read_supports(const TableReader& table) {
  std::vector<FlowSupport> out;
  for (const Entry& entry : entries_in(table, "supports")) {
    const TableReader support(*entry.value, entry.path, {{"group", "length"}});
    out.push_back({support.text("group", "the name of a physical point of the tube"),
                   support.number("length", {at_least_zero, "m"})});
  }
  return out;
}

/// A law of several tubes has as many flows.
void check_tubes_of_laws(const TableReader& root, const std::vector<Flow>& flows) {
  for (const Flow& flow : flows) {
    const auto named = std::count_if(flows.begin(), flows.end(),
                                     [&](const Flow& other) { return other.law_name == flow.law_name; });
    if (flow.law && flow.law->tubes() > 1 && named != flow.law->tubes())
      root.fail_at("flow", "law \"" + flow.law_name + "\" is of " + std::to_string(flow.law->tubes()) +
                               " tubes and has " + std::to_string(named) +
                               " [[flow]]; give one for each tube, in the order of the rows");
  }
}

} // namespace

std::vector<Flow> read_flows(const TableReader& root, const std::filesystem::path& folder) {
  std::vector<Flow> all;
  const std::vector<NamedLaw> laws = read_flow_laws(root);
  for (const Entry& entry : array_entries(root, "flow")) {
    const TableReader table(*entry.value, entry.path,
                            {{"name", "group", "from", "zones", "supports", "structural_damping",
                              "damping_void_fraction", "law"}});
    Flow out;
    out.groups = read_groups(table);
    out.name = table.optional_text("name").value_or(out.groups.front());
    out.from = table.text("from", "a physical point or curve with the end of the tube where s = 0");
    (void)table.required("zones", "[[flow.zones]], the fluid along the tube");
    const std::vector<Entry> zones = entries_in(table, "zones");
    for (std::size_t i = 0; i < zones.size(); ++i)
      add_zone(out, zones[i], i, folder);
    if (out.zones.empty())
      table.fail_at("zones", "no zone has a fluid; give one a phase, or leave the [[flow]] out");
    if (table.has("supports"))
      out.supports = read_supports(table);
    out.structural_damping = table.number_or("structural_damping", out.structural_damping, {at_least_zero});
    if (out.structural_damping >= 1.0)
      table.fail_at("structural_damping", "a ratio to critical below 1 is expected; 0.002 is 0.2 %");
    out.void_fraction = table.choice(
        "damping_void_fraction", flow::DampingVoidFraction::of_the_zone,
        Choices<flow::DampingVoidFraction>{{{"zone", flow::DampingVoidFraction::of_the_zone},
                                            {"homogeneous", flow::DampingVoidFraction::homogeneous}}});
    if (const auto name = table.optional_text("law")) {
      const auto found =
          std::find_if(laws.begin(), laws.end(), [&](const NamedLaw& l) { return l.name == *name; });
      if (found == laws.end())
        table.fail_at("law", "no [flow_laws." + *name + "]; give one, or name another");
      out.law = found->law;
      out.law_name = *name;
    }
    for (const Flow& before : all)
      if (before.name == out.name)
        table.fail_table("a second flow called \"" + out.name + "\"; give each a name of its own");
    all.push_back(std::move(out));
  }
  check_tubes_of_laws(root, all);
  return all;
}

} // namespace fretwork::study
