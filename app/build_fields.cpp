// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_fields.hpp"
#include "core/error.hpp"
#include "fem/fields.hpp"
#include "fem/ties.hpp"
#include "fem/weight.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

using core::Index;
using core::Vec3;

using AlongBeam = std::function<fem::Vector12(const fem::Model&, core::Index)>;

const fem::Beam& beam_of(const fem::Model& model, core::Index beam) {
  return model.beams[static_cast<std::size_t>(beam)];
}

/// Of the inertia of all masses that move as a field over the model.
AlongBeam inertia_along(Eigen::VectorXd field) {
  return [field = std::move(field)](const fem::Model& model, core::Index number) {
    const fem::Beam& beam = beam_of(model, number);
    fem::Vector12 moved;
    moved << field.segment<6>(core::dofs_per_node * static_cast<Eigen::Index>(beam.a)),
        field.segment<6>(core::dofs_per_node * static_cast<Eigen::Index>(beam.b));
    return fem::Vector12(-(fem::BeamElement(model, beam).mass() * moved));
  };
}

/// Of a force per length on some beams.
AlongBeam line_force_along(std::vector<core::Index> beams, const Vec3& force) {
  std::sort(beams.begin(), beams.end());
  return [beams = std::move(beams), force](const fem::Model& model, core::Index number) {
    return std::binary_search(beams.begin(), beams.end(), number)
               ? fem::BeamElement(model, beam_of(model, number)).line_force(force)
               : fem::Vector12(fem::Vector12::Zero());
  };
}

/// Forces of the moved supports on what is left of the motion: the inertia of the static shape, and the dampers that it stretches.
void support_loads(const study::SupportMotion& motion, const std::string& name, const fem::Model& model,
                   const SupportFields& fields, std::vector<Fields::Load>& loads) {
  const signals::PrescribedMotion moved = prescribed(motion);
  loads.push_back({name, moved.acceleration, -fem::mass_times(model, fields.shape), true, true,
                   motion.by_displacement, inertia_along(fields.shape)});
  if (!fields.dampers.isZero(0.0))
    loads.push_back({name + ", dampers", signals::velocity_of(moved), fields.dampers, true, true});
}

Eigen::VectorXd load_field(const study::Load& load, const std::string& what, const mesh::LineMesh& mesh,
                           const fem::Model& model) {
  if (!load.per_length)
    return fem::point_forces(model, mesh::group_nodes(mesh, load.group, what), load.direction, load.moment);
  // every line of the mesh is the beam of its number
  return fem::line_forces(model, mesh::group_lines(mesh, load.group, what), load.direction);
}

/// Of a force on each node of a curve, as that of a force per length is often meant; else empty.
std::string on_curve_note(const study::Load& load, const std::string& name, const mesh::LineMesh& mesh) {
  if (load.per_length || load.moment || !mesh.curves.contains(load.group) || mesh.points.contains(load.group))
    return {};
  const std::size_t nodes = mesh::group_nodes(mesh, load.group, name).size();
  return fmt::format(
      "{} acts in full at each of the {} nodes of the curve \"{}\", {} times its value in all; "
      "per_length = true makes it a force per metre",
      name, nodes, load.group, nodes);
}

void follow_ties(const fem::Model& model, const char* what, const std::vector<bool>& given,
                 Eigen::VectorXd& field) {
  try {
    fem::follow_ties(model, given, field);
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("[[initial]] {}: {}", what, error.what()));
  }
}

