// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/static_modes.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "fem/fields.hpp"
#include "modal/canonical.hpp"
#include "modal/finish.hpp"
#include "modal/static_flexibility.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace fretwork::modal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// lambda of static modes over that of the lowest elastic mode, or static one where there is none. What moves no mass but round-off is
/// above, at 1e22 and more; axial directions of long tubes are at 1e12.
constexpr double most_range = 1e16;

/// Makes columns M-orthogonal to the shapes; twice, for the first time leaves the round-off of what it takes.
void take_out(const fem::Model& model, const fem::Structure& structure, const MatrixXd& shapes,
              MatrixXd& columns) {
  for (int round = 0; round < 2; ++round)
    columns -= shapes * (shapes.transpose() * fem::mass_times(model, structure, columns));
}

/// X, K-orthonormal, as many columns as are left.
MatrixXd independent(const MatrixXd& v, const MatrixXd& loads, const MatrixXd& displacements) {
  const VectorXd missing = v.cwiseProduct(loads).colwise().sum().transpose();
  const VectorXd whole = displacements.cwiseProduct(loads).colwise().sum().transpose();
  std::vector<Eigen::Index> lacking;
  for (Eigen::Index j = 0; j < v.cols(); ++j)
    if (missing(j) > negligible_share * whole(j))
      lacking.push_back(j);
  if (lacking.empty())
    return MatrixXd(v.rows(), 0);
  const VectorXd scale = missing(lacking).cwiseSqrt().cwiseInverse();
  const MatrixXd columns = v(Eigen::all, lacking) * scale.asDiagonal();
  const MatrixXd r = columns.transpose() * loads(Eigen::all, lacking) * scale.asDiagonal();
  const auto [lambda, vectors] = core::symmetric_eigenpairs(0.5 * (r + r.transpose()));
  const Eigen::Index left_out = (lambda.array() <= dependent_share * lambda.maxCoeff()).count();
  const Eigen::Index kept = lambda.size() - left_out;
  return columns * vectors.rightCols(kept) * lambda.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Makes columns M-orthonormal, in order, to each other.
void orthonormalise(const fem::Model& model, const fem::Structure& structure, MatrixXd& columns) {
  const MatrixXd gram = columns.transpose() * fem::mass_times(model, structure, columns);
  core::Cholesky(gram).orthonormalise(columns); // positive definite: nearly the unit matrix
}

/// The stationary combinations of K-orthonormal columns, by ascending frequency, M-orthonormal.
/// @return omega^2
VectorXd take_stationary(const fem::Model& model, const fem::Structure& structure, const Basis& basis,
                         MatrixXd& columns) {
  const MatrixXd mass = columns.transpose() * fem::mass_times(model, structure, columns);
  const auto [values, vectors] = core::symmetric_eigenpairs(mass);
  const VectorXd mu = values.reverse();
  const Eigen::Index rigid = (basis.omega.array() == 0.0).count();
  const double slowest = rigid < basis.size() ? std::pow(basis.omega(rigid), -2) : mu.maxCoeff();
  if (!(mu.minCoeff() * most_range > slowest))
    throw core::Error("static modes: one of them moves no mass; give the beams at the contacts a density, or "
                      "leave modes.static_modes out");
  columns = columns * vectors.rowwise().reverse() * mu.cwiseSqrt().cwiseInverse().asDiagonal();
  take_out(model, structure, basis.shapes, columns);
  orthonormalise(model, structure, columns);
  return fem::twice_strain_energy(model, structure, columns);
}

void append(VectorXd& all, const VectorXd& more) {
  all.conservativeResize(all.size() + more.size());
  all.tail(more.size()) = more;
}

} // namespace

void add_static_modes(const fem::Model& model, const fem::Structure& structure, const MatrixXd& loads,
                      const MatrixXd& displacements, Basis& basis) {
  assert(basis.static_modes == 0);
  MatrixXd v = displacements - basis.shapes * static_gain(basis, loads).transpose();
  take_out(model, structure, basis.shapes, v);
  Basis added;
  added.nodes = basis.nodes;
  added.shapes = independent(v, loads, displacements);
  if (added.shapes.cols() == 0)
    return;
  VectorXd lambda = take_stationary(model, structure, basis, added.shapes);
  canonicalise_clusters(added.shapes, lambda, 0, fem::positions(model, structure));
  added.omega = lambda.cwiseSqrt();
  describe(model, structure, lambda, added);

  const MatrixXd mixed = basis.shapes.transpose() * fem::mass_times(model, structure, added.shapes);
  basis.orthogonality = std::max({basis.orthogonality, added.orthogonality, mixed.cwiseAbs().maxCoeff()});
  const Eigen::Index before = basis.size();
  basis.shapes.conservativeResize(Eigen::NoChange, before + added.size());
  basis.shapes.rightCols(added.size()) = added.shapes;
  basis.participation.conservativeResize(before + added.size(), Eigen::NoChange);
  basis.participation.bottomRows(added.size()) = added.participation;
  append(basis.omega, added.omega);
  append(basis.residuals, added.residuals);
  append(basis.error, VectorXd::Zero(added.size()));
  append(basis.damping, VectorXd::Zero(added.size()));
  basis.static_modes = added.size();
  basis.damping_matrix = projected_dampers(model, structure, basis);
}

} // namespace fretwork::modal
