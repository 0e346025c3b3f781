// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_scene.hpp"
#include "core/error.hpp"
#include "fem/fields.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace fretwork::app {
namespace {

using core::Index;
using core::Vec3;

/// Above this share lost by the projection of the initial field the run starts from something else than was
/// asked.
constexpr double lost_share_warning = 0.05;
/// Components of shapes below this share of the largest at a contact are the eigensolver's round-off.
constexpr double round_off_of_shapes = 1e-11;
/// Couplings of a projected damping matrix below this share of its diagonal are round-off.
constexpr double negligible_coupling = 1e-12;

Eigen::VectorXd load_field(const study::Load& load, const std::string& what, const mesh::LineMesh& mesh,
                           const BuiltModel& built) {
  if (!load.per_length)
    return fem::point_forces(built.model, mesh::group_nodes(mesh, load.group, what), load.direction,
                             load.moment);
  std::vector<Index> beams;
  for (const Index line : mesh::group_lines(mesh, load.group, what))
    for (const Index beam : built.beams_of_line[static_cast<std::size_t>(line)])
      beams.push_back(beam);
  return fem::line_forces(built.model, beams, load.direction);
}

void initial_field(const study::Study& study, const mesh::LineMesh& mesh, const fem::Model& model,
                   Fields& out) {
  if (study.initial.empty())
    return;
  out.moves_at_start = true;
  out.displacement.setZero(static_cast<Eigen::Index>(model.nodes.size()) * core::dofs_per_node);
  out.velocity = out.displacement;
  for (std::size_t e = 0; e < study.initial.size(); ++e) {
    const study::Initial& initial = study.initial[e];
    for (const Index node :
         mesh::group_nodes(mesh, initial.group, fmt::format("[[initial]] entry {}", e + 1))) {
      const Eigen::Index row = static_cast<Eigen::Index>(node) * core::dofs_per_node;
      const Vec3 arm = model.nodes[static_cast<std::size_t>(node)] - initial.centre;
      out.displacement.segment<6>(row) << initial.displacement, Vec3::Zero();
      out.velocity.segment<6>(row) << initial.velocity + initial.rotation_rate.cross(arm),
          initial.rotation_rate;
    }
  }
  for (std::size_t node = 0; node < model.nodes.size(); ++node)
    for (int d = 0; d < core::dofs_per_node; ++d)
      if (model.is_fixed(static_cast<Index>(node), d)) {
        const auto row = static_cast<Eigen::Index>(node) * core::dofs_per_node + d;
        out.displacement(row) = out.velocity(row) = 0.0;
      }
  out.displacement_momentum = fem::mass_times(model, out.displacement);
  out.velocity_momentum = fem::mass_times(model, out.velocity);
}

/// Part of a field over the model that belongs to the structure of a basis.
Eigen::VectorXd restricted(const modal::Basis& basis, const Eigen::VectorXd& field) {
  Eigen::VectorXd out(basis.shapes.rows());
  for (std::size_t i = 0; i < basis.nodes.size(); ++i)
    out.segment<6>(static_cast<Eigen::Index>(6 * i)) =
        field.segment<6>(static_cast<Eigen::Index>(basis.nodes[i]) * 6);
  return out;
}

void append(Eigen::VectorXd& all, const Eigen::VectorXd& part) {
  const Eigen::Index before = all.size();
  all.conservativeResize(before + part.size());
  all.tail(part.size()) = part;
}

/// Initial modal coordinates of a field, structure after structure, and the share of the field that the modes lose.
Eigen::VectorXd project(const std::vector<const modal::Basis*>& bases, const Eigen::VectorXd& momentum,
                        const Eigen::VectorXd& field, const char* name, BuiltScene& out) {
  Eigen::VectorXd q(0);
  double whole = 0.0;
  for (const modal::Basis* basis : bases) {
    const Eigen::VectorXd part = restricted(*basis, momentum);
    whole += part.dot(restricted(*basis, field));
    append(q, basis->shapes.transpose() * part);
  }
  if (whole > 0.0) {
    const double lost = std::sqrt(std::max(0.0, 1.0 - q.squaredNorm() / whole));
    const std::string text =
        fmt::format("the modes lose {:.2g} % of the initial {} (norm in mass)", 100.0 * lost, name);
    if (lost > lost_share_warning)
      out.warnings.push_back(text + "; take more modes, or a field the modes can follow");
    else
      out.notes.push_back(text);
  }
  return q;
}

/// The modal equations of all structures of the scene, one after the other.
void add_system(const std::vector<const modal::Basis*>& bases, transient::System& system) {
  bool coupled = false;
  for (const modal::Basis* basis : bases) {
    const bool full = basis->damping_matrix.size() > 0;
    append(system.stiffness, basis->omega.cwiseAbs2());
    append(system.damping, full ? Eigen::VectorXd(basis->damping_matrix.diagonal())
                                : Eigen::VectorXd(2.0 * basis->damping.cwiseProduct(basis->omega)));
    if (full) {
      const Eigen::MatrixXd& c = basis->damping_matrix;
      const double coupling = (c - Eigen::MatrixXd(c.diagonal().asDiagonal())).cwiseAbs().maxCoeff();
      coupled = coupled || coupling > negligible_coupling * c.diagonal().cwiseAbs().maxCoeff();
    }
  }
  if (!coupled)
    return;
  system.damping_matrix = system.damping.asDiagonal();
  Eigen::Index first = 0;
  for (const modal::Basis* basis : bases) {
    if (basis->damping_matrix.size() > 0)
      system.damping_matrix.block(first, first, basis->size(), basis->size()) = basis->damping_matrix;
    first += basis->size();
  }
}

/// Translations of a node over all modes of the scene, 3 x n global axes; empty where no structure of the scene has the node.
Eigen::MatrixXd translations(const std::vector<const modal::Basis*>& bases, Index node, Eigen::Index modes) {
  Eigen::Index first = 0;
  for (const modal::Basis* basis : bases) {
    if (const Eigen::Index row = basis->row_of(node); row >= 0) {
      Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3, modes);
      out.middleCols(first, basis->size()) = basis->shapes.middleRows<3>(row);
      return out;
    }
    first += basis->size();
  }
  return {};
}

