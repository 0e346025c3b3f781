// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_scene.hpp"
#include "app/contact_laws.hpp"
#include "app/fluidelastic.hpp"
#include "app/missing_flexibility.hpp"
#include "app/static_start.hpp"
#include "app/support_motion.hpp"
#include "core/error.hpp"
#include "fem/disjoint_sets.hpp"
#include "transient/modes/moving_modes.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fretwork::app {
namespace {

using core::Index;
using Bases =
    std::vector<const modal::Basis*>; ///< of the structures of a scene, their modes one after the other

/// Above this share lost by the projection of the initial field the run starts from something else than was
/// asked.
constexpr double lost_share_warning = 0.05;
/// Below this share of the largest, how modes move a contact and what acts on them is the eigensolver's round-off.
constexpr double round_off_of_shapes = 1e-11;
/// Couplings of a projected damping matrix below this share of its diagonal are round-off.
constexpr double negligible_coupling = 1e-12;

void append(Eigen::VectorXd& all, const Eigen::VectorXd& part) {
  const Eigen::Index before = all.size();
  all.conservativeResize(before + part.size());
  all.tail(part.size()) = part;
}

/// Initial modal coordinates of a field, structure after structure, and the share of the field that the modes lose.
Eigen::VectorXd project(const Bases& bases, const Eigen::VectorXd& momentum, const Eigen::VectorXd& field,
                        const char* name, BuiltScene& out) {
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
void add_system(const Bases& bases, vibration::System& system) {
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
    if (const Eigen::MatrixXd& c = basis->damping_matrix; c.size() > 0) {
      const double least = negligible_coupling * c.diagonal().cwiseAbs().maxCoeff();
      system.damping_matrix.block(first, first, basis->size(), basis->size()) =
          (c.array().abs() > least).select(c, 0.0); // modes that dampers do not couple cost nothing
    }
    first += basis->size();
  }
}

/// Numbers of the modes of the scene that are no static modes.
std::vector<Eigen::Index> true_modes(const Bases& bases) {
  std::vector<Eigen::Index> out;
  Eigen::Index first = 0;
  for (const modal::Basis* basis : bases) {
    for (Eigen::Index i = 0; i < basis->true_modes(); ++i)
      out.push_back(first + i);
    first += basis->size();
  }
  return out;
}

/// Stiffness and damping of some of the modes, each alone.
vibration::System of_modes(const vibration::System& system, const std::vector<Eigen::Index>& modes) {
  return {system.stiffness(modes), system.damping(modes), {}};
}

bool has_node(const Bases& bases, Index node) {
  return std::any_of(bases.begin(), bases.end(),
                     [&](const modal::Basis* basis) { return basis->row_of(node) >= 0; });
}

/// Adds weights times the six dofs of a node to the rows of a point, 3 x modes of the scene, global axes;
/// nothing where no structure of the scene has the node.
void add_motion(const Bases& bases, Index node, const Eigen::Matrix<double, 3, 6>& weights,
                Eigen::MatrixXd& rows) {
  Eigen::Index first = 0;
  for (const modal::Basis* basis : bases) {
    if (const Eigen::Index row = basis->row_of(node); row >= 0)
      rows.middleCols(first, basis->size()) += weights * basis->shapes.middleRows<6>(row);
    first += basis->size();
  }
}

/// The translations of a node.
Eigen::Matrix<double, 3, 6> translations() {
  Eigen::Matrix<double, 3, 6> out = Eigen::Matrix<double, 3, 6>::Zero();
  out.leftCols<3>().setIdentity();
  return out;
}

/// The six dofs of a node in the shapes of the support motions, 6 x motions.
Eigen::MatrixXd support_dofs(const Fields& fields, Index node) {
  Eigen::MatrixXd out(core::dofs_per_node, static_cast<Eigen::Index>(fields.supports.size()));
  for (std::size_t k = 0; k < fields.supports.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) =
        fields.supports[k].segment<6>(static_cast<Eigen::Index>(node) * core::dofs_per_node);
  return out;
}

/// What the motions of the scene do to a contact's point less its obstacle, global axes, 3 x motions; empty where nothing. The base
/// leaves behind an obstacle that stays in space; supports move the point, and the obstacles they carry.
Eigen::MatrixXd imposed_by_motions(const study::Study& study, const study::Contact& contact,
                                   const PlacedContact& placed, const Fields& fields,
                                   const transient::Scene& scene) {
  Eigen::MatrixXd imposed = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(scene.motions.size()));
  const auto supports = static_cast<Eigen::Index>(study.support_motions.size());
  const Eigen::Index bases = imposed.cols() - supports;
  for (Eigen::Index k = 0; contact.grounded && k < bases; ++k)
    imposed.col(k) = study.base_motions[static_cast<std::size_t>(k)].direction;
  for (const fem::NodeShare& share : placed.motion)
    imposed.rightCols(supports) += share.weights * support_dofs(fields, share.node);
  if (placed.other >= 0)
    imposed.rightCols(supports) -= support_dofs(fields, placed.other).topRows(3);
  for (Eigen::Index k = 0; k < supports; ++k)
    if (const auto& motion = study.support_motions[static_cast<std::size_t>(k)];
        contact.carrier == motion.group)
      imposed.col(bases + k) -= motion.direction;
  // a static solution leaves round-off where the obstacle moves as its node does
  constexpr double round_off = 1e-9; // of a support's unit motion
  imposed = (imposed.array().abs() < round_off).select(0.0, imposed);
  return imposed.isZero(0.0) ? Eigen::MatrixXd() : imposed;
}

