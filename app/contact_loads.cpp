// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_loads.hpp"
#include <algorithm>
#include <array>
#include <map>

namespace fretwork::app {
namespace {

using Eigen::MatrixXd;

/// Below this share of the largest, how modes move a contact is the eigensolver's round-off.
constexpr double unmoved = 1e-11;

/// @param moved  how far the true modes move each column
std::vector<Eigen::Index> loaded_directions(const study::Study& study,
                                            const std::vector<PlacedContact>& placed,
                                            const std::vector<std::size_t>& contacts,
                                            const Eigen::VectorXd& moved) {
  std::vector<Eigen::Index> loaded;
  const double most = moved.size() > 0 ? moved.maxCoeff() : 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PlacedContact& contact = placed[contacts[k]];
    const auto [y, z] = contact::normal_directions(contact.obstacle);
    const study::Contact& law = study.contacts[contact.entry];
    const auto friction = contact::friction_directions(contact.obstacle, law.friction_along);
    const bool normal[] = {false, y, z};
    for (Eigen::Index d = 0; d < 3; ++d) {
      const Eigen::Index column = static_cast<Eigen::Index>(3 * k) + d;
      if (normal[d] || (law.friction_static > 0.0 && friction[static_cast<std::size_t>(d)] &&
                        moved(column) > unmoved * most))
        loaded.push_back(column);
    }
  }
  return loaded;
}

/// Of the columns of all directions those that are loaded.
StructureLoads restricted(const StructureLoads& all, const std::vector<Eigen::Index>& loaded) {
  StructureLoads out;
  std::vector<Eigen::Index> columns;
  for (std::size_t j = 0; j < all.among.size(); ++j)
    if (const auto found = std::lower_bound(loaded.begin(), loaded.end(), all.among[j]);
        found != loaded.end() && *found == all.among[j]) {
      columns.push_back(static_cast<Eigen::Index>(j));
      out.among.push_back(found - loaded.begin());
    }
  out.forces = all.forces(Eigen::all, columns);
  return out;
}

} // namespace

std::vector<std::size_t> contacts_of(const std::vector<modal::Basis>& bases,
                                     const std::vector<std::size_t>& structures,
                                     const std::vector<PlacedContact>& placed) {
  const auto of = [&](core::Index node) { // place among the structures; their number where none has it
    if (node < 0)
      return structures.size();
    const auto has = [&](std::size_t s) { return bases[s].row_of(node) >= 0; };
    return static_cast<std::size_t>(std::find_if(structures.begin(), structures.end(), has) -
                                    structures.begin());
  };
  // contacts of one structure by structures, then those between two: neighbours in the list move the same modes
  std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> by_structures;
  const std::size_t none = structures.size();
  for (std::size_t c = 0; c < placed.size(); ++c) {
    const std::size_t one = of(placed[c].node), two = of(placed[c].other);
    if (one == none && two == none)
      continue;
    const bool between = one != none && two != none && one != two;
    by_structures[{between ? 1 + std::min(one, two) : 0, between ? std::max(one, two) : std::min(one, two)}]
        .push_back(c);
  }
  std::vector<std::size_t> out;
  for (const auto& [key, numbers] : by_structures)
    out.insert(out.end(), numbers.begin(), numbers.end());
  return out;
}

StructureLoads unit_forces(const std::vector<PlacedContact>& placed, const std::vector<std::size_t>& contacts,
                           const modal::Basis& basis) {
  std::vector<std::size_t> here; // those that have a node of the structure
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PlacedContact& contact = placed[contacts[k]];
    const auto has = [&](const fem::NodeShare& share) { return basis.row_of(share.node) >= 0; };
    if (std::any_of(contact.motion.begin(), contact.motion.end(), has) ||
        (contact.other >= 0 && basis.row_of(contact.other) >= 0))
      here.push_back(k);
  }
  MatrixXd all = MatrixXd::Zero(basis.shapes.rows(), static_cast<Eigen::Index>(3 * here.size()));
  for (std::size_t i = 0; i < here.size(); ++i) {
    const PlacedContact& contact = placed[contacts[here[i]]];
    const Eigen::Matrix3d axes = contact.frame.rotation().transpose();
    const auto column = static_cast<Eigen::Index>(3 * i);
    for (const fem::NodeShare& share : contact.motion)
      if (const Eigen::Index row = basis.row_of(share.node); row >= 0)
        all.block<6, 3>(row, column) += share.weights.transpose() * axes;
    if (contact.other < 0)
      continue;
    if (const Eigen::Index row = basis.row_of(contact.other); row >= 0)
      all.block<3, 3>(row, column) -= axes;
  }
  StructureLoads out;
  std::vector<Eigen::Index> columns;
  for (Eigen::Index j = 0; j < all.cols(); ++j)
    if (!all.col(j).isZero(0.0)) {
      columns.push_back(j);
      out.among.push_back(static_cast<Eigen::Index>(3 * here[static_cast<std::size_t>(j / 3)]) + j % 3);
    }
  out.forces = all(Eigen::all, columns);
  return out;
}

ContactLoads contact_loads(const study::Study& study, const std::vector<modal::Basis>& bases,
                           const std::vector<std::size_t>& structures,
                           const std::vector<PlacedContact>& placed,
                           const std::vector<std::size_t>& contacts) {
  ContactLoads out;
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * contacts.size()));
  for (const std::size_t s : structures) {
    const StructureLoads& all = out.on.emplace_back(unit_forces(placed, contacts, bases[s]));
    const MatrixXd b = all.forces.transpose() * bases[s].shapes.leftCols(bases[s].true_modes());
    moved(all.among) = moved(all.among).cwiseMax(b.cwiseAbs().rowwise().maxCoeff());
  }
  out.directions = loaded_directions(study, placed, contacts, moved);
  for (StructureLoads& loads : out.on)
    loads = restricted(loads, out.directions);
  return out;
}

} // namespace fretwork::app