/// R5.06.03 section 6.5 with the mode that moves the contact most along its tangents, in mass-normalised
/// local quantities.
double automatic_damping(const study::Contact& contact, const std::string& name,
                         const transient::System& system, const transient::ContactPoint& point) {
  const auto [ny, nz] = contact::normal_directions(point.support.obstacle);
  const bool round = ny && nz;
  Eigen::VectorXd size2 = point.b.row(0).cwiseAbs2();
  if (round || !ny)
    size2 += point.b.row(1).cwiseAbs2();
  if (round || !nz)
    size2 += point.b.row(2).cwiseAbs2();
  Eigen::Index mode = 0;
  const double largest = size2.size() > 0 ? size2.maxCoeff(&mode) : 0.0;
  if (!(largest > 0.0))
    throw core::Error(fmt::format(
        "contact \"{}\": no mode moves its node along the obstacle, so that there is no automatic tangential "
        "damping; give tangential_damping a value",
        name));
  const double mass = 1.0 / largest;
  const double omega = std::sqrt(system.stiffness(mode));
  const double ratio = omega > 0.0 ? 0.5 * system.damping(mode) / omega : 0.0;
  const double damping =
      contact::automatic_tangential_damping(contact.tangential_stiffness, omega * omega * mass, mass, ratio);
  if (damping < 0.0)
    throw core::Error(fmt::format(
        "contact \"{}\": the automatic tangential damping is {:.4g} N s/m, below 0, because the mode that "
        "moves it most is overdamped (ratio {:.3g}); give tangential_damping a value",
        name, damping, ratio));
  return damping;
}

void add_contact(const study::Contact& contact, const PlacedContact& placed,
                 const std::vector<const modal::Basis*>& bases, BuiltScene& out) {
  const Eigen::Index modes = out.scene.system.size();
  transient::ContactPoint point;
  point.name = placed.name;
  point.rest = placed.rest;
  Eigen::MatrixXd motion = translations(bases, placed.node, modes);
  if (motion.size() == 0)
    motion = Eigen::MatrixXd::Zero(3, modes);
  if (placed.other >= 0)
    if (const Eigen::MatrixXd other = translations(bases, placed.other, modes); other.size() > 0)
      motion -= other;
  point.b = placed.frame.rotation() * motion;
  const double largest = point.b.size() > 0 ? point.b.cwiseAbs().maxCoeff() : 0.0;
  point.b = (point.b.array().abs() > round_off_of_shapes * largest)
                .select(point.b, 0.0); // a direction that is not used costs nothing
  point.support.obstacle = obstacle_of(contact, placed);
  point.support.normal = {contact.normal_stiffness, contact.normal_damping};
  if (contact.friction_static > 0.0) {
    auto& friction = point.support.friction;
    friction.stiffness = contact.tangential_stiffness;
    friction.mu_static = contact.friction_static;
    friction.mu_dynamic = contact.friction_dynamic;
    friction.kind = contact.memory == study::FrictionMemory::reference
                        ? contact::FrictionMemoryKind::reference
                        : contact::FrictionMemoryKind::return_map;
    friction.damping = contact.tangential_damping
                           ? *contact.tangential_damping
                           : automatic_damping(contact, placed.name, out.scene.system, point);
    if (!contact.tangential_damping)
      out.notes.push_back(fmt::format("contact \"{}\": automatic tangential damping {:.4g} N s/m",
                                      placed.name, friction.damping));
  }
  const double gap = contact::locate(point.support.obstacle, placed.rest.y(), placed.rest.z()).gap;
  if (gap < 0.0)
    out.notes.push_back(
        fmt::format("contact \"{}\" starts with an overlap of {:.4g} m: it presses with {:.4g} N",
                    placed.name, -gap, -gap * contact.normal_stiffness));
  out.scene.contacts.push_back(std::move(point));
}

} // namespace

