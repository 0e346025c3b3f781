// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_loads.hpp"
#include <algorithm>

namespace fretwork::app {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Below this share of the largest, how modes move a contact is the eigensolver's round-off.
constexpr double round_off_of_shapes = 1e-11;

/// Unit forces along x_loc y_loc z_loc of contacts on the nodes of a structure, 6 n x 3 nc; 0 where it has not the node.
MatrixXd unit_forces(const std::vector<PlacedContact>& placed, const std::vector<std::size_t>& contacts,
                     const modal::Basis& basis) {
  MatrixXd forces = MatrixXd::Zero(basis.shapes.rows(), static_cast<Index>(3 * contacts.size()));
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PlacedContact& contact = placed[contacts[k]];
    const Eigen::Matrix3d axes = contact.frame.rotation().transpose();
    const auto column = static_cast<Index>(3 * k);
    for (const fem::NodeShare& share : contact.motion)
      if (const Index row = basis.row_of(share.node); row >= 0)
        forces.block<6, 3>(row, column) += share.weights.transpose() * axes;
    if (contact.other < 0)
      continue;
    if (const Index row = basis.row_of(contact.other); row >= 0)
      forces.block<3, 3>(row, column) -= axes;
  }
  return forces;
}

/// The unit forces that act on a structure: numbers of their columns among all, and these columns.
StructureLoads forces_on(const std::vector<PlacedContact>& placed, const std::vector<std::size_t>& contacts,
                         const modal::Basis& basis) {
  const MatrixXd all = unit_forces(placed, contacts, basis);
  StructureLoads out;
  for (Index j = 0; j < all.cols(); ++j)
    if (!all.col(j).isZero(0.0))
      out.among.push_back(j);
  out.forces = all(Eigen::all, out.among);
  return out;
}

/// @param moved  how far the true modes move each column
std::vector<Index> loaded_directions(const study::Study& study, const std::vector<PlacedContact>& placed,
                                     const std::vector<std::size_t>& contacts, const Eigen::VectorXd& moved) {
  std::vector<Index> loaded;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PlacedContact& contact = placed[contacts[k]];
    const auto [y, z] = contact::normal_directions(contact.obstacle);
    const bool friction = study.contacts[contact.entry].friction_static > 0.0;
    const bool normal[] = {false, y, z};
    for (Index d = 0; d < 3; ++d) {
      const Index column = static_cast<Index>(3 * k) + d;
      if (normal[d] || (friction && moved(column) > round_off_of_shapes * moved.maxCoeff()))
        loaded.push_back(column);
    }
  }
  return loaded;
}

/// Of the columns of all directions those that are loaded.
StructureLoads restricted(const StructureLoads& all, const std::vector<Index>& loaded) {
  StructureLoads out;
  std::vector<Index> columns;
  for (std::size_t j = 0; j < all.among.size(); ++j)
    if (const auto found = std::lower_bound(loaded.begin(), loaded.end(), all.among[j]);
        found != loaded.end() && *found == all.among[j]) {
      columns.push_back(static_cast<Index>(j));
      out.among.push_back(found - loaded.begin());
    }
  out.forces = all.forces(Eigen::all, columns);
  return out;
}

} // namespace

std::vector<std::size_t> contacts_of(const std::vector<modal::Basis>& bases,
                                     const std::vector<std::size_t>& structures,
                                     const std::vector<PlacedContact>& placed) {
  const auto has = [&](core::Index node) {
    return node >= 0 && std::any_of(structures.begin(), structures.end(),
                                    [&](std::size_t s) { return bases[s].row_of(node) >= 0; });
  };
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < placed.size(); ++c)
    if (has(placed[c].node) || has(placed[c].other))
      out.push_back(c);
  return out;
}

ContactLoads contact_loads(const study::Study& study, const std::vector<modal::Basis>& bases,
                           const std::vector<std::size_t>& structures,
                           const std::vector<PlacedContact>& placed,
                           const std::vector<std::size_t>& contacts) {
  ContactLoads out;
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(static_cast<Index>(3 * contacts.size()));
  for (const std::size_t s : structures) {
    const StructureLoads& all = out.on.emplace_back(forces_on(placed, contacts, bases[s]));
    const MatrixXd b = all.forces.transpose() * bases[s].shapes.leftCols(bases[s].true_modes());
    moved(all.among) = moved(all.among).cwiseMax(b.cwiseAbs().rowwise().maxCoeff());
  }
  out.directions = loaded_directions(study, placed, contacts, moved);
  for (StructureLoads& loads : out.on)
    loads = restricted(loads, out.directions);
  return out;
}

} // namespace fretwork::app