/// The structures of a scene that have a node of a contact.
Bases touched_by(const Bases& all, const PlacedContact& placed) {
  Bases out;
  for (const modal::Basis* basis : all)
    if ((placed.other >= 0 && basis->row_of(placed.other) >= 0) ||
        std::any_of(placed.motion.begin(), placed.motion.end(),
                    [&](const fem::NodeShare& share) { return basis->row_of(share.node) >= 0; }))
      out.push_back(basis);
  return out;
}

/// Where the modes of some structures are among those of all.
std::vector<vibration::ModeRange> modes_of(const Bases& some, const Bases& all) {
  std::vector<vibration::ModeRange> out;
  Eigen::Index first = 0;
  for (const modal::Basis* basis : all) {
    if (std::find(some.begin(), some.end(), basis) != some.end())
      out.push_back({first, basis->size()});
    first += basis->size();
  }
  return out;
}

void add_contact(const study::Study& study, const study::Contact& contact, const PlacedContact& placed,
                 const Bases& all, const Fields& fields, BuiltScene& out) {
  const Bases touched = touched_by(all, placed);
  Eigen::Index modes = 0;
  for (const modal::Basis* basis : touched)
    modes += basis->size();
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(3, modes);
  for (const fem::NodeShare& share : placed.motion)
    add_motion(touched, share.node, share.weights, motion);
  if (placed.other >= 0)
    add_motion(touched, placed.other, -translations(), motion);
  transient::ContactPoint point;
  point.name = placed.name;
  point.rest = placed.rest;
  point.b = placed.frame.rotation() * motion;
  if (all.size() > 1)
    point.modes = modes_of(touched, all);
  const double largest = point.b.size() > 0 ? point.b.cwiseAbs().maxCoeff() : 0.0;
  point.b = (point.b.array().abs() > round_off_of_shapes * largest)
                .select(point.b, 0.0); // a direction that is not used costs nothing
  if (const auto imposed = imposed_by_motions(study, contact, placed, fields, out.scene); imposed.size() > 0)
    point.imposed = placed.frame.rotation() * imposed;
  const TrueModes its = true_modes_of(point, out.true_modes);
  point.support =
      support_of(contact, placed, of_modes(out.scene.system, its.modes), point.b(Eigen::all, its.columns));
  out.scene.contacts.push_back(std::move(point));
}

