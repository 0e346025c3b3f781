// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/force_sites.hpp"
#include "app/contact_loads.hpp"
#include "core/error.hpp"
#include "fem/beam_axis.hpp"
#include "fem/beam_element.hpp"
#include "fem/beam_point.hpp"
#include "modal/static_solvers.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace fretwork::app {
namespace {

using core::Index;

/// Components of forces, and of moments, below this share of their largest are round-off; or below the second of the largest of the others,
/// at an arm of 1 m.
constexpr double round_off_of_forces = 1e-10, round_off_of_others = 1e-13;

void drop_round_off_of_forces(Eigen::MatrixXd& rows) {
  if (rows.size() == 0)
    return;
  const double force = rows.topRows<3>().cwiseAbs().maxCoeff(),
               moment = rows.bottomRows<3>().cwiseAbs().maxCoeff();
  const auto drop = [](auto part, double own, double other) {
    const double least = std::max(round_off_of_forces * own, round_off_of_others * other);
    part = (part.array().abs() >= least).select(part, 0.0).eval();
  };
  drop(rows.topRows<3>(), force, moment);
  drop(rows.bottomRows<3>(), moment, force);
}

void add_sections(const std::string& group, const mesh::LineMesh& mesh, const fem::Model& model,
                  std::vector<results::ForceSite>& out) {
  double s = 0.0;
  Index last = -1;
  for (const Index line : mesh::group_lines(mesh, group, "[output] section_forces")) {
    const fem::Beam& beam = model.beams[static_cast<std::size_t>(line)];
    if (beam.a != last)
      s = 0.0; // of the next curve
    out.push_back({group, beam.a, line, false, s});
    s += fem::BeamAxis(model.node(beam.a), model.node(beam.b), beam.middle).length();
    out.push_back({group, beam.b, line, true, s});
    last = beam.b;
  }
}

/// The free dofs of a node that springs or dampers hold to the ground, bit d set = dof d.
std::uint8_t grounded_dofs(const fem::Model& model, Index node) {
  unsigned out = 0;
  for (const fem::Spring& spring : model.springs)
    for (std::size_t d = 0; spring.other < 0 && spring.node == node && d < spring.stiffness.size(); ++d)
      if (!model.is_fixed(node, static_cast<int>(d)) &&
          (spring.stiffness[d] > 0.0 || spring.damping[d] > 0.0))
        out |= 1u << d;
  return static_cast<std::uint8_t>(out);
}

void add_restraints(const std::string& group, const mesh::LineMesh& mesh, const fem::Model& model,
                    std::vector<results::ForceSite>& out) {
  const std::vector<Index> nodes = mesh::group_nodes(mesh, group, "[output] reactions");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    results::ForceSite site{nodes.size() == 1 ? group : fmt::format("{}[{}]", group, i), nodes[i]};
    site.fixed = model.fixed[static_cast<std::size_t>(nodes[i])] | grounded_dofs(model, nodes[i]);
    if (site.fixed == 0)
      throw core::Error(
          fmt::format("[output] reactions: neither [[restraints]] nor [[springs]] to the ground hold \"{}\", "
                      "at {}; name a group that is held",
                      site.name, fem::place(model.node(nodes[i]))));
    out.push_back(std::move(site));
  }
}

/// The beams, springs and dampers whose forces make up that of a site: of a restraint at the dofs that it fixes those of beams and springs to
/// other nodes, at the others those of springs to the ground.
class Following {
public:
  using Coefficients = std::array<double, 6> fem::Spring::*;

  Following(const results::ForceSite& site, const fem::Model& model) : site_(site), model_(model) {
    const auto add = [&](const fem::Beam& beam, bool at_b) {
      const fem::BeamElement element(model, beam);
      ends_.push_back({{beam.a, beam.b}, at_b, element, element.mass()});
    };
    if (site.is_section()) {
      add(model.beams[static_cast<std::size_t>(site.beam)], site.at_b);
      return;
    }
    for (const fem::Beam& beam : model.beams)
      for (const bool at_b : {false, true})
        if ((at_b ? beam.b : beam.a) == site.node)
          add(beam, at_b);
    for (const fem::Spring& spring : model.springs)
      if (spring.node == site.node || spring.other == site.node)
        springs_.push_back(spring);
  }

