// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/basis_file.hpp"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

namespace fretwork::results {
namespace {

h5::Shape shape_of(Eigen::Index rows, Eigen::Index columns) {
  return {static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
}

std::span<const double> all_of(const auto& dense) {
  return {dense.data(), static_cast<std::size_t>(dense.size())};
}

void write_basis(const h5::Group& group, const modal::Basis& basis) {
  const Eigen::VectorXd frequency = basis.omega / (2.0 * std::numbers::pi);
  write_vector(group, "frequency", frequency, "Hz");
  write_vector(group, "angular_frequency", basis.omega, "rad/s");
  write_vector(group, "damping", basis.damping, "1");
  write_vector(group, "mass", Eigen::VectorXd::Ones(basis.size()), "kg");
  write_vector(group, "residuals", basis.residuals, "1");
  write_vector(group, "error_estimate", basis.error, "1");
  write_matrix(group, "participation", basis.participation, "sqrt(kg)");
  write_vector(group, "moving_mass", basis.moving_mass, "kg");
  // a column of `shapes` in memory is a mode: node after node, six values each
  group.write<double>("shapes", all_of(basis.shapes),
                      {static_cast<hsize_t>(basis.size()), basis.nodes.size(), 6}, "m, rad");
  group.write<core::Index>("nodes", basis.nodes, {basis.nodes.size()}, "");
  if (basis.damping_matrix.size() > 0)
    write_matrix(group, "damping_matrix", basis.damping_matrix, "1/s");
  group.set("static_modes", std::int64_t{basis.static_modes});
  group.set("orthogonality", basis.orthogonality);
  group.set("splits_group", std::int64_t{basis.splits_group});
  group.set("complete", std::int64_t{basis.complete});
  group.set("distributed", std::int64_t{basis.distributed});
}

modal::Basis read_basis(const h5::Group& group) {
  modal::Basis basis;
  basis.nodes = group.read<core::Index>("nodes");
  basis.omega = read_vector(group, "angular_frequency");
  basis.damping = read_vector(group, "damping");
  basis.residuals = read_vector(group, "residuals");
  basis.error = read_vector(group, "error_estimate");
  basis.participation = read_matrix(group, "participation");
  const Eigen::VectorXd moving_mass = read_vector(group, "moving_mass");
  const Eigen::Index n = basis.omega.size();
  const auto rows = static_cast<Eigen::Index>(6 * basis.nodes.size());
  const std::vector<double> shapes = group.read<double>("shapes");
  if (static_cast<Eigen::Index>(shapes.size()) != rows * n || basis.damping.size() != n ||
      basis.residuals.size() != n || basis.error.size() != n || basis.participation.rows() != n ||
      basis.participation.cols() != 3 || moving_mass.size() != 3)
    throw h5::Failure("modes of different sizes");
  basis.moving_mass = moving_mass;
  basis.shapes = Eigen::Map<const Eigen::MatrixXd>(shapes.data(), rows, n);
  if (group.has("damping_matrix")) {
    basis.damping_matrix = read_matrix(group, "damping_matrix");
    if (basis.damping_matrix.rows() != n || basis.damping_matrix.cols() != n)
      throw h5::Failure("damping matrix of another size");
  }
  basis.static_modes = group.integer("static_modes");
  if (basis.static_modes < 0 || basis.static_modes > n)
    throw h5::Failure("more static modes than modes");
  basis.orthogonality = group.number("orthogonality");
  basis.splits_group = group.integer("splits_group") != 0;
  basis.complete = group.integer("complete") != 0;
  basis.distributed = group.integer("distributed") != 0;
  return basis;
}

} // namespace

bool all_below(std::span<const core::Index> numbers, std::size_t count) {
  return std::all_of(numbers.begin(), numbers.end(), [count](core::Index number) {
    return number >= 0 && static_cast<std::size_t>(number) < count;
  });
}

void write_vector(const h5::Group& group, const std::string& name, const Eigen::VectorXd& values,
                  const std::string& units) {
  group.write<double>(name, all_of(values), {static_cast<hsize_t>(values.size())}, units);
}

void write_matrix(const h5::Group& group, const std::string& name, const Eigen::MatrixXd& values,
                  const std::string& units) {
  const RowMajor rows = values;
  group.write<double>(name, all_of(rows), shape_of(rows.rows(), rows.cols()), units);
}

Eigen::VectorXd read_vector(const h5::Group& group, const std::string& name) {
  const std::vector<double> values = group.read<double>(name);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd read_matrix(const h5::Group& group, const std::string& name) {
  const h5::Shape shape = group.shape(name);
  if (shape.size() != 2)
    throw h5::Failure("dataset " + name + " is not a matrix");
  const std::vector<double> values = group.read<double>(name);
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(shape[0]),
                                    static_cast<Eigen::Index>(shape[1]));
}

void write_mesh(const h5::Group& root, const std::vector<core::Vec3>& nodes,
                const std::vector<std::array<core::Index, 2>>& lines) {
  const h5::Group mesh = root.create("mesh");
  std::vector<double> positions;
  for (const core::Vec3& node : nodes)
    positions.insert(positions.end(), node.begin(), node.end());
  mesh.write<double>("nodes", positions, {nodes.size(), 3}, "m");
  std::vector<core::Index> ends;
  for (const auto& line : lines)
    ends.insert(ends.end(), line.begin(), line.end());
  mesh.write<core::Index>("lines", ends, {lines.size(), 2}, "");
}

void read_mesh(const h5::Group& root, std::vector<core::Vec3>& nodes,
               std::vector<std::array<core::Index, 2>>& lines) {
  if (!root.has("mesh"))
    return;
  const h5::Group mesh = root.open("mesh");
  const std::vector<double> positions = mesh.read<double>("nodes");
  if (positions.size() % 3 != 0)
    throw h5::Failure("nodes of the mesh");
  for (std::size_t i = 0; i < positions.size(); i += 3)
    nodes.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
  const std::vector<core::Index> ends = mesh.read<core::Index>("lines");
  if (ends.size() % 2 != 0 || !all_below(ends, nodes.size()))
    throw h5::Failure("lines of the mesh");
  for (std::size_t i = 0; i < ends.size(); i += 2)
    lines.push_back({ends[i], ends[i + 1]});
}

void write_modes(const h5::Group& root, const std::vector<modal::Basis>& bases) {
  const h5::Group modes = root.create("modes");
  if (bases.size() == 1)
    return write_basis(modes, bases[0]);
  for (std::size_t s = 0; s < bases.size(); ++s)
    write_basis(modes.create(std::to_string(s)), bases[s]);
}

std::vector<modal::Basis> read_modes(const h5::Group& root) {
  std::vector<modal::Basis> bases;
  const h5::Group modes = root.open("modes");
  if (modes.has("shapes"))
    bases.push_back(read_basis(modes));
  for (std::size_t s = 0; modes.has(std::to_string(s)); ++s)
    bases.push_back(read_basis(modes.open(std::to_string(s))));
  return bases;
}

void write_record(const h5::Group& root, const RunRecord& record) {
  root.set("program", std::string("fretwork"));
  root.set("version", record.version);
  root.set("title", record.title);
  root.set("study", record.study_text);
  root.set("input_sha256", record.input_sha256);
  root.set<std::uint64_t>("seeds", record.seeds, {record.seeds.size()});
  root.set("libraries", nlohmann::json(record.libraries).dump());
}

RunRecord read_record(const h5::Group& root) {
  RunRecord record;
  record.version = root.text("version");
  record.title = root.text("title");
  record.study_text = root.text("study");
  record.input_sha256 = root.text("input_sha256");
  record.seeds = root.values<std::uint64_t>("seeds");
  const auto libraries = nlohmann::json::parse(root.text("libraries"), nullptr, false);
  if (!libraries.is_object())
    throw h5::Failure("attribute libraries is not a JSON object");
  for (const auto& [name, version] : libraries.items())
    record.libraries[name] = version.is_string() ? version.get<std::string>() : version.dump();
  return record;
}

} // namespace fretwork::results
