// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/contact_file.hpp"
#include "results/basis_file.hpp"

namespace fretwork::results {
namespace {

constexpr const char* contact_units =
    "position, other_position, gap, rest: m; normal_stiffness, tangential_stiffness: N/m; normal_damping, "
    "tangential_damping: N s/m; normal_dissipation: s/m; axes: rows x_loc, y_loc, z_loc; friction_along: "
    "along x_loc, across it; point: m, where the tube meets the obstacle";

/// The point that meets the obstacle; where it is the node, its motion is not written.
void write_point(const h5::Group& group, const fem::BeamPoint& point, core::Index node) {
  group.set<double>("point", {point.place.data(), 3}, {3});
  if (point.motion.size() == 1 && point.motion[0].node == node)
    return;
  std::vector<core::Index> nodes;
  std::vector<double> weights;
  for (const fem::NodeShare& share : point.motion) {
    nodes.push_back(share.node);
    const Eigen::Matrix<double, 3, 6, Eigen::RowMajor> rows = share.weights;
    weights.insert(weights.end(), rows.data(), rows.data() + rows.size());
  }
  group.write<core::Index>("point_nodes", nodes, {nodes.size()}, "");
  group.write<double>("point_weights", weights, {nodes.size(), 3, 6}, "1, m: of ux uy uz rx ry rz");
}

fem::BeamPoint read_point(const h5::Group& group, core::Index node) {
  using Weights = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
  const auto place = group.values<double>("point");
  if (place.size() != 3)
    throw h5::Failure("point of a contact");
  fem::BeamPoint point{{place[0], place[1], place[2]}, {}};
  if (!group.has("point_nodes")) {
    point.motion = {{node, Weights::Identity()}};
    return point;
  }
  const auto nodes = group.read<core::Index>("point_nodes");
  const auto weights = group.read<double>("point_weights");
  if (weights.size() != nodes.size() * Weights::SizeAtCompileTime)
    throw h5::Failure("point_nodes and point_weights of different sizes");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    point.motion.push_back({nodes[i], Eigen::Map<const Weights>(&weights[i * Weights::SizeAtCompileTime])});
  return point;
}

} // namespace

void write_facts(const h5::Group& group, const ContactFacts& c, const std::vector<core::Vec3>& nodes) {
  const RowMajor axes = c.axes;
  group.set("node", std::int64_t{c.node});
  group.set("other", std::int64_t{c.other});
  group.set<double>("position", {nodes.at(static_cast<std::size_t>(c.node)).data(), 3}, {3});
  if (c.other >= 0)
    group.set<double>("other_position", {nodes.at(static_cast<std::size_t>(c.other)).data(), 3}, {3});
  write_point(group, c.point, c.node);
  group.set<double>("axes", {axes.data(), 9}, {3, 3});
  group.set("obstacle", c.obstacle);
  group.set("gap", c.gap);
  group.set<double>("rest", {c.rest.data(), 3}, {3});
  group.set("normal_stiffness", c.normal_stiffness);
  group.set("normal_damping", c.normal_damping);
  group.set("normal_dissipation", c.normal_dissipation);
  group.set("tangential_stiffness", c.tangential_stiffness);
  group.set("tangential_damping", c.tangential_damping);
  group.set("friction_static", c.friction_static);
  group.set("friction_dynamic", c.friction_dynamic);
  group.set<double>("friction_along", c.friction_along, {2});
  if (c.static_flexibility)
    write_vector(
        group, "static_flexibility",
        core::Vec3(c.static_flexibility->exact, c.static_flexibility->basis, c.static_flexibility->missing),
        "m/N: exact, of the modes, missing; along the normal direction in which most is missing");
  group.set("units", std::string(contact_units));
  if (c.outline.size() > 0)
    write_matrix(group, "outline", c.outline, "m");
}

ContactFacts read_facts(const h5::Group& group) {
  ContactFacts c;
  c.name = group.text("name");
  c.node = static_cast<core::Index>(group.integer("node"));
  c.other = static_cast<core::Index>(group.integer("other"));
  c.point = read_point(group, c.node);
  const auto axes = group.values<double>("axes"), rest = group.values<double>("rest"),
             along = group.values<double>("friction_along");
  if (axes.size() != 9 || rest.size() != 3 || along.size() != 2)
    throw h5::Failure("axes, rest or friction_along of a contact");
  c.axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(axes.data());
  c.rest = Eigen::Map<const core::Vec3>(rest.data());
  c.obstacle = group.text("obstacle");
  c.gap = group.number("gap");
  c.normal_stiffness = group.number("normal_stiffness");
  c.normal_damping = group.number("normal_damping");
  c.normal_dissipation = group.number("normal_dissipation");
  c.tangential_stiffness = group.number("tangential_stiffness");
  c.tangential_damping = group.number("tangential_damping");
  c.friction_static = group.number("friction_static");
  c.friction_dynamic = group.number("friction_dynamic");
  c.friction_along = {along[0], along[1]};
  if (group.has("static_flexibility")) {
    const Eigen::VectorXd f = read_vector(group, "static_flexibility");
    if (f.size() != 3)
      throw h5::Failure("static_flexibility of a contact");
    c.static_flexibility = {f(0), f(1), f(2)};
  }
  if (group.has("outline"))
    c.outline = read_matrix(group, "outline");
  return c;
}

} // namespace fretwork::results