/// What the support motions do to an observed node; the base's are not counted.
Eigen::MatrixXd imposed_on_node(const study::Study& study, Index node, const Fields& fields,
                                const transient::Scene& scene) {
  if (study.support_motions.empty())
    return {};
  Eigen::MatrixXd imposed = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(scene.motions.size()));
  imposed.rightCols(static_cast<Eigen::Index>(study.support_motions.size())) =
      support_dofs(fields, node).topRows(3);
  return imposed;
}

/// Forces and initial values that are round-off beside the largest, in modes that no contact moves.
void drop_round_off(transient::Scene& scene) {
  Eigen::Array<bool, Eigen::Dynamic, 1> meets =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(scene.system.size(), false);
  for (const transient::ContactPoint& point : scene.contacts)
    point.for_ranges([&](Eigen::Index first, const auto& part) {
      auto here = meets.segment(first, part.cols());
      here = (here || (part.array() != 0.0).colwise().any().transpose()).eval();
    });
  const auto drop = [&](Eigen::VectorXd& values) {
    const double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
    values = (meets || values.array().abs() > round_off_of_shapes * largest).select(values, 0.0).eval();
  };
  for (vibration::Load& load : scene.loads)
    drop(load.modal_force);
  for (signals::SampledLoad& load : scene.sampled_loads) {
    drop(load.rms);
    load.scale = (load.rms.array() != 0.0).select(load.scale, 0.0).eval();
  }
  drop(scene.q0);
  drop(scene.v0);
}

/// Modes that nothing moves cost nothing.
void leave_out_still_modes(BuiltScene& out) {
  transient::Scene& scene = out.scene;
  drop_round_off(scene);
  out.modes = scene.system.size();
  out.moving = transient::moving_modes(scene);
  const auto still = out.modes - static_cast<Eigen::Index>(out.moving.size());
  if (still == 0)
    return;
  scene = transient::with_modes(scene, out.moving);
  std::vector<Eigen::Index> true_and_moving;
  for (std::size_t k = 0; k < out.moving.size(); ++k)
    if (std::binary_search(out.true_modes.begin(), out.true_modes.end(), out.moving[k]))
      true_and_moving.push_back(static_cast<Eigen::Index>(k));
  out.true_modes = std::move(true_and_moving);
  for (post::ObservedNode& node : out.nodes)
    node.rows = node.rows(Eigen::all, out.moving).eval();
  out.notes.push_back(fmt::format("{} of {} modes are moved by no load, contact or initial state: they stay "
                                  "at rest and the run leaves them out",
                                  still, out.modes));
}

} // namespace

Eigen::VectorXd restricted(const modal::Basis& basis, const Eigen::VectorXd& field) {
  Eigen::VectorXd out(basis.shapes.rows());
  for (std::size_t i = 0; i < basis.nodes.size(); ++i)
    out.segment<6>(static_cast<Eigen::Index>(6 * i)) =
        field.segment<6>(static_cast<Eigen::Index>(basis.nodes[i]) * 6);
  return out;
}

TrueModes true_modes_of(const transient::ContactPoint& point, const std::vector<Eigen::Index>& true_modes) {
  TrueModes out;
  Eigen::Index column = 0;
  point.for_ranges([&](Eigen::Index first, const auto& part) {
    auto mode = std::lower_bound(true_modes.begin(), true_modes.end(), first);
    for (; mode != true_modes.end() && *mode < first + part.cols(); ++mode) {
      out.columns.push_back(column + *mode - first);
      out.modes.push_back(*mode);
    }
    column += part.cols();
  });
  return out;
}

