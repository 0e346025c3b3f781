// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/nodal_contact.hpp"
#include "transient/force_polynomial.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

using contact::Vec2;

namespace {

constexpr double slip_weights[2][3] = {{5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0},
                                       {-1.0 / 24.0, 1.0 / 3.0, 5.0 / 24.0}};
/// The quadratics that are 1 at one node and 0 at the others, in powers of the share of the half step.
constexpr double basis[2][3][3] = {{{1.0, -1.5, 0.5}, {0.0, 2.0, -1.0}, {0.0, -0.5, 0.5}},
                                   {{0.0, -0.5, 0.5}, {1.0, 0.0, -1.0}, {0.0, 0.5, 0.5}}};

template <std::size_t n> using Row = std::array<double, n>;
template <std::size_t n> Row<n> operator*(double s, Row<n> a) {
  for (double& x : a)
    x *= s;
  return a;
}
template <std::size_t n> Row<n>& operator+=(Row<n>& a, const Row<n>& b) {
  for (std::size_t i = 0; i < n; ++i)
    a[i] += b[i];
  return a;
}
template <std::size_t n> Row<n> operator+(Row<n> a, const Row<n>& b) { return a += b; }
template <std::size_t n> Row<n> unit(int i) {
  Row<n> row{};
  row[static_cast<std::size_t>(i)] = 1.0;
  return row;
}

} // namespace

SpringTable spring_table(const contact::FrictionLaw& law, double h) {
  SpringTable table{};
  const bool set = law.kind == contact::FrictionMemoryKind::reference || !(law.damping > 0.0);
  const double x = set ? 0.0 : 0.5 * law.stiffness * h / law.damping;
  const auto phi = decay_functions(x);
  const double moments[3] = {x * phi[0], x * phi[1],
                             x * 2.0 * phi[2]}; // int x e^-x(1 - s) s^i ds over the half step
  table.keep = set ? 0.0 : std::exp(-x);
  const double part = x / SpringTable::parts;
  const auto phi_part = decay_functions(part);
  table.keep_part = set ? 0.0 : std::exp(-part);
  table.part_by_force = set ? 1.0 : part * phi_part[1];
  table.part_by_last = set ? 0.0 : part * (phi_part[0] - phi_part[1]);
  for (int j = 0; j < 2; ++j)
    for (int l = 0; l < 3; ++l) {
      table.by_slip[j][l] = -law.stiffness * h * slip_weights[j][l];
      table.by_force[j][l] = set ? (l == j + 1 ? 1.0 : 0.0) : 0.0;
      for (int i = 0; i < 3; ++i)
        table.by_force[j][l] += basis[j][l][i] * moments[i];
    }
  return table;
}

template <int D>
NodalContact<D>::NodalContact(const contact::Support& support, const SpringTable& table, ContactNode* nodes,
                              const Row& forces, const std::array<double, 2>& rho, double rho_slip)
    : support_(support), table_(table), node_(nodes), force_(forces), rho_(rho), rho_slip_(rho_slip) {
  for (int j = 0; j < 2; ++j) {
    press(j);
    const ContactNode& node = node_[j + 1];
    if (support_.friction.active())
      rub(j);
    const auto at = static_cast<std::size_t>(j * D);
    residual_[at] = force_[at] - node.normal;
    residual_[at + 1] = force_[at + 1] - node.friction.t;
    if constexpr (D == 3)
      residual_[at + 2] = force_[at + 2] - node.friction.x;
  }
}

template <int D> Vec2 NodalContact<D>::tried(int j) const {
  return {D == 3 ? force_[j * D + 2] : 0.0, force_[j * D + 1]};
}