  /// @param at  the six values of a node   @param omega_squared  1/s2, 0 of a static motion
  /// @param along  N and N m at its dofs, what acts along the beam of a section besides
  template <class At>
  [[nodiscard]] fem::Vector6 force(At at, double omega_squared,
                                   const fem::Vector12& along = fem::Vector12::Zero()) const {
    fem::Vector6 sum = fem::Vector6::Zero();
    for (const End& end : ends_) {
      fem::Vector12 u;
      u << at(end.nodes[0]), at(end.nodes[1]);
      const fem::Vector12 held = end.element.elastic_force(u) - omega_squared * (end.mass * u);
      if (site_.is_section())
        return end.element.end_forces(held - along, end.at_b);
      sum += held.segment<6>(end.at_b ? 6 : 0);
    }
    return held(sum) + by_springs(at, &fem::Spring::stiffness);
  }

  /// N for values of nodes in m/s: what dampers add. @param at  the six values of a node
  template <class At> [[nodiscard]] fem::Vector6 damper_force(At at) const {
    return by_springs(at, &fem::Spring::damping);
  }

  /// What springs (or dampers) add where their ground moves.
  [[nodiscard]] fem::Vector6 by_ground(const fem::Vector6& ground, Coefficients of) const {
    fem::Vector6 sum = fem::Vector6::Zero();
    for (const fem::Spring& spring : springs_)
      if (spring.other < 0)
        sum += fem::Vector6::Map((spring.*of).data()).cwiseProduct(ground);
    return sum - held(sum);
  }

  [[nodiscard]] bool has_dampers() const {
    return std::any_of(springs_.begin(), springs_.end(), [](const fem::Spring& spring) {
      return std::any_of(spring.damping.begin(), spring.damping.end(), [](double c) { return c > 0.0; });
    });
  }

  /// Of a force on the node of a restraint what the restraint holds, springs left out.
  [[nodiscard]] fem::Vector6 held(fem::Vector6 force) const {
    for (int d = 0; d < core::dofs_per_node; ++d)
      if (!model_.is_fixed(site_.node, d))
        force(d) = 0.0;
    return force;
  }

  [[nodiscard]] std::optional<post::OuterFibre> fibre() const {
    if (!site_.is_section())
      return {};
    const fem::Beam& beam = model_.beams[static_cast<std::size_t>(site_.beam)];
    const fem::Section section =
        fem::property_at(model_.properties[static_cast<std::size_t>(beam.property)], beam.along[site_.at_b])
            .section;
    if (const auto radius = fem::outer_radius(section))
      return post::OuterFibre{true, section.area, *radius / section.iy, *radius / section.iz};
    if (const auto* bar = std::get_if<fem::Rectangle>(&section.shape))
      return post::OuterFibre{false, section.area, 0.5 * bar->height_z / section.iy,
                              0.5 * bar->height_y / section.iz};
    return {};
  }

private:
  template <class At> [[nodiscard]] fem::Vector6 by_springs(At at, Coefficients of) const {
    fem::Vector6 to_nodes = fem::Vector6::Zero(), to_ground = to_nodes;
    for (const fem::Spring& spring : springs_) {
      const fem::Vector6 here = at(site_.node);
      const auto coefficients = fem::Vector6::Map((spring.*of).data());
      if (spring.other < 0)
        to_ground -= coefficients.cwiseProduct(here);
      else
        to_nodes +=
            coefficients.cwiseProduct(here - at(spring.node == site_.node ? spring.other : spring.node));
    }
    return held(to_nodes) + to_ground - held(to_ground);
  }

  struct End {
    std::array<Index, 2> nodes;
    bool at_b;
    fem::BeamElement element;
    fem::Matrix12 mass;
  };
  const results::ForceSite& site_;
  const fem::Model& model_;
  std::vector<End> ends_;
  std::vector<fem::Spring> springs_;
};

