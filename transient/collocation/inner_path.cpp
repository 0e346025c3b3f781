// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/inner_path.hpp"
#include "kernels/vector_lanes.hpp"
#include "transient/collocation/path_slider.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

using contact::Vec2;
using kernels::Half;
using kernels::Kernel;
using kernels::Pack;
using kernels::Pair;

namespace {

constexpr int parts = SpringTable::parts, all_parts = 2 * parts;
/// A slide is followed where e^-x of a half step is below `fast` and |T - F| above `far` |F|.
constexpr double fast = 0.5, far = 0.1;

/// At the ends of the parts of a half step: the cubic by p and h p'/2 at its begin and its end, and the derivative of that times h/2.
struct Cubics {
  alignas(64) double p[4][parts];
  alignas(64) double rate[4][parts];
};
constexpr Cubics cubics = [] {
  Cubics out{};
  for (int i = 0; i < parts; ++i) {
    const double x = (i + 1.0) / parts, y = 1.0 - x;
    const double p[4] = {(1.0 + 2.0 * x) * y * y, x * y * y, x * x * (3.0 - 2.0 * x), -x * x * y};
    const double rate[4] = {-6.0 * x * y, y * (1.0 - 3.0 * x), 6.0 * x * y, x * (3.0 * x - 2.0)};
    for (int k = 0; k < 4; ++k) {
      out.p[k][i] = p[k];
      out.rate[k][i] = rate[k];
    }
  }
  return out;
}();

/// At the ends of the parts of the step: s, its weight in an integral over the step, and the quadratics that are 1 at one node each.
struct Quadratics {
  alignas(64) double s[all_parts];
  alignas(64) double weight[all_parts];
  alignas(64) double by[3][all_parts];
  double zeroth[3], first[3]; ///< their moments by these weights
};
constexpr Quadratics quadratics = [] {
  Quadratics out{};
  for (int i = 0; i < all_parts; ++i) {
    const double s = (i + 1.0) / all_parts, weight = (i + 1 < all_parts ? 1.0 : 0.5) / all_parts;
    const double by[3] = {(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)};
    out.s[i] = s;
    out.weight[i] = weight;
    for (int k = 0; k < 3; ++k) {
      out.by[k][i] = by[k];
      out.zeroth[k] += weight * by[k];
      out.first[k] += weight * s * by[k];
    }
  }
  return out;
}();

enum class Branch { open, sticks, slides };
Branch branch_of(const ContactNode& node) {
  return !(node.normal > 0.0) ? Branch::open : node.slides ? Branch::slides : Branch::sticks;
}

/// D_0 and D_1 of a force.
template <class Value> struct Moments {
  Value zeroth{}, first{};
  void add(double at, Value value) {
    zeroth = zeroth + value;
    first = first + at * value;
  }
  /// Takes away those of the quadratic through values at the nodes.
  void leave(const Value (&nodes)[3]) {
    const Quadratics& q = quadratics;
    for (int k = 0; k < 3; ++k) {
      zeroth = zeroth - q.zeroth[k] * nodes[k];
      first = first - q.first[k] * nodes[k];
    }
  }
  /// Forces at the nodes whose quadratic, 0 at the node 0, has these moments.
  [[nodiscard]] Value at_middle() const { return 3.0 * (zeroth - first); }
  [[nodiscard]] Value at_end() const { return 12.0 * first - 6.0 * zeroth; }
};

/// Along the motion, at the ends of the parts.
template <int D> struct Way {
  alignas(64) double depth[all_parts], rate[all_parts], force[all_parts]; ///< p, p', F_N
  alignas(64) double slip[D - 1][all_parts];                              ///< along t, x_loc
};
template <class V, int D>
FRETWORK_INLINE void go_along(const contact::NormalLaw& law, bool with_friction, const ContactNode* nodes,
                              double half, Way<D>& way) {
  using kernels::at;
  const double per_half = 1.0 / half;
  for (int j = 0; j < 2; ++j) {
    const ContactNode &from = nodes[j], &to = nodes[j + 1];
    const double p[4] = {from.penetration, half * from.rate, to.penetration, half * to.rate};
    const auto cubic = [&](const double(*by)[parts], int i) __attribute__((always_inline)) {
      return at<V>(by[0] + i) * p[0] + at<V>(by[1] + i) * p[1] + at<V>(by[2] + i) * p[2] +
             at<V>(by[3] + i) * p[3];
    };
    for (int i = 0; i < parts; i += kernels::size_of<V>) {
      const V depth = cubic(cubics.p, i), rate = per_half * cubic(cubics.rate, i);
      const V force = law.spring_and_damper(depth, rate);
      at<V>(way.depth + j * parts + i) = depth;
      at<V>(way.rate + j * parts + i) = rate;
      at<V>(way.force + j * parts + i) = ((depth >= 0.0) & (force > 0.0)) ? force : V{};
    }
  }
  for (int a = 0; a < (with_friction ? D - 1 : 0); ++a) {
    const auto slip = [&](int j) { return a == 0 ? nodes[j].slip.t : nodes[j].slip.x; };
    const double v[3] = {slip(0), slip(1), slip(2)};
    for (int i = 0; i < all_parts; i += kernels::size_of<V>)
      at<V>(way.slip[a] + i) = v[0] * at<V>(quadratics.by[0] + i) + v[1] * at<V>(quadratics.by[1] + i) +
                               v[2] * at<V>(quadratics.by[2] + i);
  }
}

/// A state at the begin or the end of a part.
struct Pressed {
  double depth, rate, force;
};
bool closes(const Pressed& before, const Pressed& after) {
  return after.depth > 0.0 && !(before.depth > 0.0);
}

/// Where a contact closes or opens in a part, its force is there over the closed share of it.
struct Jump {
  double closed;     ///< share of the part
  double at_touch;   ///< N, where it closes
  double missing;    ///< N, what the mean of the forces at the ends of the part lacks of that over the part
  double before_end; ///< where that stands, parts before its end
  double share;      ///< `missing` of the force before it opens
  Jump(const contact::NormalLaw& law, const Pressed& before, const Pressed& after) {
    closed = std::max(before.depth, after.depth) / std::abs(after.depth - before.depth);
    const bool closing = closes(before, after);
    at_touch = closing ? contact::normal_force(law, 0.0, after.rate) : 0.0;
    const double mean = 0.5 * closed * (closing ? at_touch + after.force : before.force);
    missing = mean - 0.5 * (before.force + after.force);
    before_end = closing ? 0.5 * closed : 1.0 - 0.5 * closed;
    share = !closing && before.force > 0.0 ? missing / before.force : 0.0;
  }
};

/// The forces along the way.
template <class V, int D>
FRETWORK_INLINE InnerPath follow_on(const contact::Support& support, const SpringTable& table,
                                    const ContactNode* nodes, double h) {
  using Vector = Tangential<D>;
  const Quadratics& q = quadratics;
  const contact::NormalLaw& law = support.normal;
  const bool with_friction = support.friction.active();
  Way<D> way;
  go_along<V>(law, with_friction, nodes, 0.5 * h, way);
  PathSlider<D> slider(support.friction, table, nodes[0], h / all_parts);
  Pressed before{nodes[0].penetration, nodes[0].rate, nodes[0].normal};
  const double held = law.spring_energy(before.depth);
  double work = 0.0; // J, into the contact
  Moments<double> normal;
  Moments<Vector> friction;
  InnerPath out;
  for (int j = 0; j < 2; ++j) {
    if (nodes[j].face.opposite(nodes[j + 1].face))
      slider.forget();
    for (int i = j * parts; i < (j + 1) * parts; ++i) {
      const Pressed after{way.depth[i], way.rate[i], way.force[i]};
      const double deeper = after.depth - before.depth;
      normal.add(q.s[i], q.weight[i] * after.force);
      work += 0.5 * (before.force + after.force) * deeper;
      Vector slip{};
      if constexpr (D == 2)
        slip = way.slip[0][i];
      else
        slip = {way.slip[1][i], way.slip[0][i]};
      const auto add_friction = [&](const typename PathSlider<D>::Passed& passed) {
        friction.add(q.s[i], q.weight[i] * passed.force);
        friction.add(q.s[i] - passed.before_end / all_parts, (1.0 / all_parts) * passed.missing);
      };
      if ((before.depth > 0.0) == (after.depth > 0.0)) {
        if (with_friction)
          add_friction(slider.move(after.force, slip));
      } else {
        const Jump jump(law, before, after);
        const double at = q.s[i] - jump.before_end / all_parts;
        normal.add(at, jump.missing / all_parts);
        work += jump.missing * deeper;
        if (with_friction && closes(before, after)) {
          add_friction(slider.close(jump.closed, jump.at_touch, after.force, slip));
        } else if (with_friction) {
          add_friction(slider.move(after.force, slip));
          friction.add(at, (1.0 / all_parts) * slider.open(jump.share));
        }
      }
      before = after;
    }
    const PathLoss loss = slider.loss();
    out.end[j] = slider.end();
    out.loss[j] = {loss.slider, loss.damper + work + held - law.spring_energy(before.depth), loss.forgotten};
  }
  normal.leave({nodes[0].normal, nodes[1].normal, nodes[2].normal});
  friction.leave(
      {tangential<D>(nodes[0].friction), tangential<D>(nodes[1].friction), tangential<D>(nodes[2].friction)});
  out.force[0].normal = normal.at_middle();
  out.force[1].normal = normal.at_end();
  out.force[0].friction = in_plane(friction.at_middle());
  out.force[1].friction = in_plane(friction.at_end());
  return out;
}
template <class V>
FRETWORK_INLINE InnerPath follow_line_on(const contact::Support& support, const SpringTable& table,
                                         const ContactNode* nodes, double h) {
  return follow_on<V, 2>(support, table, nodes, h);
}
template <class V>
FRETWORK_INLINE InnerPath follow_plane_on(const contact::Support& support, const SpringTable& table,
                                          const ContactNode* nodes, double h) {
  return follow_on<V, 3>(support, table, nodes, h);
}
FRETWORK_KERNEL(InnerPath, follow_line,
                (const contact::Support& support, const SpringTable& table, const ContactNode* nodes,
                 double h),
                (support, table, nodes, h))
FRETWORK_KERNEL(InnerPath, follow_plane,
                (const contact::Support& support, const SpringTable& table, const ContactNode* nodes,
                 double h),
                (support, table, nodes, h))

} // namespace

bool changes_inside(const contact::Support& support, const SpringTable& table, const ContactNode* nodes) {
  const bool with_friction = support.friction.active();
  if (with_friction && support.friction.kind != contact::FrictionMemoryKind::return_map)
    return false;
  for (int j = 1; j <= 2; ++j) {
    const Branch branch = branch_of(nodes[j]);
    if (branch != branch_of(nodes[j - 1]) ||
        (branch == Branch::slides && dot(nodes[j].friction, nodes[j - 1].friction) < 0.0))
      return true;
  }
  const ContactNode& start = nodes[0];
  return branch_of(start) == Branch::slides && table.keep < fast &&
         norm(start.spring - start.friction) > far * norm(start.friction);
}

template <>
InnerPath inner_path<2>(const contact::Support& support, const SpringTable& table, const ContactNode* nodes,
                        double h) {
  return follow_line(support, table, nodes, h);
}
template <>
InnerPath inner_path<3>(const contact::Support& support, const SpringTable& table, const ContactNode* nodes,
                        double h) {
  return follow_plane(support, table, nodes, h);
}

} // namespace fretwork::transient
