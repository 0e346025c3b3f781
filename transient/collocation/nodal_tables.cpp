// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/nodal_tables.hpp"

namespace fretwork::transient {

/// A node at the end of a step that answers its force by less than this share of the node 1/2 does not.
constexpr double no_answer = 1e-9;

NodalMotion::NodalMotion(const PackedContacts& contacts)
    : stride(static_cast<std::size_t>(contacts.stride())), start(2 * stride), ends(4 * stride) {}

NodalTables::NodalTables(const PackedContacts& contacts, const vibration::PolynomialFlow& flow, double h)
    : step(h), length(4 * static_cast<std::size_t>(contacts.stride())),
      width_(static_cast<std::size_t>(contacts.width)), stride_(static_cast<std::size_t>(contacts.stride())) {
  const auto modes = static_cast<std::size_t>(contacts.padded_modes);
  columns_.assign(static_cast<std::size_t>(contacts.count) * 6 * length, 0.0);
  kernels::Array q(modes), v(modes);
  for (int c = 0; c < contacts.count; ++c) {
    springs.push_back(spring_table(contacts.supports[c].friction, h));
    for (int from = 1; from <= 2; ++from)
      for (int b = 0; b < contacts.components; ++b) {
        double* column = &columns_[(static_cast<std::size_t>(2 * c + from - 1) * 3 + b) * length];
        for (int to = 1; to <= 2; ++to) {
          flow.respond(contacts.row(c, b), to, from, q.data(), v.data());
          kernels::gather_two(contacts.gather, q.data(), v.data(), column + (to - 1) * stride_,
                              column + (to + 1) * stride_);
        }
      }
    // the answers of the nodes to their own forces set the scales of the jumps
    const double *first = columns(c, 1) + c, *last = columns(c, 2) + c;
    const auto along = [&](const double* column, std::size_t quantity) {
      return column[quantity * stride_] + column[length + quantity * stride_ + width_];
    };
    const double by_u = along(first, 0), by_v = along(first, 2),
                 rho = by_u > 0.0 ? 1.0 / by_u : contacts.supports[c].normal.stiffness;
    scales.push_back({{rho, along(last, 1) > no_answer * by_u ? rho : 0.0}, by_v > 0.0 ? 1.0 / by_v : 0.0});
  }
}

template <int D> Answer<D> NodalTables::answer(int contact, const ContactNode* node) const {
  Answer<D> out;
  for (int k = 0; k < 2; ++k) {
    const double* column = columns(contact, k + 1) + contact;
    const contact::ContactAxes& from = node[k + 1].axes;
    for (int quantity = 0; quantity < 4; ++quantity) { // u at 1/2, u at 1, v at 1/2, v at 1
      const int j = quantity % 2;
      const contact::ContactAxes& on = node[j + 1].axes;
      auto& to = quantity < 2 ? out.u[j] : out.v[j];
      const double* by_y = column + static_cast<std::size_t>(quantity) * stride_;
      const double* by_z = by_y + length;
      const double n_y = from.normal(by_y[0], by_z[0]), n_z = from.normal(by_y[width_], by_z[width_]);
      const double t_y = from.tangent(by_y[0], by_z[0]), t_z = from.tangent(by_y[width_], by_z[width_]);
      const auto at = static_cast<std::size_t>(k * D);
      to[0][at] = on.normal(n_y, n_z);
      to[0][at + 1] = on.normal(t_y, t_z);
      to[1][at] = on.tangent(n_y, n_z);
      to[1][at + 1] = on.tangent(t_y, t_z);
      if constexpr (D == 3) {
        const double* by_x = by_z + length;
        to[0][at + 2] = on.normal(by_x[0], by_x[width_]);
        to[1][at + 2] = on.tangent(by_x[0], by_x[width_]);
        to[2][at] = from.normal(by_y[2 * width_], by_z[2 * width_]);
        to[2][at + 1] = from.tangent(by_y[2 * width_], by_z[2 * width_]);
        to[2][at + 2] = by_x[2 * width_];
      }
    }
  }
  return out;
}

template Answer<2> NodalTables::answer<2>(int, const ContactNode*) const;
template Answer<3> NodalTables::answer<3>(int, const ContactNode*) const;

} // namespace fretwork::transient
