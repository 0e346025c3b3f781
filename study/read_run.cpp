// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/readers.hpp"
#include <algorithm>
#include <limits>

namespace fretwork::study {
namespace {

modal::DampingTable read_damping_table(const TableReader& damping) {
  const std::string path = damping.path("table");
  modal::DampingTable table;
  for (const Value& value : to_array(*damping.find("table"), path, "an array of rows [Hz, ratio]")) {
    if (!value.array())
      fail(value, path, "a row [Hz, ratio] is expected");
    const std::vector<double> row = to_numbers(value, path, 2, {Range::at_least_zero, "Hz and a ratio"});
    if (!table.rows.empty() && row[0] <= table.rows.back().frequency)
      fail(value, path,
           "its frequency is not above that of the row before; let frequencies rise from row to row");
    table.rows.push_back({row[0], row[1]});
  }
  return table;
}

/// Of `damping = "flow"`.
void read_flow_damping(const TableReader& root, const TableReader& table, Modes& modes) {
  const Value* found = table.find("damping");
  modes.flow_damping = found && found->string();
  if (!modes.flow_damping)
    return;
  (void)to_choice(*found, table.path("damping"), {"flow"});
  if (!root.has("flow"))
    table.fail_at("damping", "there is no [[flow]] that it would follow from; add it, or give ratios");
}

modal::Damping read_damping(const TableReader& modes) {
  const Value* found = modes.find("damping");
  if (!found || found->string())
    return 0.0;
  const std::string path = modes.path("damping");
  if (found->array())
    return to_numbers(*found, path, 0, {Range::at_least_zero});
  if (!found->table())
    return to_number(*found, path, {Range::at_least_zero});
  const TableReader table(*found, path, {{"stiffness", "mass", "table"}});
  if (table.has("table")) {
    if (table.has("stiffness") || table.has("mass"))
      table.fail_at("table", "table and stiffness or mass both say the damping; keep one");
    return read_damping_table(table);
  }
  if (!table.has("stiffness") && !table.has("mass"))
    table.fail_table(
        "neither stiffness nor mass nor table; write { stiffness = 1.0e-5, mass = 0.5 } or one of "
        "them, or { table = [[10, 0.02], [100, 0.01]] }");
  return modal::Rayleigh{table.number_or("stiffness", 0.0, {Range::at_least_zero, "s"}),
                         table.number_or("mass", 0.0, {Range::at_least_zero, "1/s"})};
}

/// s; where times of 1e-300 s are squared nothing is left of them.
constexpr double shortest_duration = 1e-9;

/// The rule that derives modes from accuracy is measured up to here.
constexpr double largest_mode_accuracy = 0.1;

void read_number_of_modes(const TableReader& root, const TableReader& table, Modes& modes) {
  std::string given;
  for (const std::string key : {"count", "up_to_hz", "accuracy"})
    if (table.has(key)) {
      if (!given.empty())
        table.fail_at(key, given + " and " + key + " both say how many modes; keep one");
      given = key;
    }
  modes.number_given = !given.empty();
  if (given.empty())
    return;
  const auto count = table.optional_integer("count", 1);
  if (count && *count > std::numeric_limits<int>::max())
    table.fail_at("count", "more modes than a structure can have");
  modes.count = count ? std::optional<int>(static_cast<int>(*count)) : std::nullopt;
  modes.up_to_hz = table.optional_number("up_to_hz", {Range::above_zero, "Hz"});
  modes.accuracy = table.optional_number("accuracy", {Range::above_zero});
  if (modes.accuracy && *modes.accuracy > largest_mode_accuracy)
    table.fail_at("accuracy", "a relative error of contact forces of at most 0.1 is expected");
  if (modes.accuracy && !root.has("contacts"))
    table.fail_at(
        "accuracy",
        "there are no [[contacts]] whose forces would say which modes matter; give count or up_to_hz");
}

/// An array of names of groups, each named once; none where the key is not there.
std::vector<std::string> read_groups(const TableReader& table, const char* key) {
  std::vector<std::string> groups;
  const Value* found = table.find(key);
  if (!found)
    return groups;
  for (const Value& group : to_array(*found, table.path(key), "an array of group names")) {
    const std::string name = to_text(group, table.path(key));
    if (std::find(groups.begin(), groups.end(), name) != groups.end())
      fail(group, table.path(key), "named twice; name each group once");
    groups.push_back(name);
  }
  return groups;
}

} // namespace

Modes read_modes(const TableReader& root) {
  Modes modes;
  const Value* found = root.find("modes");
  if (!found)
    return modes;
  const TableReader table(*found, "modes",
                          {{"count", "up_to_hz", "accuracy", "damping", "static_modes", "distributed"}});
  read_number_of_modes(root, table, modes);
  read_flow_damping(root, table, modes);
  modes.damping = read_damping(table);
  modes.static_modes = table.choice(
      "static_modes", StaticModes::none,
      Choices<StaticModes>{
          {{"none", StaticModes::none}, {"auto", StaticModes::added}, {"all", StaticModes::added}}});
  modes.distributed = table.optional_flag("distributed");
  return modes;
}

std::optional<Transient> read_transient(const TableReader& root) {
  const Value* found = root.find("transient");
  if (!found)
    return std::nullopt;
  const TableReader table(
      *found, "transient",
      {{"duration", "start", "scheme", "accuracy", "step", "tolerance", "verify", "max_hours"}});
  Transient transient;
  transient.duration = table.number("duration", {Range::above_zero, "s"});
  if (transient.duration < shortest_duration)
    table.fail_at("duration", "shorter than a nanosecond, in which no structure moves; give seconds");
  transient.start = table.choice("start", Start::rest,
                                 Choices<Start>{{{"rest", Start::rest}, {"static", Start::equilibrium}}});
  transient.scheme = table.choice("scheme", Scheme::automatic,
                                  Choices<Scheme>{{{"auto", Scheme::automatic},
                                                   {"splitting", Scheme::splitting},
                                                   {"collocation", Scheme::collocation},
                                                   {"euler", Scheme::euler},
                                                   {"devogelaere", Scheme::devogelaere},
                                                   {"runge_kutta_54", Scheme::runge_kutta_54},
                                                   {"energy_conserving", Scheme::energy_conserving}}});
  transient.accuracy = table.number_or("accuracy", 0.01, {Range::above_zero});
  if (transient.accuracy >= 1.0)
    table.fail_at("accuracy", "a relative error below 1 is expected");
  if (table.find("tolerance") && transient.scheme != Scheme::runge_kutta_54)
    table.fail_at("tolerance",
                  "only scheme = \"runge_kutta_54\" follows a tolerance; the others take accuracy or step");
  transient.tolerance = table.number_or("tolerance", 1e-6, {Range::above_zero});
  if (transient.tolerance > 0.1)
    table.fail_at("tolerance",
                  "the error of a step relative to the energy norm of the motion: at most 0.1 is expected");
  transient.verify = table.optional_flag("verify").value_or(false);
  transient.max_hours = table.number_or("max_hours", transient.max_hours, {Range::above_zero, "hours"});
  transient.step = table.optional_number("step", {Range::above_zero, "s"});
  if (transient.step && *transient.step > transient.duration)
    table.fail_at("step",
                  "longer than the duration; give a step well below the shortest period of the modes");
  return transient;
}

Output read_output(const TableReader& root, const std::optional<Transient>& transient) {
  Output output;
  const Value* found = root.find("output");
  if (!found)
    return output;
  const TableReader table(*found, "output",
                          {{"every", "nodes", "section_forces", "reactions", "modal", "statistics_from",
                            "impacts", "rest_time", "checkpoint"}});
  output.every = table.optional_number("every", {Range::above_zero, "s"});
  if (transient && output.every && *output.every > transient->duration)
    table.fail_at("every", "longer than transient.duration; give the time between two samples");
  output.nodes = read_groups(table, "nodes");
  output.section_forces = read_groups(table, "section_forces");
  output.reactions = read_groups(table, "reactions");
  output.modal = table.optional_flag("modal").value_or(true);
  output.statistics_from = table.number_or("statistics_from", 0.0, {Range::at_least_zero, "s"});
  if (transient && output.statistics_from >= transient->duration)
    table.fail_at("statistics_from", "the statistics must start before the end, transient.duration");
  output.impacts = table.optional_integer("impacts", 0).value_or(output.impacts);
  output.rest_time = table.number_or("rest_time", 0.0, {Range::at_least_zero, "s"});
  output.checkpoint = table.number_or("checkpoint", output.checkpoint, {Range::at_least_zero, "s"});
  return output;
}

} // namespace fretwork::study
