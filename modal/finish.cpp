// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/finish.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "fem/fields.hpp"
#include "fem/inner_motion.hpp"
#include "fem/mesh_error.hpp"
#include "modal/canonical.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <span>

namespace fretwork::modal {
namespace {

/// Relative difference of the solver's lambda and the Rayleigh quotient beyond which the shape too is made of
/// round-off. (At 5000 elements a span, where the difference is 3e-3, shapes still give lambda to 3e-7.)
constexpr double round_off_limit = 0.05;
/// The range in which an eigensolver in double precision resolves anything: higher modes of a dense solve are
/// not looked at.
constexpr double resolved_range = 1e12;

/// The lower half of A^T B, a symmetric matrix, and zeros above it.
Eigen::MatrixXd lower_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  product.triangularView<Eigen::Lower>() = a.transpose() * b;
  return product;
}

/// Makes the columns M-orthonormal, in order: G = L L^T, Phi <- Phi L^-T.
/// @param moved  M Phi
void orthonormalise(Eigen::MatrixXd& shapes, const Eigen::MatrixXd& moved) {
  const core::Cholesky factor(lower_product(shapes, moved));
  if (!factor.is_positive_definite())
    throw core::ComputationError(
        "modes: the shapes found are not independent; ask for fewer ([modes] count)");
  factor.orthonormalise(shapes);
}

void check_round_off(const Eigen::VectorXd& solver, const Eigen::VectorXd& strain) {
  for (Eigen::Index i = 0; i < solver.size() && solver[i] < resolved_range * solver[0]; ++i)
    if (!(std::abs(strain[i] - solver[i]) <= round_off_limit * strain[i]))
      throw core::ComputationError(
          fmt::format("modes: round-off spoils elastic mode {} (omega^2 = {:.6g} by the solver, {:.6g} by "
                      "its strain energy): too many "
                      "elements between supports, or parts hardly held; mesh more coarsely or restrain them",
                      i + 1, solver[i], strain[i]));
}

std::vector<Eigen::Index> ascending(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return values[i] < values[j]; });
  return order;
}

/// Puts values in ascending order; those of one cluster take their mean and stay as they were among each other (their
/// differences are round-off). @return where they were
std::vector<Eigen::Index> grouped(Eigen::VectorXd& values, Eigen::Index rigid) {
  std::vector<Eigen::Index> order = ascending(values);
  values = values(order).eval();
  Eigen::Index begin = 0;
  for (const Eigen::Index end : cluster_ends(values, rigid)) {
    auto group = values.segment(begin, end - begin);
    group.setConstant(group.mean());
    std::sort(order.begin() + begin, order.begin() + end);
    begin = end;
  }
  return order;
}

/// Whether a cut before this mode parts it from another of its frequency.
bool cuts_group(const Eigen::VectorXd& squares, Eigen::Index mode) {
  return mode > 0 && mode < squares.size() &&
         squares[mode] - squares[mode - 1] <= cluster_gap * squares[mode];
}

Eigen::Index count_kept(const Eigen::VectorXd& squares, const Cut& cut) {
  Eigen::Index kept = 0;
  while (kept < std::min(squares.size(), cut.count) && std::sqrt(squares[kept]) <= cut.omega)
    ++kept;
  while (cut.whole_groups && cuts_group(squares, kept))
    ++kept;
  return kept;
}

/// On the equations: reactions of restraints and forces between tied dofs are no residual.
Eigen::VectorXd residuals(const fem::Model& model, const fem::Structure& structure, const Basis& basis,
                          const Eigen::VectorXd& lambda, const Eigen::MatrixXd& inertia) {
  const Eigen::MatrixXd elastic =
      fem::forces_on_equations(structure, fem::stiffness_times(model, structure, basis.shapes));
  const Eigen::MatrixXd moved = fem::forces_on_equations(structure, inertia);
  const bool moves_rigidly = basis.size() > 0 && basis.omega[0] == 0.0;
  const Eigen::VectorXd diagonal =
      moves_rigidly ? fem::stiffness_diagonal(model, structure) : Eigen::VectorXd();
  Eigen::VectorXd result(basis.size());
  for (Eigen::Index j = 0; j < basis.size(); ++j) {
    const Eigen::VectorXd difference = elastic.col(j) - lambda[j] * moved.col(j);
    // a rigid mode has K x = 0: what it is compared with is the largest term of that product
    const double size = lambda[j] > 0.0 ? elastic.col(j).norm()
                                        : diagonal.cwiseProduct(basis.shapes.col(j)).cwiseAbs().maxCoeff();
    result[j] = size > 0.0 ? difference.norm() / size : 0.0;
  }
  return result;
}

