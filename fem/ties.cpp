// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/ties.hpp"
#include "fem/disjoint_sets.hpp"

namespace fretwork::fem {

std::vector<Index> first_tied(const Model& model) {
  DisjointSets sets(model.nodes.size() * dofs_per_node);
  for (const Tie& tie : model.ties)
    for (int d = 0; d < dofs_per_node; ++d)
      if ((tie.dofs >> d) & 1u)
        sets.join(tie.node * dofs_per_node + d, tie.other * dofs_per_node + d);
  std::vector<Index> first(model.nodes.size() * dofs_per_node);
  for (std::size_t dof = 0; dof < first.size(); ++dof)
    first[dof] = sets.root(static_cast<Index>(dof));
  return first;
}

void restrain_tied(Model& model) {
  const std::vector<Index> first = first_tied(model);
  const auto bits = [&](Index dof) -> std::uint8_t& {
    return model.fixed[static_cast<std::size_t>(dof / dofs_per_node)];
  };
  const auto restrain = [&](Index to, Index from) {
    if (model.is_fixed(from / dofs_per_node, from % dofs_per_node))
      bits(to) = static_cast<std::uint8_t>(bits(to) | 1u << (to % dofs_per_node));
  };
  const auto dofs = static_cast<Index>(first.size());
  for (Index dof = 0; dof < dofs; ++dof)
    restrain(first[static_cast<std::size_t>(dof)], dof);
  for (Index dof = 0; dof < dofs; ++dof)
    restrain(dof, first[static_cast<std::size_t>(dof)]);
}

void follow_ties(const Model& model, Eigen::VectorXd& field) {
  if (model.ties.empty())
    return;
  const std::vector<Index> first = first_tied(model);
  for (std::size_t dof = 0; dof < first.size(); ++dof)
    if (const double value = field[static_cast<Eigen::Index>(dof)]; value != 0.0)
      field[first[dof]] = value;
  for (std::size_t dof = 0; dof < first.size(); ++dof)
    field[static_cast<Eigen::Index>(dof)] = field[first[dof]];
}

} // namespace fretwork::fem
