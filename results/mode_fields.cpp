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

Eigen::Index most_true_modes(const RunResults& results) {
  Eigen::Index most = 0;
  for (const modal::Basis& basis : results.bases)
    most = std::max(most, basis.true_modes());
  return most;
}

} // namespace

Eigen::Index mode_count(const RunResults& results) {
  Eigen::Index most_static = 0;
  for (const modal::Basis& basis : results.bases)
    most_static = std::max(most_static, static_cast<Eigen::Index>(basis.static_modes));
  return most_true_modes(results) + most_static;
}

ModeField mode_field(const RunResults& results, Eigen::Index k) {
  const Eigen::Index most = most_true_modes(results);
  const bool is_static = k >= most;
  const Eigen::Index number = is_static ? k - most : k;
  const std::string name = fmt::format("{} {}", is_static ? "static mode" : "mode", number + 1);
  ModeField out{name + " of each structure", zero(results)};
  for (const modal::Basis& basis : results.bases) {
    const Eigen::Index column = is_static ? basis.true_modes() + number : number;
    if (column >= (is_static ? basis.size() : basis.true_modes()))
      continue;
    Field own = zero(results);
    add(basis, basis.shapes.col(column), own);
    const double largest = own.size() > 0 ? own.colwise().norm().maxCoeff() : 0.0;
    out.displacement += own / (largest > 0.0 ? largest : 1.0);
    if (results.bases.size() == 1)
      out.name = fmt::format("{}, {:.5g} Hz", name, basis.omega(column) / (2.0 * std::numbers::pi));
  }
  return out;
}

Motion motion(const RunResults& results, Eigen::Index index) {
  Motion out = Motion::Zero(6, static_cast<Eigen::Index>(results.nodes.size()));
  Eigen::Index first = 0;
  for (const modal::Basis& basis : results.bases) {
    assert(first + basis.size() <= results.series.modal_displacement.rows());
    const Eigen::VectorXd values =
        basis.shapes * results.series.modal_displacement.col(index).segment(first, basis.size());
    for (std::size_t i = 0; i < basis.nodes.size(); ++i)
      out.col(basis.nodes[i]) += values.segment<6>(static_cast<Eigen::Index>(6 * i));
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
