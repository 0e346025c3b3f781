// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/basis_file.hpp"
#include "results/beam_file.hpp"
#include "results/contact_file.hpp"
#include "results/force_file.hpp"
#include "results/impact_columns.hpp"
#include "results/named_groups.hpp"
#include "results/stability_file.hpp"
#include "results/text_file.hpp"
#include "results/wear_file.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

namespace fs = std::filesystem;

/// The first `nt` outputs: where one structure's run diverged, the others' series go further than the common
/// time.
void write_series(const h5::Group& group, const post::ContactSeries& s, Eigen::Index nt) {
  write_matrix(group, "displacement", s.displacement.topRows(nt), "m");
  write_matrix(group, "velocity", s.velocity.topRows(nt), "m/s");
  write_vector(group, "gap", s.gap.head(nt), "m");
  write_vector(group, "normal_force", s.normal_force.head(nt), "N");
  write_matrix(group, "tangential_force", s.tangential_force.topRows(nt), "N");
  group.write<std::uint8_t>("state", {s.state.data(), static_cast<std::size_t>(nt)},
                            {static_cast<hsize_t>(nt)}, "0 open, 1 sticks, 2 slides");
  write_matrix(group, "normal", s.normal.topRows(nt), "1");
}

/// One dataset a column: a group that a table library reads as it is.
void write_impacts(const h5::Group& contact, const post::ContactImpacts& impacts, double rest_time) {
  const h5::Group group = contact.create("impacts");
  group.set("rest_time", rest_time);
  group.set("left_out", impacts.left_out);
  group.set("units", std::string("rest_time: s; left_out: impacts after the last row"));
  const h5::Shape shape{impacts.rows.size()};
  for (const ImpactColumn& column : impact_columns) {
    std::vector<double> values;
    for (const post::Impact& row : impacts.rows)
      values.push_back(row.*column.value);
    group.write<double>(column.name, values, shape, column.units);
  }
  std::vector<std::int64_t> rebounds;
  for (const post::Impact& row : impacts.rows)
    rebounds.push_back(row.rebounds);
  group.write<std::int64_t>("rebounds", rebounds, shape, "");
}

void write_largest_impact(const h5::Group& contact, const std::vector<post::ForcePoint>& history) {
  const h5::Group group = contact.create("largest_impact");
  const auto write = [&](const char* name, double post::ForcePoint::*value, const char* unit) {
    std::vector<double> values;
    for (const post::ForcePoint& point : history)
      values.push_back(point.*value);
    group.write<double>(name, values, h5::Shape{history.size()}, unit);
  };
  write("time", &post::ForcePoint::time, "s");
  write("normal_force", &post::ForcePoint::normal, "N");
  write("tangential_force", &post::ForcePoint::tangential, "N");
}

post::ContactImpacts read_impacts(const h5::Group& group) {
  post::ContactImpacts impacts;
  impacts.left_out = group.integer("left_out");
  const auto rebounds = group.read<std::int64_t>("rebounds");
  impacts.rows.resize(rebounds.size());
  for (std::size_t i = 0; i < rebounds.size(); ++i)
    impacts.rows[i].rebounds = rebounds[i];
  for (const ImpactColumn& column : impact_columns) {
    const auto values = group.read<double>(column.name);
    if (values.size() != rebounds.size())
      throw h5::Failure("columns of impacts of unequal length");
    for (std::size_t i = 0; i < values.size(); ++i)
      impacts.rows[i].*column.value = values[i];
  }
  return impacts;
}

void write_series(const h5::Group& group, const post::NodeSeries& s, Eigen::Index nt) {
  write_matrix(group, "displacement", s.displacement.topRows(nt), "m");
  write_matrix(group, "velocity", s.velocity.topRows(nt), "m/s");
  write_matrix(group, "acceleration", s.acceleration.topRows(nt), "m/s2");
}

/// mesh/groups: the nodes of each named group.
void write_groups(const h5::Group& mesh, const std::map<std::string, std::vector<core::Index>>& groups) {
  const h5::Group all = mesh.create("groups");
  std::size_t number = 0;
  for (const auto& [name, nodes] : groups)
    create_named(all, name, number++).write<core::Index>("nodes", nodes, {nodes.size()}, "");
}

std::map<std::string, std::vector<core::Index>> read_groups(const h5::Group& mesh) {
  std::map<std::string, std::vector<core::Index>> groups;
  if (mesh.has("groups"))
    for (const h5::Group& group : in_order(mesh.open("groups")))
      groups[group.text("name")] = group.read<core::Index>("nodes");
  return groups;
}

