// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The mechanical model: beams, lumped masses, springs and dampers on nodes with restrained dofs. Plain data,
/// SI units, global axes unless said otherwise. Fields over the model are vectors of 6 values a node: ux uy
/// uz rx ry rz.
#pragma once
#include "core/types.hpp"
#include "fem/fluid_mass.hpp"
#include "fem/section.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::fem {

using core::dofs_per_node;
using core::Index;
using core::Vec3;

/// An isotropic elastic material.
struct Material {
  double young_modulus; ///< Pa, > 0
  double poisson_ratio; ///< -1 < nu < 0.5
  double density;       ///< kg/m3, >= 0
  bool operator==(const Material&) const = default;
};

/// The direction in which added (fluid) mass acts.
enum class AddedMass { transverse, all };

/// What a beam is made of at the far end of its group: from the one to the other end it changes linearly along
/// the beams' axes (sizes of the section, densities and masses of fluid and added mass, axial force).
struct Taper {
  Section section;
  double added_mass = 0.0;
  Fluid fluid = {};
  std::optional<double> axial_force = std::nullopt; ///< N; none: that of the property
  bool operator==(const Taper&) const = default;
};

/// What a beam is made of.
struct BeamProperty {
  Material material;
  Section section;
  double added_mass = 0.0; ///< kg/m, >= 0, besides that of the fluid
  AddedMass added_mass_direction = AddedMass::transverse;
  std::optional<Vec3> orientation =
      std::nullopt; ///< a vector in the local x-y plane; required where iy != iz
  double axial_force =
      0.0;          ///< N, of a static preload, tension > 0; straight beams only; one that changes by a taper
                    ///< is on each beam that at its middle
  Fluid fluid = {}; ///< in and around it; round sections only
  std::optional<Taper> taper = std::nullopt;
  bool operator==(const BeamProperty&) const = default;
};

/// A beam between nodes a and b: straight, or along the arc of a circle through a third point, which is no
/// node.
struct Beam {
  Index a, b;
  Index property;
  std::optional<Vec3> middle = std::nullopt; ///< on the arc, between its ends
  /// Where a and b are on the way of the property's taper, 0 to 1; of no meaning without one.
  std::array<double, 2> along = {0.0, 1.0};
  bool operator==(const Beam&) const = default;
};

/// A rigid body at a node.
struct LumpedMass {
  Index node;
  double mass;                 ///< kg, >= 0
  Vec3 inertia = Vec3::Zero(); ///< kg m2 about the body's own centre, >= 0
  Vec3 arm = Vec3::Zero();     ///< m, from the node to the body's centre
  bool operator==(const LumpedMass&) const = default;
};

/// Springs and dampers along the six dofs, grounded (other = -1) or between two nodes.
struct Spring {
  Index node;
  Index other = -1;
  std::array<double, 6> stiffness{}; ///< N/m, N m/rad, >= 0
  std::array<double, 6> damping{};   ///< N s/m, N m s/rad, >= 0
  bool operator==(const Spring&) const = default;
};

/// Components of two nodes that stay equal, u(node) = u(other): see ties.hpp.
struct Tie {
  Index node, other;
  std::uint8_t dofs; ///< bit d set = dof d tied
  bool operator==(const Tie&) const = default;
};

struct Model {
  std::vector<Vec3> nodes;
  std::vector<BeamProperty> properties;
  std::vector<Beam> beams;
  std::vector<LumpedMass> masses;
  std::vector<Spring> springs;
  std::vector<std::uint8_t> fixed; ///< per node: bit d set = dof d restrained
  std::vector<Tie> ties{};

  [[nodiscard]] const Vec3& node(Index number) const { return nodes[static_cast<std::size_t>(number)]; }
  [[nodiscard]] bool is_fixed(Index node, int dof) const {
    return (fixed[static_cast<std::size_t>(node)] >> dof) & 1u;
  }
};

/// A connected part of a model (through beams, springs between nodes and ties) and the numbering of its free
/// dofs.
struct Structure {
  std::vector<Index> nodes; ///< ascending
  std::vector<Index> beams; ///< ascending
  std::vector<Index> masses;
  std::vector<Index> springs;
  std::vector<Index> ties;
  std::vector<Index>
      equation; ///< 6 per entry of `nodes`: number of the free dof, one for dofs tied, -1 where restrained
  Index equations = 0;
};

/// The connected parts of the model, by ascending first node; a node that nothing touches is one by itself
/// (without equations where it is restrained). Equations are numbered by ascending nodes. Checks the whole
/// model on the way.
/// @throws core::Error for a property, mass or spring without sense, a beam without axes, and a free dof that
/// nothing gives mass
///         (a beam may have stiff dofs without mass), naming node, dof and cure; for a free dof tied to a
///         restrained one
[[nodiscard]] std::vector<Structure> structures(const Model& model);

/// Where `node` is in structure.nodes, or -1.
[[nodiscard]] Index position_of(const Structure& structure, Index node);

/// m, of structure.nodes.
[[nodiscard]] std::vector<Vec3> positions(const Model& model, const Structure& structure);

/// `(1, 0.5, 0)`: a point or vector in a message.
[[nodiscard]] std::string place(const Vec3& point);

/// Mass of beams (added mass included), kg, and of lumped masses.
[[nodiscard]] double total_mass(const Model& model);

} // namespace fretwork::fem
