// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/contact_node.hpp"
#include "vibration/polynomial_flow.hpp"
#include <cmath>

namespace fretwork::transient {
namespace {

constexpr double slip_weights[2][3] = {{5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0},
                                       {-1.0 / 24.0, 1.0 / 3.0, 5.0 / 24.0}};
/// The quadratics that are 1 at one node and 0 at the others, in powers of the share of the half step.
constexpr double basis[2][3][3] = {{{1.0, -1.5, 0.5}, {0.0, 2.0, -1.0}, {0.0, -0.5, 0.5}},
                                   {{0.0, -0.5, 0.5}, {1.0, 0.0, -1.0}, {0.0, 0.5, 0.5}}};

} // namespace

SpringTable spring_table(const contact::FrictionLaw& law, double h) {
  SpringTable table{};
  const bool set = law.kind == contact::FrictionMemoryKind::reference || !(law.damping > 0.0);
  const double x = set ? 0.0 : 0.5 * law.stiffness * h / law.damping;
  const auto phi = vibration::decay_functions(x);
  const double moments[3] = {x * phi[0], x * phi[1],
                             x * 2.0 * phi[2]}; // int x e^-x(1 - s) s^i ds over the half step
  table.keep = set ? 0.0 : std::exp(-x);
  const double part = x / SpringTable::parts;
  const auto phi_part = vibration::decay_functions(part);
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

SpringTable part_of(const SpringTable& table, double share) {
  SpringTable out = table;
  if (!(table.keep_part > 0.0)) // the spring is set
    return out;
  const double x = -share * std::log(table.keep_part);
  const auto phi = vibration::decay_functions(x);
  out.keep_part = std::exp(-x);
  out.part_by_force = x * phi[1];
  out.part_by_last = x * (phi[0] - phi[1]);
  return out;
}

} // namespace fretwork::transient