void write_contacts(const h5::Group& root, const RunResults& results) {
  const h5::Group contacts = root.create("contacts");
  for (std::size_t c = 0; c < results.contacts.size(); ++c) {
    const ContactFacts& facts = results.contacts[c];
    const h5::Group group = create_named(contacts, facts.name, c);
    write_facts(group, facts, results.nodes);
    for (const post::ContactSeries& series : results.series.contacts)
      if (series.name == facts.name)
        write_series(group, series, results.series.time.size());
    if (!results.impacts.empty())
      write_impacts(group, results.impacts.at(c), results.rest_time);
    if (!results.largest_impacts.empty() && !results.largest_impacts.at(c).empty())
      write_largest_impact(group, results.largest_impacts.at(c));
  }
}

void write_transient(const h5::Group& root, const RunResults& results) {
  const post::TimeSeries& series = results.series;
  root.set("duration", results.duration);
  root.set("statistics_from", results.statistics_from);
  write_vector(root, "time", series.time, "s");
  const h5::Group nodes = root.create("nodes");
  for (std::size_t n = 0; n < series.nodes.size(); ++n)
    write_series(create_named(nodes, series.nodes[n].name, n), series.nodes[n], series.time.size());
  if (series.modal_displacement.size() == 0)
    return; // left out
  const h5::Group modal = root.create("modal");
  // one output is a column in memory: [nt, n] as HDF5 sees it, no copy
  const auto write = [&](const char* name, const Eigen::MatrixXd& values, const char* units) {
    modal.write<double>(name, {values.data(), static_cast<std::size_t>(values.size())},
                        {static_cast<hsize_t>(values.cols()), static_cast<hsize_t>(values.rows())}, units);
  };
  write("displacement", series.modal_displacement, "m (modal mass 1 kg)");
  write("velocity", series.modal_velocity, "m/s (modal mass 1 kg)");
}

void read_contacts(const h5::Group& root, RunResults& results) {
  for (const h5::Group& group : in_order(root.open("contacts"))) {
    results.contacts.push_back(read_facts(group));
    if (group.has("normal_force"))
      results.series.contacts.push_back({results.contacts.back().name, read_matrix(group, "displacement"),
                                         read_matrix(group, "velocity"), read_vector(group, "gap"),
                                         read_vector(group, "normal_force"),
                                         read_matrix(group, "tangential_force"),
                                         group.read<std::uint8_t>("state"), read_matrix(group, "normal")});
    if (group.has("impacts")) {
      const h5::Group impacts = group.open("impacts");
      results.impacts.push_back(read_impacts(impacts));
      results.rest_time = impacts.number("rest_time");
    }
  }
}

void read_transient(const h5::Group& root, RunResults& results) {
  results.duration = root.number("duration");
  results.statistics_from = root.number("statistics_from");
  results.series.time = read_vector(root, "time");
  for (const h5::Group& group : in_order(root.open("nodes"))) {
    results.node_names.push_back(group.text("name"));
    results.series.nodes.push_back({group.text("name"), read_matrix(group, "displacement"),
                                    read_matrix(group, "velocity"), read_matrix(group, "acceleration")});
  }
  if (!root.has("modal"))
    return;
  const h5::Group modal = root.open("modal");
  results.series.modal_displacement = read_matrix(modal, "displacement").transpose();
  results.series.modal_velocity = read_matrix(modal, "velocity").transpose();
}

/// Whether there are as many rows of so many columns as there are instants.
bool fits(const Eigen::MatrixXd& series, const RunResults& results, Eigen::Index columns) {
  return series.rows() == results.series.time.size() && series.cols() == columns;
}

