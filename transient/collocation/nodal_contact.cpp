// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/nodal_contact.hpp"

namespace fretwork::transient {
namespace {

template <class Row> Row unit(int i) {
  return Eigen::Vector<double, Row::SizeAtCompileTime>::Unit(i).array();
}

} // namespace

template <int D> typename NodalContact<D>::Jacobian NodalContact<D>::jacobian(const Answer<D>& answer) const {
  const contact::FrictionLaw& law = support_.friction;
  const double mask[2] = {law.along.t, law.along.x};
  Jacobian out;
  Row slip[2][D - 1]; // d slip at the nodes: along t, x_loc
  for (int j = 0; j < 2; ++j) {
    const ContactNode& node = node_[j + 1];
    slip[j][0] = mask[0] * (answer.v[j][1] + node.curvature * node.rate * answer.u[j][1]);
    if constexpr (D == 3)
      slip[j][1] = mask[1] * answer.v[j][2];
  }
  Row carried[D - 1]; // d T of the node before
  for (Row& row : carried)
    row.setZero();
  for (int j = 0; j < 2; ++j) {
    const ContactNode& node = node_[j + 1];
    const Law& at = law_[j];
    const Row &un = answer.u[j][0], &ut = answer.u[j][1], &vn = answer.v[j][0];
    const double kappa = node.curvature, carries = at.carries ? 1.0 : 0.0;
    Row normal = Row::Zero();
    if (at.normal == NormalBranch::closed)
      normal = -at.by_penetration * un - at.by_rate * (vn + kappa * node.across * ut);
    else if (at.normal == NormalBranch::limited)
      normal = unit<Row>(j * D) - scales_.rho[j] * un;
    const auto stuck = [&](int a) -> Row {
      return carries * carried[a] + table_.by_slip[j][1] * slip[0][a] + table_.by_slip[j][2] * slip[1][a];
    };
    const auto relaxed = [&](int a) -> Row {
      return carries * table_.keep * carried[a] + table_.by_force[j][1] * unit<Row>(1 + a) +
             table_.by_force[j][2] * unit<Row>(D + 1 + a);
    };
    Row base[D - 1]; // d of the vector that slip goes along, or of the force itself
    for (int a = 0; a < D - 1; ++a)
      switch (at.tangent) {
      case TangentBranch::none:
      case TangentBranch::line:
        base[a].setZero();
        break;
      case TangentBranch::stick:
      case TangentBranch::trial:
        base[a] = stuck(a) - law.damping * slip[j][a];
        break;
      case TangentBranch::relaxed:
        base[a] = relaxed(a) - law.damping * slip[j][a];
        break;
      case TangentBranch::opposed:
      case TangentBranch::rest:
        base[a] = mask[a] * unit<Row>(j * D + 1 + a) - scales_.rho_slip * slip[j][a];
        break;
      }
    Row tangent[D - 1];
    if (at.tangent == TangentBranch::none || at.tangent == TangentBranch::stick ||
        at.tangent == TangentBranch::rest) {
      for (int a = 0; a < D - 1; ++a)
        tangent[a] = base[a];
    } else {
      const contact::Vec2 direction = in_plane(at.e);
      const double e[2] = {direction.t, direction.x};
      Row along = e[0] * base[0];
      for (int a = 1; a < D - 1; ++a)
        along += e[a] * base[a];
      for (int a = 0; a < D - 1; ++a)
        tangent[a] = (law.mu_dynamic * e[a]) * normal + at.share * (base[a] - e[a] * along);
    }
    if (j == 0)
      for (int a = 0; a < D - 1; ++a)
        carried[a] = at.tangent == TangentBranch::stick ? stuck(a) : relaxed(a);
    const Row turned = kappa * ut;
    out.row(j * D) = unit<Row>(j * D) - normal + node.friction.t * turned;
    out.row(j * D + 1) = unit<Row>(j * D + 1) - tangent[0] - node.normal * turned;
    if constexpr (D == 3)
      out.row(j * D + 2) = unit<Row>(j * D + 2) - tangent[1];
  }
  return out;
}

template NodalContact<2>::Jacobian NodalContact<2>::jacobian(const Answer<2>&) const;
template NodalContact<3>::Jacobian NodalContact<3>::jacobian(const Answer<3>&) const;

} // namespace fretwork::transient
