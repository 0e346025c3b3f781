// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/dense_modes.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "fem/node_blocks.hpp"
#include <Eigen/Cholesky>
#include <algorithm>

namespace fretwork::modal {
namespace {

/// Pivot of M with unit diagonal below which a combination of dofs has no mass: consistent mass matrices have
/// 1e-3 at least, the spin of a slender oblique beam 1e-8, round-off 1e-16.
constexpr double massless_pivot = 1e-13;

struct DensePencil {
  Eigen::MatrixXd stiffness, mass;
};

DensePencil dense_pencil(const fem::Model& model, const fem::Structure& structure) {
  const Eigen::Index n = structure.equations;
  DensePencil pencil{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  const auto blocks = fem::node_blocks(model, structure, 0, static_cast<core::Index>(structure.nodes.size()));
  const auto equation = [&](core::Index position, int d) {
    return structure.equation[static_cast<std::size_t>(position * core::dofs_per_node + d)];
  };
  for (std::size_t i = 0; i + 1 < blocks.start.size(); ++i)
    for (std::size_t b = blocks.start[i]; b < blocks.start[i + 1]; ++b)
      for (int d = 0; d < core::dofs_per_node; ++d)
        for (int e = 0; e < core::dofs_per_node; ++e) {
          const auto row = equation(static_cast<core::Index>(i), d), column = equation(blocks.column[b], e);
          if (row < 0 || column < 0)
            continue;
          pencil.stiffness(row, column) += blocks.stiffness[b](d, e);
          pencil.mass(row, column) += blocks.mass[b](d, e);
        }
  return pencil;
}

Eigen::Index mass_rank(const Eigen::MatrixXd& mass) {
  const Eigen::VectorXd scale =
      mass.diagonal().unaryExpr([](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 0.0; });
  const Eigen::LDLT<Eigen::MatrixXd> factor(scale.asDiagonal() * mass * scale.asDiagonal());
  return (factor.vectorD().array() > massless_pivot).count();
}

} // namespace

Eigen::MatrixXd free_rows(const fem::Structure& structure, const Eigen::MatrixXd& fields) {
  Eigen::MatrixXd vectors(structure.equations, fields.cols());
  for (Eigen::Index j = 0; j < fields.cols(); ++j)
    for (std::size_t i = 0; i < structure.equation.size(); ++i)
      if (structure.equation[i] >= 0)
        vectors(structure.equation[i], j) = fields(static_cast<Eigen::Index>(i), j);
  return vectors;
}

Eigen::MatrixXd all_rows(const fem::Structure& structure, const Eigen::MatrixXd& vectors) {
  Eigen::MatrixXd fields =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(structure.equation.size()), vectors.cols());
  for (Eigen::Index j = 0; j < vectors.cols(); ++j)
    for (std::size_t i = 0; i < structure.equation.size(); ++i)
      if (structure.equation[i] >= 0)
        fields(static_cast<Eigen::Index>(i), j) = vectors(structure.equation[i], j);
  return fields;
}

Pairs dense_modes(const fem::Model& model, const fem::Structure& structure, const Eigen::MatrixXd& rigid) {
  auto [stiffness, mass] = dense_pencil(model, structure);
  const Eigen::Index elastic = std::max<Eigen::Index>(0, mass_rank(mass) - rigid.cols());
  const Eigen::MatrixXd b = mass * free_rows(structure, rigid);
  const double scale = stiffness.trace() > 0.0 ? stiffness.trace() / mass.trace() : 1.0;
  mass -= b * b.transpose();
  stiffness += scale * b * b.transpose();
  const auto solved = core::symmetric_eigenpairs(mass, stiffness);
  if (!solved)
    throw core::ComputationError(
        "modes of the structure that starts at node " +
        fem::place(model.nodes[static_cast<std::size_t>(structure.nodes.front())]) +
        ": the stiffness is singular to working precision; look for parts that are hardly held");
  const auto& [theta, vectors] = *solved;
  Eigen::Index count = 0;
  while (count < elastic && theta[theta.size() - 1 - count] > 0.0)
    ++count;
  Pairs pairs{theta.tail(count).reverse().cwiseInverse(), vectors.rightCols(count).rowwise().reverse()};
  for (Eigen::Index j = 0; j < count; ++j) // the solver's norm is x^T K x = 1
    pairs.vectors.col(j) *= std::sqrt(pairs.lambda[j]);
  return pairs;
}

} // namespace fretwork::modal
