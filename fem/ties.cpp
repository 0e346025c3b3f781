// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/ties.hpp"
#include "core/error.hpp"
#include "fem/disjoint_sets.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

/// Of values worked out at two nodes of one place.
constexpr double same_value = 1e-9;
constexpr std::array<const char*, dofs_per_node> component_names = {"ux", "uy", "uz", "rx", "ry", "rz"};

} // namespace

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

void follow_ties(const Model& model, const std::vector<bool>& given, Eigen::VectorXd& field) {
  if (model.ties.empty())
    return;
  const std::vector<Index> first = first_tied(model);
  std::vector<Index> source(first.size(), -1); // of a set of tied dofs, by its first: one that is given
  for (std::size_t dof = 0; dof < first.size(); ++dof) {
    if (!given[dof])
      continue;
    Index& from = source[static_cast<std::size_t>(first[dof])];
    if (from < 0)
      from = static_cast<Index>(dof);
    const double a = field[from], b = field[static_cast<Eigen::Index>(dof)];
    if (std::abs(a - b) > same_value * std::max(std::abs(a), std::abs(b)))
      throw core::Error(fmt::format("{} is tied between the nodes at {} and {}, but given as {:.6g} and "
                                    "{:.6g}; give it the same value, "
                                    "or at one of the nodes only",
                                    component_names[dof % dofs_per_node],
                                    place(model.nodes[static_cast<std::size_t>(from) / dofs_per_node]),
                                    place(model.nodes[dof / dofs_per_node]), a, b));
  }
  for (std::size_t dof = 0; dof < first.size(); ++dof)
    if (const Index from = source[static_cast<std::size_t>(first[dof])]; from >= 0)
      field[static_cast<Eigen::Index>(dof)] = field[from];
}

} // namespace fretwork::fem