template <int D> void NodalContact<D>::press(int j) {
  const contact::NormalLaw& law = support_.normal;
  ContactNode& node = node_[j + 1];
  const double p = node.penetration;
  if (!(law.damping > 0.0)) {
    const auto slopes = contact::normal_slopes(law, p, node.rate);
    node.normal = slopes.force;
    law_[j].normal = slopes.force > 0.0 ? Normal::closed : Normal::open;
    law_[j].by_penetration = slopes.by_penetration;
    law_[j].by_rate = slopes.by_rate;
  } else {
    const double c = law.damping_at(p), by_law = law.stiffness * p + c * node.rate,
                 limit = rho_[j] > 0.0 ? force_[j * D] + rho_[j] * p
                         : p > 0.0     ? by_law
                                       : 0.0;
    node.normal = std::max(0.0, std::min(by_law, limit));
    law_[j].normal = !(node.normal > 0.0) ? Normal::open : by_law <= limit ? Normal::closed : Normal::limited;
    law_[j].by_penetration = law.stiffness * (1.0 + law.dissipation * node.rate);
    law_[j].by_rate = c;
  }
  const ContactNode& before = node_[j];
  node.face_y = node.normal > 0.0 ? node.ny : before.face_y;
  node.face_z = node.normal > 0.0 ? node.nz : before.face_z;
}

template <int D> void NodalContact<D>::rub(int j) {
  const contact::FrictionLaw& law = support_.friction;
  const ContactNode& before = node_[j];
  ContactNode& node = node_[j + 1];
  law_[j].carries = !(before.face_y * node.face_y + before.face_z * node.face_z < 0.0);
  const Vec2 carried = law_[j].carries ? before.spring : Vec2{};
  const double *s = table_.by_slip[j], *f = table_.by_force[j];
  const Vec2 stuck =
      carried + s[0] * node_[0].slip + s[1] * node_[1].slip + s[2] * node_[2].slip + node.inner.spring;
  const Vec2 relaxed = table_.keep * carried + f[0] * node_[0].friction + f[1] * tried(0) + f[2] * tried(1) +
                       node.inner.spring;
  node.friction = {};
  node.slides = false;
  node.spring = relaxed;
  law_[j].tangent = Tangent::none;
  if (!(node.normal > 0.0))
    return;
  const Vec2 trial = stuck - law.damping * node.slip;
  const double bound = (node_[0].slides ? law.mu_dynamic : law.mu_static) * node.normal;
  if (length(trial) <= bound) {
    law_[j].tangent = Tangent::stick;
    node.friction = trial;
    node.spring = stuck;
    return;
  }
  node.slides = true;
  slide(j, relaxed, stuck, law.mu_dynamic * node.normal);
}

template <int D> void NodalContact<D>::slide(int j, Vec2 relaxed, Vec2 stuck, double bound) {
  const contact::FrictionLaw& law = support_.friction;
  ContactNode& node = node_[j + 1];
  Law& out = law_[j];
  Vec2 along = stuck - law.damping * node.slip;
  if (law.kind == contact::FrictionMemoryKind::reference) {
    along = tried(j) - rho_slip_ * node.slip;
    out.tangent = length(along) <= bound ? Tangent::rest : Tangent::opposed;
    if (out.tangent == Tangent::rest) {
      node.friction = along;
      return;
    }
  } else if constexpr (D == 2) {
    out.tangent = Tangent::line;
    out.e = {0.0, along.t < 0.0 ? -1.0 : 1.0};
    node.friction = bound * out.e;
    return; // the law does not feel how long the trial is
  } else {
    out.tangent = Tangent::trial;
    const Vec2 candidate = relaxed - law.damping * node.slip;
    if (table_.keep > 0.0 && contact::norm(candidate) > bound && contact::dot(candidate, along) > 0.0) {
      along = candidate;
      out.tangent = Tangent::relaxed;
    }
  }
  const double trial = length(along);
  out.e = (1.0 / trial) * along;
  out.share = bound / trial;
  node.friction = bound * out.e;
}

