// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/readers.hpp"
#include "study/time_functions.hpp"

namespace fretwork::study {
namespace {

Keys with_time_function(std::vector<std::string> known) {
  known.insert(known.end(), time_function_keys.begin(), time_function_keys.end());
  known.emplace_back("scale");
  return {std::move(known)};
}

/// A displacement is twice differentiated: it must be smooth enough for that.
void check_smooth(const TableReader& table, const SupportMotion& motion) {
  if (table.has("random"))
    table.fail_at("random", "a random displacement is not available; give quantity = \"acceleration\", or a "
                            "table of the displacement");
  for (const char* key : {"velocity0", "displacement0"})
    if (table.has(key))
      table.fail_at(key, "a displacement says by itself how the support starts; leave it out, or give "
                         "quantity = \"acceleration\"");
  const auto* rows = std::get_if<signals::Table>(&motion.function);
  for (std::size_t i = 1; rows && i < rows->time.size(); ++i)
    if (rows->time[i] == rows->time[i - 1])
      table.fail_at("table", "a jump of displacement (two rows of equal time) would take an infinite force; "
                             "give the rows times of their own");
}

/// What moves a support: random, it stays about its place.
signals::TimeFunction of_motion(signals::TimeFunction function) {
  if (auto* random = std::get_if<signals::Random>(&function))
    random->of_motion = true;
  return function;
}

} // namespace

std::vector<Load> read_loads(const TableReader& root, const std::filesystem::path& folder) {
  std::vector<Load> all;
  for (const Entry& entry : array_entries(root, "loads")) {
    const TableReader table(*entry.value, entry.path,
                            with_time_function({"name", "group", "per_length", "moment", "direction"}));
    Load load;
    load.name = table.optional_text("name").value_or("");
    load.group = table.text("group", "the name of a physical point or curve of the mesh");
    load.per_length = table.optional_flag("per_length").value_or(false);
    load.moment = table.optional_flag("moment").value_or(false);
    if (load.per_length && load.moment)
      table.fail_at(
          "moment",
          "a moment per length is not available in this version; keep one of per_length and moment");
    load.direction = table.direction("direction");
    load.function = read_time_function(table, folder, load.moment ? "N m" : (load.per_length ? "N/m" : "N"));
    all.push_back(load);
  }
  return all;
}

std::optional<Vec3> read_gravity(const TableReader& root) {
  const Value* found = root.find("gravity");
  if (!found)
    return std::nullopt;
  const TableReader table(*found, "gravity", {{"acceleration"}});
  (void)table.required("acceleration", "a vector [x, y, z] in m/s2");
  return table.optional_vector("acceleration", {Range::any, "m/s2"});
}

std::vector<BaseMotion> read_base_motions(const TableReader& root, const std::filesystem::path& folder) {
  std::vector<BaseMotion> all;
  for (const Entry& entry : array_entries(root, "base_motion")) {
    const TableReader table(*entry.value, entry.path,
                            with_time_function({"direction", "velocity0", "displacement0"}));
    all.push_back({table.direction("direction"), of_motion(read_time_function(table, folder, "m/s2")),
                   table.optional_number("velocity0", {Range::any, "m/s"}),
                   table.optional_number("displacement0", {Range::any, "m"})});
  }
  return all;
}

std::vector<SupportMotion> read_support_motions(const TableReader& root,
                                                const std::filesystem::path& folder) {
  std::vector<SupportMotion> all;
  for (const Entry& entry : array_entries(root, "support_motion")) {
    const TableReader table(
        *entry.value, entry.path,
        with_time_function({"group", "direction", "quantity", "velocity0", "displacement0"}));
    SupportMotion motion;
    motion.group = table.text("group", "the name of a physical point or curve of the mesh, the support");
    motion.direction = table.direction("direction");
    motion.by_displacement =
        table.choice("quantity", false, Choices<bool>{{{"acceleration", false}, {"displacement", true}}});
    motion.function = of_motion(read_time_function(table, folder, motion.by_displacement ? "m" : "m/s2"));
    if (motion.by_displacement)
      check_smooth(table, motion);
    motion.velocity0 = table.optional_number("velocity0", {Range::any, "m/s"});
    motion.displacement0 = table.optional_number("displacement0", {Range::any, "m"});
    all.push_back(motion);
  }
  return all;
}

std::vector<Initial> read_initial(const TableReader& root, const std::optional<Transient>& transient) {
  const bool in_equilibrium = transient && transient->start == Start::equilibrium;
  std::vector<Initial> all;
  for (const Entry& entry : array_entries(root, "initial")) {
    const TableReader table(*entry.value, entry.path,
                            {{"group", "displacement", "velocity", "rotation_rate", "centre"}});
    Initial initial;
    initial.group = table.text("group", "the name of a physical point or curve of the mesh");
    if (!table.has("displacement") && !table.has("velocity") && !table.has("rotation_rate"))
      table.fail_table("no initial state; give displacement, velocity or rotation_rate");
    if (table.has("centre") && !table.has("rotation_rate"))
      table.fail_at("centre",
                    "a centre without rotation_rate has no effect; give rotation_rate or leave centre out");
    if (table.has("displacement") && in_equilibrium)
      table.fail_at("displacement", "transient.start = \"static\" finds the displacements itself; leave them "
                                    "out, or take start = \"rest\"");
    initial.displacement = table.optional_vector("displacement", {Range::any, "m"}).value_or(Vec3::Zero());
    initial.velocity = table.optional_vector("velocity", {Range::any, "m/s"}).value_or(Vec3::Zero());
    initial.rotation_rate =
        table.optional_vector("rotation_rate", {Range::any, "rad/s"}).value_or(Vec3::Zero());
    initial.centre = table.optional_vector("centre", {Range::any, "m"}).value_or(Vec3::Zero());
    all.push_back(initial);
  }
  return all;
}

} // namespace fretwork::study