/// The six values of a node in a field over a structure.
auto at_nodes(const modal::Basis& basis, Eigen::Ref<const Eigen::VectorXd> field) {
  return [&basis, field](Index node) { return fem::Vector6(field.segment<6>(basis.row_of(node))); };
}

/// omega^2, 0 of static modes.
double square_of_frequency(const modal::Basis& basis, Eigen::Index mode) {
  return mode < basis.true_modes() ? basis.omega(mode) * basis.omega(mode) : 0.0;
}

} // namespace

std::vector<results::ForceSite> force_sites(const study::Study& study, const mesh::LineMesh& mesh,
                                            const fem::Model& model) {
  std::vector<results::ForceSite> out;
  for (const std::string& group : study.output.section_forces)
    add_sections(group, mesh, model, out);
  for (const std::string& group : study.output.reactions)
    add_restraints(group, mesh, model, out);
  return out;
}

std::vector<LackingForce> lacking_forces(const std::vector<results::ForceSite>& sites, const ModelInModes& of,
                                         const Fields& fields, const std::vector<PlacedContact>& placed,
                                         std::vector<std::string>& notes) {
  const auto& [model, structures, bases] = of;
  for (const results::ForceSite& site : sites)
    if (!modal::structure_of(bases, site.node))
      throw core::Error(
          fmt::format("[output] {}: \"{}\" belongs to no structure that moves; name {}",
                      site.is_section() ? "section_forces" : "reactions", site.name,
                      site.is_section() ? "beams of one" : "the node of a beam, as the one tied to it"));
  const auto loads = static_cast<Eigen::Index>(fields.loads.size()),
             directions = static_cast<Eigen::Index>(3 * placed.size());
  std::vector<LackingForce> out(sites.size(),
                                {Eigen::MatrixXd::Zero(6, loads), Eigen::MatrixXd::Zero(6, directions)});
  if (sites.empty() || loads + directions == 0)
    return out;
  std::vector<std::size_t> contacts(placed.size());
  std::iota(contacts.begin(), contacts.end(), std::size_t{0});
  const auto do_without = [&](std::size_t structure, const std::exception& failure) {
    notes.push_back(fmt::format("section forces and reactions of structure {} have the modes only: {}",
                                structure + 1, failure.what()));
  };
  modal::StaticSolvers solvers(model, structures);
  for (std::size_t s = 0; s < bases.size(); ++s) {
    const modal::Basis& basis = bases[s];
    if (std::none_of(sites.begin(), sites.end(),
                     [&](const results::ForceSite& site) { return basis.row_of(site.node) >= 0; }))
      continue;
    const StructureLoads by_contacts = unit_forces(placed, contacts, basis);
    Eigen::MatrixXd forces(basis.shapes.rows(), loads + by_contacts.forces.cols());
    for (Eigen::Index l = 0; l < loads; ++l)
      forces.col(l) = restricted(basis, fields.loads[static_cast<std::size_t>(l)].force);
    forces.rightCols(by_contacts.forces.cols()) = by_contacts.forces;
    Eigen::MatrixXd deflections;
    try {
      deflections = solvers.of(s).solve(forces);
    } catch (const core::Error& failure) {
      do_without(s, failure);
      continue;
    } catch (const core::ComputationError& failure) {
      do_without(s, failure);
      continue;
    }
    const Eigen::MatrixXd pushed = basis.shapes.transpose() * forces;
    for (std::size_t k = 0; k < sites.size(); ++k) {
      if (basis.row_of(sites[k].node) < 0)
        continue;
      const Following following(sites[k], model);
      Eigen::MatrixXd lacking(6, forces.cols());
      for (Eigen::Index l = 0; l < lacking.cols(); ++l) {
        fem::Vector12 along = fem::Vector12::Zero();
        if (l < loads && sites[k].is_section())
          if (const auto& of_load = fields.loads[static_cast<std::size_t>(l)].along_beam)
            along = of_load(model, sites[k].beam);
        lacking.col(l) = following.force(at_nodes(basis, deflections.col(l)), 0.0, along);
        if (!sites[k].is_section())
          lacking.col(l) -= following.held(forces.col(l).segment<6>(basis.row_of(sites[k].node)));
      }
      for (Eigen::Index i = 0; i < basis.size(); ++i)
        if (basis.omega(i) == 0.0)
          lacking += following.force(at_nodes(basis, basis.shapes.col(i)), -1.0) * pushed.row(i);
        else
          lacking -= following.force(at_nodes(basis, basis.shapes.col(i)), square_of_frequency(basis, i)) *
                     pushed.row(i) / (basis.omega(i) * basis.omega(i));
      drop_round_off_of_forces(lacking);
      out[k].of_loads = lacking.leftCols(loads);
      out[k].of_contacts(Eigen::all, by_contacts.among) = lacking.rightCols(by_contacts.forces.cols());
    }
  }
  return out;
}