/// A unit translation along x, y and z of all nodes, restrained ones included: one column each.
Eigen::MatrixXd translations(const fem::Structure& structure) {
  const auto nodes = static_cast<Eigen::Index>(structure.nodes.size());
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(nodes * core::dofs_per_node, 3);
  for (Eigen::Index i = 0; i < nodes; ++i)
    fields.middleRows<3>(i * core::dofs_per_node).setIdentity();
  return fields;
}

} // namespace

Eigen::MatrixXd projected_dampers(const fem::Model& model, const fem::Structure& structure,
                                  const Basis& basis) {
  Eigen::MatrixXd matrix;
  for (const core::Index number : structure.springs) {
    const fem::Spring& spring = model.springs[static_cast<std::size_t>(number)];
    for (int d = 0; d < core::dofs_per_node; ++d) {
      const double c = spring.damping[static_cast<std::size_t>(d)];
      if (c == 0.0)
        continue;
      Eigen::VectorXd stretch = basis.shapes.row(basis.row_of(spring.node) + d).transpose();
      if (spring.other >= 0)
        stretch -= basis.shapes.row(basis.row_of(spring.other) + d).transpose();
      if (matrix.size() == 0)
        matrix = Eigen::MatrixXd::Zero(basis.size(), basis.size());
      matrix += c * stretch * stretch.transpose();
    }
  }
  return matrix;
}

void describe(const fem::Model& model, const fem::Structure& structure, const Eigen::VectorXd& lambda,
              Basis& basis) {
  const Eigen::Index n = basis.size();
  basis.damping = Eigen::VectorXd::Zero(n);
  basis.damping_matrix = projected_dampers(model, structure, basis);
  const Eigen::MatrixXd translated = translations(structure);
  Eigen::MatrixXd fields(translated.rows(), n + 3);
  fields << basis.shapes, translated;
  const Eigen::MatrixXd moved = fem::mass_times(model, structure, fields); // at once: beams are made once
  const auto inertia = moved.leftCols(n);
  basis.orthogonality =
      n > 0 ? (lower_product(basis.shapes, inertia) - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff()
            : 0.0;
  basis.residuals = residuals(model, structure, basis, lambda, inertia);
  basis.error = fem::mesh_error(model, structure, basis.shapes, basis.omega.cwiseAbs2());
  basis.participation = inertia.transpose() * translated;
  basis.moving_mass = translated.cwiseProduct(moved.rightCols<3>()).colwise().sum().transpose();
}

Basis finish(const fem::Model& model, const fem::Structure& structure, const Eigen::MatrixXd& rigid,
             const Pairs& pairs, const Cut& cut) {
  const Eigen::MatrixXd elastic = all_rows(structure, pairs.vectors);
  Eigen::MatrixXd fields(elastic.rows(), rigid.cols() + elastic.cols());
  fields << rigid, elastic;
  const Eigen::MatrixXd moved = fem::mass_times(model, structure, fields);
  const Eigen::VectorXd quotients =
      fem::twice_strain_energy(model, structure, elastic).array() /
      elastic.cwiseProduct(moved.rightCols(elastic.cols())).colwise().sum().transpose().array();
  check_round_off(pairs.lambda, quotients);
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(fields.cols());
  lambda.tail(quotients.size()) = quotients;
  const std::vector<Eigen::Index> order = ascending(lambda); // rigid motions stay first

  Basis basis;
  basis.nodes = structure.nodes;
  basis.shapes = fields(Eigen::all, order);
  lambda = lambda(order).eval();
  orthonormalise(basis.shapes, moved(Eigen::all, order));
  canonicalise_clusters(basis.shapes, lambda, rigid.cols(), fem::positions(model, structure));

  auto [squares, refused] = fem::with_inner_motion(model, structure, basis.shapes, lambda);
  const std::vector<Eigen::Index> places = grouped(squares, rigid.cols());
  const Eigen::Index kept = count_kept(squares, cut);
  const auto kept_places = std::span(places).first(static_cast<std::size_t>(kept));
  basis.shapes = basis.shapes(Eigen::all, kept_places).eval();
  basis.splits_group = cuts_group(squares, kept);
  basis.complete = kept == squares.size();
  basis.omega = squares.head(kept).cwiseSqrt();
  describe(model, structure, lambda(kept_places), basis);
  basis.error += 0.5 * refused(kept_places);
  return basis;
}

} // namespace fretwork::modal