std::vector<NamedNode> observed_nodes(const study::Study& study, const mesh::LineMesh& mesh) {
  std::vector<NamedNode> out;
  for (const std::string& group : study.output.nodes) {
    const std::vector<Index> nodes = mesh::group_nodes(mesh, group, "[output] nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
      out.push_back({nodes.size() == 1 ? group : fmt::format("{}[{}]", group, i), nodes[i]});
  }
  return out;
}

Fields build_fields(const study::Study& study, const mesh::LineMesh& mesh, const BuiltModel& built) {
  Fields out;
  for (std::size_t e = 0; e < study.loads.size(); ++e) {
    const std::string name = fmt::format("[[loads]] entry {} on \"{}\"", e + 1, study.loads[e].group);
    out.loads.push_back({name, study.loads[e].function, load_field(study.loads[e], name, mesh, built)});
  }
  const auto on_all_masses = [&](const core::Vec3& direction) {
    return fem::mass_times(built.model, fem::translation_field(built.model, direction));
  };
  if (study.gravity)
    out.loads.push_back({"[gravity]", transient::Constant{1.0}, on_all_masses(*study.gravity)});
  for (const auto& motion : study.base_motions)
    out.loads.push_back({"[[base_motion]]", motion.acceleration, -on_all_masses(motion.direction)});
  initial_field(study, mesh, built.model, out);
  return out;
}

std::vector<std::vector<std::size_t>> joined_structures(const std::vector<modal::Basis>& bases,
                                                        const std::vector<PlacedContact>& contacts) {
  std::vector<std::size_t> root(bases.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t s) {
    while (root[s] != s)
      s = root[s];
    return s;
  };
  const auto structure_of = [&](Index node) {
    const auto has = [&](const modal::Basis& basis) { return basis.row_of(node) >= 0; };
    return static_cast<std::size_t>(std::find_if(bases.begin(), bases.end(), has) - bases.begin());
  };
  for (const PlacedContact& contact : contacts) {
    if (contact.other < 0)
      continue;
    const std::size_t a = structure_of(contact.node), b = structure_of(contact.other);
    if (a < bases.size() && b < bases.size())
      root[std::max(find(a), find(b))] = std::min(find(a), find(b));
  }
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> group_of(bases.size());
  for (std::size_t s = 0; s < bases.size(); ++s) {
    const std::size_t lowest = find(s);
    if (lowest == s) {
      group_of[s] = groups.size();
      groups.emplace_back();
    }
    groups[group_of[lowest]].push_back(s);
  }
  return groups;
}

BuiltScene build_scene(const study::Study& study, const Fields& fields, const std::vector<modal::Basis>& all,
                       const std::vector<std::size_t>& structures, const std::vector<PlacedContact>& contacts,
                       const std::vector<NamedNode>& nodes) {
  BuiltScene out;
  out.structures = structures;
  std::vector<const modal::Basis*> bases;
  for (const std::size_t s : structures)
    bases.push_back(&all[s]);
  transient::Scene& scene = out.scene;
  scene.duration = study.transient->duration;
  add_system(bases, scene.system);
  for (const auto& load : fields.loads) {
    Eigen::VectorXd force(0);
    for (const modal::Basis* basis : bases)
      append(force, basis->shapes.transpose() * restricted(*basis, load.force));
    scene.loads.push_back({load.function, force});
  }
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(scene.system.size());
  if (fields.moves_at_start) {
    scene.q0 = project(bases, fields.displacement_momentum, fields.displacement, "displacement", out);
    scene.v0 = project(bases, fields.velocity_momentum, fields.velocity, "velocity", out);
  }
  const auto mine = [&](Index node) {
    return node >= 0 && std::any_of(bases.begin(), bases.end(),
                                    [&](const modal::Basis* basis) { return basis->row_of(node) >= 0; });
  };
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (mine(contacts[c].node) || mine(contacts[c].other)) {
      add_contact(study.contacts[contacts[c].entry], contacts[c], bases, out);
      out.contacts.push_back(c);
    }
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (mine(nodes[k].node)) {
      out.nodes.push_back({nodes[k].name, translations(bases, nodes[k].node, scene.system.size())});
      out.node_numbers.push_back(k);
    }
  return out;
}

} // namespace fretwork::app