std::vector<NamedNode> observed_nodes(const study::Study& study, const mesh::LineMesh& mesh) {
  std::vector<NamedNode> out;
  std::map<std::string, std::string> group_of; // by name of the node
  for (const std::string& group : study.output.nodes) {
    const std::vector<Index> nodes = mesh::group_nodes(mesh, group, "[output] nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      out.push_back({nodes.size() == 1 ? group : fmt::format("{}[{}]", group, i), nodes[i]});
      const auto [seen, is_new] = group_of.emplace(out.back().name, group);
      if (!is_new)
        throw core::Error(fmt::format("[output] nodes: groups \"{}\" and \"{}\" both have a node called "
                                      "\"{}\"; leave one of them out, or rename it in the mesh",
                                      seen->second, group, out.back().name));
    }
  }
  return out;
}

std::vector<std::vector<std::size_t>> joined_structures(const std::vector<modal::Basis>& bases,
                                                        const std::vector<PlacedContact>& contacts,
                                                        const std::vector<FluidForces>& fluid) {
  fem::DisjointSets sets(bases.size());
  for (const PlacedContact& contact : contacts) {
    const auto a = modal::structure_of(bases, contact.node), b = modal::structure_of(bases, contact.other);
    if (a && b)
      sets.join(static_cast<Index>(*a), static_cast<Index>(*b));
  }
  for (const FluidForces& law : fluid)
    for (const std::size_t s : law.structures)
      sets.join(static_cast<Index>(law.structures.front()), static_cast<Index>(s));
  std::size_t number = 0;
  const auto label = sets.labels(number);
  std::vector<std::vector<std::size_t>> groups(number);
  for (std::size_t s = 0; s < bases.size(); ++s)
    groups[label[s]].push_back(s);
  return groups;
}

BuiltScene build_scene(const study::Study& study, const std::vector<modal::Basis>& all,
                       const std::vector<PlacedContact>& contacts, const std::vector<NamedNode>& nodes,
                       const Fields& fields, CoupledStructures coupled) {
  const std::vector<std::size_t>& structures = coupled.structures;
  const ContactFlexibility& flexibility = coupled.flexibility;
  BuiltScene out;
  out.structures = structures;
  Bases bases;
  for (const std::size_t s : structures)
    bases.push_back(&all[s]);
  transient::Scene& scene = out.scene;
  scene.duration = study.transient->duration;
  add_system(bases, scene.system);
  add_motion_forces(fields.motion, structures, all, scene.system);
  out.true_modes = true_modes(bases);
  for (const auto& load : fields.loads) {
    Eigen::VectorXd force(0);
    for (const modal::Basis* basis : bases)
      append(force, basis->shapes.transpose() * restricted(*basis, load.force));
    scene.loads.push_back({load.function, force, load.inertial});
  }
  scene.sampled_loads = std::move(coupled.turbulence);
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(scene.system.size());
  if (fields.moves_at_start) {
    scene.q0 = project(bases, fields.displacement_momentum, fields.displacement, "displacement", out);
    scene.v0 = project(bases, fields.velocity_momentum, fields.velocity, "velocity", out);
  }
  const bool grounded = std::any_of(study.contacts.begin(), study.contacts.end(),
                                    [](const study::Contact& contact) { return contact.grounded; });
  if (grounded)
    for (const study::BaseMotion& motion : study.base_motions)
      scene.motions.push_back(prescribed(motion));
  for (const study::SupportMotion& motion : study.support_motions)
    scene.motions.push_back(prescribed(motion));
  out.contacts = flexibility.contacts;
  for (const std::size_t c : out.contacts)
    add_contact(study, study.contacts[contacts[c].entry], contacts[c], bases, fields, out);
  if (!out.contacts.empty() && flexibility.failure.empty())
    find_missing(flexibility, out);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (has_node(bases, nodes[k].node)) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, scene.system.size());
      add_motion(bases, nodes[k].node, translations(), rows);
      out.nodes.push_back(
          {nodes[k].name, std::move(rows), imposed_on_node(study, nodes[k].node, fields, scene)});
      out.node_numbers.push_back(k);
    }
  if (study.transient->start == study::Start::equilibrium)
    start_in_equilibrium(bases, contacts, out);
  leave_out_still_modes(out);
  return out;
}

} // namespace fretwork::app