void follow_forces(const std::vector<results::ForceSite>& sites, const std::vector<LackingForce>& lacking,
                   const fem::Model& model, const std::vector<modal::Basis>& bases, const Fields& fields,
                   BuiltScene& built) {
  Eigen::Index modes = 0, first = 0;
  for (const std::size_t s : built.structures)
    modes += bases[s].size();
  const auto supports = static_cast<Eigen::Index>(fields.supports.size());
  std::vector<Eigen::Index> directions; // of the scene's contacts
  for (const std::size_t c : built.contacts)
    for (Eigen::Index d = 0; d < 3; ++d)
      directions.push_back(static_cast<Eigen::Index>(3 * c) + d);
  for (const std::size_t s : built.structures) {
    const modal::Basis& basis = bases[s];
    for (std::size_t k = 0; k < sites.size(); ++k) {
      if (basis.row_of(sites[k].node) < 0)
        continue;
      const Following following(sites[k], model);
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6, modes);
      for (Eigen::Index i = 0; i < basis.size(); ++i)
        rows.col(first + i) =
            following.force(at_nodes(basis, basis.shapes.col(i)), square_of_frequency(basis, i));
      drop_round_off_of_forces(rows);
      post::FollowedForce force{sites[k].name, rows(Eigen::all, built.moving)};
      force.by_loads = lacking[k].of_loads;
      force.by_contacts = lacking[k].of_contacts(Eigen::all, directions);
      force.section = sites[k].is_section();
      force.fibre = following.fibre();
      if (supports > 0)
        force.imposed = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(built.scene.motions.size()));
      const bool damped = !force.section && following.has_dampers();
      if (damped) {
        Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(6, modes);
        for (Eigen::Index i = 0; i < basis.size(); ++i)
          rate.col(first + i) = following.damper_force(at_nodes(basis, basis.shapes.col(i)));
        force.by_velocity = rate(Eigen::all, built.moving);
        force.imposed_velocity = Eigen::MatrixXd::Zero(6, force.imposed.cols());
      }
      for (Eigen::Index m = 0; m < supports; ++m) {
        const Eigen::Index motion = force.imposed.cols() - supports + m;
        const auto at = [&](Index node) -> fem::Vector6 {
          return fields.supports[static_cast<std::size_t>(m)].segment<6>(static_cast<Eigen::Index>(node) *
                                                                         core::dofs_per_node);
        };
        const fem::Vector6 ground = fields.grounds[static_cast<std::size_t>(m)].segment<6>(
            static_cast<Eigen::Index>(sites[k].node) * core::dofs_per_node);
        force.imposed.col(motion) =
            following.force(at, 0.0) + (force.section ? fem::Vector6(fem::Vector6::Zero())
                                                      : following.by_ground(ground, &fem::Spring::stiffness));
        if (damped)
          force.imposed_velocity.col(motion) =
              following.damper_force(at) + following.by_ground(ground, &fem::Spring::damping);
      }
      built.forces.push_back(std::move(force));
      built.force_numbers.push_back(k);
    }
    first += basis.size();
  }
}

} // namespace fretwork::app