void initial_field(const study::Study& study, const mesh::LineMesh& mesh, const fem::Model& model,
                   Fields& out) {
  if (study.initial.empty())
    return;
  out.moves_at_start = true;
  out.displacement.setZero(static_cast<Eigen::Index>(model.nodes.size()) * core::dofs_per_node);
  out.velocity = out.displacement;
  std::vector<bool> displaced(static_cast<std::size_t>(out.displacement.size()), false), moves = displaced;
  const auto mark = [](std::vector<bool>& given, const Eigen::VectorXd& field, Eigen::Index row) {
    for (Eigen::Index d = row; d < row + core::dofs_per_node; ++d)
      given[static_cast<std::size_t>(d)] = field(d) != 0.0;
  };
  for (std::size_t e = 0; e < study.initial.size(); ++e) {
    const study::Initial& initial = study.initial[e];
    const std::string name = fmt::format("[[initial]] entry {}", e + 1);
    bool idle = !(initial.displacement.isZero(0.0) && initial.velocity.isZero(0.0) &&
                  initial.rotation_rate.isZero(0.0)); // rest is a state too
    for (const Index node : mesh::group_nodes(mesh, initial.group, name)) {
      const Eigen::Index row = static_cast<Eigen::Index>(node) * core::dofs_per_node;
      const Vec3 arm = model.nodes[static_cast<std::size_t>(node)] - initial.centre;
      out.displacement.segment<6>(row) << initial.displacement, Vec3::Zero();
      out.velocity.segment<6>(row) << initial.velocity + initial.rotation_rate.cross(arm),
          initial.rotation_rate;
      mark(displaced, out.displacement, row); // zeros give nothing
      mark(moves, out.velocity, row);
      for (int d = 0; d < core::dofs_per_node; ++d)
        idle = idle && (model.is_fixed(node, d) ||
                        (out.displacement(row + d) == 0.0 && out.velocity(row + d) == 0.0));
    }
    if (idle)
      out.warnings.push_back(fmt::format(
          "{} on \"{}\" moves nothing: its nodes are restrained in its directions; apply it elsewhere", name,
          initial.group));
  }
  follow_ties(model, "displacement", displaced, out.displacement);
  follow_ties(model, "velocity", moves, out.velocity);
  for (std::size_t node = 0; node < model.nodes.size(); ++node)
    for (int d = 0; d < core::dofs_per_node; ++d)
      if (model.is_fixed(static_cast<Index>(node), d)) {
        const auto row = static_cast<Eigen::Index>(node) * core::dofs_per_node + d;
        out.displacement(row) = out.velocity(row) = 0.0;
      }
  out.displacement_momentum = fem::mass_times(model, out.displacement);
  out.velocity_momentum = fem::mass_times(model, out.velocity);
}

} // namespace

std::string name_of_load(const study::Load& load, std::size_t entry) {
  return load.name.empty() ? fmt::format("[[loads]] entry {} on \"{}\"", entry + 1, load.group)
                           : fmt::format("load \"{}\"", load.name);
}

std::string name_of_support_motion(const study::SupportMotion& motion, std::size_t entry) {
  return fmt::format("[[support_motion]] entry {} of \"{}\"", entry + 1, motion.group);
}

Fields build_fields(const study::Study& study, const mesh::LineMesh& mesh, const fem::Model& model,
                    const std::vector<PlacedFlow>& flows, const std::vector<SupportFields>& supports) {
  Fields out;
  for (std::size_t e = 0; e < study.loads.size(); ++e) {
    const std::string name = name_of_load(study.loads[e], e);
    const study::Load& load = study.loads[e];
    out.loads.push_back({name, load.function, load_field(load, name, mesh, model)});
    if (std::string note = on_curve_note(load, name, mesh); !note.empty())
      out.notes.push_back(std::move(note));
    if (load.per_length)
      out.loads.back().along_beam =
          line_force_along(mesh::group_lines(mesh, load.group, name), load.direction);
  }
  const auto on_all_masses = [&](const core::Vec3& direction) {
    return fem::mass_times(model, fem::translation_field(model, direction));
  };
  if (study.gravity) {
    out.loads.push_back({"[gravity]", signals::Constant{1.0}, fem::weight(model, *study.gravity)});
    out.loads.back().along_beam = [gravity = *study.gravity](const fem::Model& of, core::Index beam) {
      return fem::weight(of, beam_of(of, beam), gravity);
    };
  }
  for (const PlacedFlow& flow : flows)
    if (auto force = steady_force(study, flow, model))
      out.loads.push_back({name_of(study.flows[flow.entry]), signals::Constant{1.0}, std::move(*force)});
  for (const auto& motion : study.base_motions) {
    out.loads.push_back({"[[base_motion]]", motion.acceleration, -on_all_masses(motion.direction), true});
    out.loads.back().along_beam = inertia_along(fem::translation_field(model, motion.direction));
  }
  for (std::size_t k = 0; k < supports.size(); ++k) {
    const study::SupportMotion& motion = study.support_motions[k];
    support_loads(motion, name_of_support_motion(motion, k), model, supports[k], out.loads);
    out.supports.push_back(supports[k].shape);
    out.grounds.push_back(supports[k].ground);
  }
  initial_field(study, mesh, model, out);
  return out;
}

} // namespace fretwork::app