/// What exports rely on: numbers of nodes that exist, series of one length.
void check_sizes(const RunResults& results) {
  Eigen::Index modes = 0;
  for (const modal::Basis& basis : results.bases) {
    if (!results.nodes.empty() && !all_below(basis.nodes, results.nodes.size()))
      throw h5::Failure("nodes of the modes");
    modes += basis.size();
  }
  for (const ContactFacts& c : results.contacts)
    for (const fem::NodeShare& share : c.point.motion)
      if (!results.nodes.empty() && !all_below({&share.node, 1}, results.nodes.size()))
        throw h5::Failure("nodes of contact " + c.name);
  for (const post::ContactSeries& s : results.series.contacts)
    if (!fits(s.displacement, results, 3) || !fits(s.velocity, results, 3) || !fits(s.gap, results, 1) ||
        !fits(s.normal_force, results, 1) || !fits(s.tangential_force, results, 2) ||
        !fits(s.normal, results, 2) ||
        static_cast<Eigen::Index>(s.state.size()) != results.series.time.size())
      throw h5::Failure("series of contact " + s.name + " of unequal length");
  for (const post::NodeSeries& s : results.series.nodes)
    if (!fits(s.displacement, results, 3) || !fits(s.velocity, results, 3) ||
        !fits(s.acceleration, results, 3))
      throw h5::Failure("series of node " + s.name + " of unequal length");
  for (const post::ReactionSeries& s : results.series.reactions)
    if (!fits(s.force, results, 6))
      throw h5::Failure("series of reaction " + s.name + " of unequal length");
  for (const Eigen::MatrixXd* series : {&results.series.modal_displacement, &results.series.modal_velocity})
    if (series->size() > 0 && (series->rows() != modes || series->cols() != results.series.time.size()))
      throw h5::Failure("series of the modes of another size");
}

constexpr const char* archive_name = "results.h5";

template <class Reader> RunResults read(const fs::path& file, Reader reader) {
  try {
    return reader(h5::Group::open_file(file));
  } catch (const std::exception& failure) { // texts beyond memory included
    throw core::Error(fmt::format(
        "{}: cannot be read ({}): the file is damaged or not of this program; run the study again",
        file.string(), failure.what()));
  }
}

} // namespace

void write_archive(const fs::path& file, const RunResults& results) {
  h5::write_file(file, [&](const h5::Group& root) {
    write_record(root, results.record);
    root.set("dofs", results.model.dofs);
    root.set("mass", results.model.mass_kg);
    write_mesh(root, results.nodes, results.lines);
    write_groups(root.open("mesh"), results.groups);
    write_beams(root.open("mesh"), results);
    write_modes(root, results.bases);
    write_stability(root, results.stability);
    write_contacts(root, results);
    if (!results.transients.empty())
      write_transient(root, results);
    if (!results.transients.empty())
      write_forces(root, results);
    if (results.wear)
      write_wear(root, *results.wear);
  });
}

std::string archive_refusal(const fs::path& file, const std::string& input_sha256) {
  const h5::Quiet quiet;
  try {
    return h5::Group::open_file(file).text("input_sha256") == input_sha256 ? "" : "it is of another run";
  } catch (const h5::Failure& failure) {
    return failure.what();
  }
}

RunResults read_archive(const fs::path& directory) {
  const h5::Quiet quiet;
  const fs::path archive = directory / archive_name;
  const bool whole = fs::exists(archive);
  const fs::path file = whole ? archive : directory / "modes.h5";
  if (!fs::exists(file) && (fs::exists(directory / "table.h5") || fs::exists(directory / "shards")))
    throw core::Error(fmt::format(
        "{} holds the results of a sweep, whose table is table.csv; give the folder of a case that it kept "
        "({}), or run the study with the values of a case (--set)",
        directory.string(), (directory / "runs" / "case_N").string()));
  if (!fs::exists(file))
    throw core::Error(
        fmt::format("{}: there are no results here (neither results.h5 nor modes.h5); give the folder that "
                    "`fretwork run` or `fretwork modes` wrote",
                    directory.string()));
  return read(file, [&](const h5::Group& root) {
    RunResults results;
    results.record = read_record(root);
    read_mesh(root, results.nodes, results.lines);
    results.groups = read_groups(root.open("mesh"));
    read_beams(root.open("mesh"), results);
    results.model.nodes = static_cast<std::int64_t>(results.nodes.size());
    results.model.elements = static_cast<std::int64_t>(results.lines.size());
    results.bases = read_modes(root);
    check_sizes(results);
    if (!whole)
      return results;
    results.model.dofs = root.integer("dofs");
    results.model.mass_kg = root.number("mass");
    read_contacts(root, results);
    if (root.has("time"))
      read_transient(root, results);
    read_forces(root, results);
    if (root.has("wear"))
      results.wear = read_wear(root);
    check_sizes(results);
    return results;
  });
}

std::optional<RunResults> read_set_up(const fs::path& directory) {
  const h5::Quiet quiet;
  const fs::path file = directory / archive_name;
  if (!fs::exists(file))
    return {};
  return read(file, [](const h5::Group& root) {
    RunResults results;
    read_mesh(root, results.nodes, results.lines);
    read_beams(root.open("mesh"), results);
    for (const h5::Group& group : in_order(root.open("contacts")))
      results.contacts.push_back(read_facts(group));
    check_sizes(results);
    return results;
  });
}

} // namespace fretwork::results
