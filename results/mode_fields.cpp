// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/mode_fields.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::results {
namespace {

/// Adds the translations of a structure's field (6 values a node) to a field over the mesh.
void add(const modal::Basis& basis, const Eigen::VectorXd& values, Field& field) {
  for (std::size_t i = 0; i < basis.nodes.size(); ++i)
    field.col(basis.nodes[i]) += values.segment<3>(static_cast<Eigen::Index>(6 * i));
}

Field zero(const RunResults& results) {
  return Field::Zero(3, static_cast<Eigen::Index>(results.nodes.size()));
}

} // namespace

Eigen::Index mode_count(const RunResults& results) {
  Eigen::Index most = 0;
  for (const modal::Basis& basis : results.bases)
    most = std::max(most, basis.size());
  return most;
}

ModeField mode_field(const RunResults& results, Eigen::Index k) {
  ModeField out{fmt::format("mode {} of each structure", k + 1), zero(results)};
  for (const modal::Basis& basis : results.bases) {
    if (k >= basis.size())
      continue;
    Field own = zero(results);
    add(basis, basis.shapes.col(k), own);
    const double largest = own.size() > 0 ? own.colwise().norm().maxCoeff() : 0.0;
    out.displacement += own / (largest > 0.0 ? largest : 1.0);
    if (results.bases.size() == 1)
      out.name = fmt::format("{} {}, {:.5g} Hz", k < basis.true_modes() ? "mode" : "static mode",
                             k < basis.true_modes() ? k + 1 : k - basis.true_modes() + 1,
                             basis.omega(k) / (2.0 * std::numbers::pi));
  }
  return out;
}

Field motion(const RunResults& results, Eigen::Index index) {
  Field out = zero(results);
  Eigen::Index first = 0;
  for (const modal::Basis& basis : results.bases) {
    assert(first + basis.size() <= results.series.modal_displacement.rows());
    add(basis, basis.shapes * results.series.modal_displacement.col(index).segment(first, basis.size()), out);
    first += basis.size();
  }
  return out;
}

std::vector<core::Index> lone_nodes(const RunResults& results) {
  std::vector<char> used(results.nodes.size(), 0);
  for (const auto& line : results.lines)
    for (const core::Index node : line)
      used[static_cast<std::size_t>(node)] = 1;
  std::vector<core::Index> lone;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      lone.push_back(static_cast<core::Index>(i));
  return lone;
}

void require_mesh(const RunResults& results) {
  if (results.nodes.empty())
    throw core::Error("these results hold modes without a mesh to show them on; run `fretwork run` or "
                      "`fretwork modes` again");
}

} // namespace fretwork::results
