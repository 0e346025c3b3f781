// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pivoted_columns.hpp"
#include <Eigen/QR>

namespace fretwork::core {

PivotedColumns pivoted_columns(const Eigen::MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  return {qr.householderQ(), qr.matrixR().diagonal(), qr.colsPermutation().indices()};
}

} // namespace fretwork::core
