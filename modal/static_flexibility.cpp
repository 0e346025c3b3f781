// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/static_flexibility.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include <fmt/format.h>

namespace fretwork::modal {
namespace {

/// Share of a direction's static flexibility that no round-off takes: shapes of modes on the finest meshes that are let through are good
/// to some 1e-6.
constexpr double spoilt_share = 1e-4;

} // namespace

Eigen::MatrixXd static_gain(const Basis& basis, const Eigen::MatrixXd& loads) {
  const Eigen::ArrayXd square = basis.omega.array().square();
  const Eigen::VectorXd flexibility = (square > 0.0).select(square.inverse(), 0.0);
  return loads.transpose() * basis.shapes * flexibility.asDiagonal();
}

Eigen::MatrixXd flexibility_of(const Basis& basis, const Eigen::MatrixXd& loads) {
  return static_gain(basis, loads) * (basis.shapes.transpose() * loads);
}

Eigen::MatrixXd inner_flexibility(const Basis& basis, const Eigen::MatrixXd& loads,
                                  const Eigen::VectorXd& change) {
  return static_gain(basis, loads) * change.asDiagonal() * (basis.shapes.transpose() * loads);
}

Eigen::MatrixXd missing_flexibility(const Eigen::MatrixXd& exact, const Eigen::MatrixXd& basis,
                                    const Eigen::MatrixXd& inner) {
  if (exact.size() == 0)
    return exact;
  const Eigen::VectorXd size = exact.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd scale = (size.array() > 0.0).select(size.cwiseInverse(), 0.0);
  const auto scaled = [&](const Eigen::MatrixXd& matrix) -> Eigen::MatrixXd {
    return scale.asDiagonal() * (0.5 * (matrix + matrix.transpose())) * scale.asDiagonal();
  };
  const auto [values, vectors] = core::symmetric_eigenpairs(scaled(exact - basis));
  const bool doubtful = !(values.minCoeff() > -spoilt_share);
  if (const double least =
          doubtful ? core::symmetric_eigenvalues(scaled(exact - basis + inner)).minCoeff() : 0.0;
      !(least > -spoilt_share))
    throw core::ComputationError(
        fmt::format("static flexibility at the contacts: the modes are softer than the structure by {:.2g} "
                    "of it; round-off "
                    "spoils one of them: mesh more coarsely, or take static_modes = \"none\"",
                    -least));
  const Eigen::VectorXd kept = (values.array() > negligible_share).select(values, 0.0);
  const Eigen::MatrixXd shapes = size.asDiagonal() * vectors * kept.cwiseSqrt().asDiagonal();
  return shapes * shapes.transpose();
}

} // namespace fretwork::modal