template <int D> int NodalContact<D>::branches() const {
  int code = 0;
  for (const Law& law : law_)
    code = (code * 3 + static_cast<int>(law.normal)) * 7 + static_cast<int>(law.tangent);
  return code;
}

template <int D>
std::array<typename NodalContact<D>::Row, NodalContact<D>::size>
NodalContact<D>::jacobian(const Answer<D>& answer) const {
  const contact::FrictionLaw& law = support_.friction;
  std::array<Row, size> out;
  const double mask[2] = {law.along.t, law.along.x};
  Row slip[2][D - 1]; // d slip at the nodes: along t, x_loc
  for (int j = 0; j < 2; ++j) {
    const ContactNode& node = node_[j + 1];
    slip[j][0] = mask[0] * (answer.v[j][1] + node.curvature * node.rate * answer.u[j][1]);
    if constexpr (D == 3)
      slip[j][1] = mask[1] * answer.v[j][2];
  }
  Row carried[D - 1]{}; // d T of the node before
  for (int j = 0; j < 2; ++j) {
    const ContactNode& node = node_[j + 1];
    const Law& at = law_[j];
    const Row &un = answer.u[j][0], &ut = answer.u[j][1], &vn = answer.v[j][0];
    const double kappa = node.curvature;
    Row normal{};
    if (at.normal == Normal::closed)
      normal = -at.by_penetration * un + -at.by_rate * (vn + kappa * node.across * ut);
    else if (at.normal == Normal::limited)
      normal = unit<size>(j * D) + -rho_[j] * un;
    Row tangent[D - 1]{}, stuck[D - 1], relaxed[D - 1];
    for (int a = 0; a < D - 1; ++a) {
      const double carries = at.carries ? 1.0 : 0.0;
      stuck[a] = carries * carried[a] + table_.by_slip[j][1] * slip[0][a] + table_.by_slip[j][2] * slip[1][a];
      relaxed[a] = carries * table_.keep * carried[a] + table_.by_force[j][1] * unit<size>(1 + a) +
                   table_.by_force[j][2] * unit<size>(D + 1 + a);
    }
    const double e[2] = {at.e.t, at.e.x};
    Row base[D - 1]; // d of the vector that slip goes along, or of the force itself
    for (int a = 0; a < D - 1; ++a)
      switch (at.tangent) {
      case Tangent::none:
      case Tangent::line:
        base[a] = {};
        break;
      case Tangent::stick:
      case Tangent::trial:
        base[a] = stuck[a] + -law.damping * slip[j][a];
        break;
      case Tangent::relaxed:
        base[a] = relaxed[a] + -law.damping * slip[j][a];
        break;
      case Tangent::opposed:
      case Tangent::rest:
        base[a] = unit<size>(j * D + 1 + a) + -rho_slip_ * slip[j][a];
        break;
      }
    if (at.tangent == Tangent::stick || at.tangent == Tangent::rest) {
      for (int a = 0; a < D - 1; ++a)
        tangent[a] = base[a];
    } else if (at.tangent != Tangent::none) {
      Row along{};
      for (int a = 0; a < D - 1; ++a)
        along += e[a] * base[a];
      for (int a = 0; a < D - 1; ++a)
        tangent[a] = law.mu_dynamic * e[a] * normal + at.share * (base[a] + -e[a] * along);
    }
    for (int a = 0; a < D - 1; ++a)
      carried[a] = at.tangent == Tangent::stick ? stuck[a] : relaxed[a];
    const auto row = static_cast<std::size_t>(j * D);
    out[row] = unit<size>(j * D) + -1.0 * normal + kappa * node.friction.t * ut;
    out[row + 1] = unit<size>(j * D + 1) + -1.0 * tangent[0] + -kappa * node.normal * ut;
    if constexpr (D == 3)
      out[row + 2] = unit<size>(j * D + 2) + -1.0 * tangent[1];
  }
  return out;
}

template class NodalContact<2>;
template class NodalContact<3>;

} // namespace fretwork::transient
