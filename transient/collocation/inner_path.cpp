// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/inner_path.hpp"
#include "kernels/vector_lanes.hpp"
#include "transient/collocation/tangential.hpp"
#include "vibration/polynomial_flow.hpp"
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
/// What a half step leaves at most of a spring's distance from its force, and that distance over the force, for a path to be followed.
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

/// Of a friction spring over a share of a part.
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

/// The tangential spring and the slider from part to part.
template <int D> class Slider {
public:
  using Vector = Tangential<D>;
  Slider(const contact::FrictionLaw& law, const SpringTable& table, const ContactNode& start, double part)
      : law_(law), table_(table), compliance_(law.stiffness > 0.0 ? 1.0 / law.stiffness : 0.0),
        half_part_(0.5 * part), normal_(start.normal), spring_(tangential<D>(start.spring)),
        slip_(tangential<D>(start.slip)), force_(tangential<D>(start.friction)), held_(energy()),
        slides_(start.slides) {}
  void forget() {
    forgotten_ += energy();
    spring_ = {};
  }
  /// The force over a part.
  struct Passed {
    Vector force, missing; ///< N, at the end; what the mean over the part has beyond that of begin and end
    double before_end;     ///< where that stands, parts before the end
  };
  /// A part, under the normal force and with the tangential velocity at its end.
  Passed move(double normal, Vector slip) { return move(1.0, table_, normal, slip); }
  /// A part in which the contact closes, after which the spring follows the node.
  /// @param closed  share of the part   @param at_touch  N, the normal force that it begins with
  Passed close(double closed, double at_touch, double normal, Vector slip) {
    spring_ = std::pow(table_.keep_part, 1.0 - closed) * spring_;
    slip_ = slip_ + (1.0 - closed) * (slip - slip_);
    normal_ = at_touch;
    const auto touched = law_.bounded(law_.trial(spring_, slip_), law_.mu_static, at_touch);
    slides_ = touched.slides;
    force_ = touched.force;
    const Passed passed = move(closed, part_of(table_, closed), normal, slip);
    return {passed.force,
            (0.5 * closed) * (touched.force + passed.force) - 0.5 * passed.force + passed.missing,
            0.5 * closed};
  }
  /// More of the force in the mean over the last part, in which the contact opens, as a share of that at its begin. Returns it. What sticks
  /// goes without a jump.
  Vector open(double share) {
    if (!slid_)
      return {};
    const Vector more = share * last_;
    jump_loss_ += std::max(-slider_, -dot(more, moved_));
    return more;
  }
  [[nodiscard]] PathEnd end() const { return {in_plane(spring_), in_plane(stuck_), slides_}; }
  /// Up to now.
  [[nodiscard]] PathLoss loss() const {
    return {friction_loss_ + jump_loss_, held_ - energy() - work_ - friction_loss_, forgotten_};
  }

private:
  /// Over a share of a part that the table is for.
  Passed move(double share, const SpringTable& table, double normal, Vector slip) {
    last_ = force_;
    slid_ = slides_;
    moved_ = way(share, slip);
    stuck_ = spring_ - law_.stiffness * moved_;
    const Vector trial = law_.trial(stuck_, slip);
    const auto bounded = law_.bounded(trial, law_.coefficient(slides_), normal);
    const bool closed = normal > 0.0;
    Passed passed{};
    slider_ = 0.0;
    if (closed && !bounded.slides)
      stick(share, slip);
    else if (closed && !slides_ && law_.mu_static > law_.mu_dynamic)
      passed = begin_to_slide(share, table, norm(trial), normal, slip, bounded.force);
    else
      slide(share, table, slip, closed ? bounded.force : Vector{});
    slides_ = closed && bounded.slides;
    normal_ = normal;
    passed.force = force_;
    return passed;
  }
  /// The spring reaches the static bound inside the share, where the force falls to the dynamic one.
  Passed begin_to_slide(double share, const SpringTable& table, double trial, double normal, Vector slip,
                        Vector force) {
    const double before = norm(law_.trial(spring_, slip_)) - law_.mu_static * normal_,
                 after = trial - law_.mu_static * normal,
                 stuck = before < 0.0 ? before / (before - after) : 0.0;
    const Vector first = force_;
    stick(stuck * share, slip_ + stuck * (slip - slip_));
    const Vector borne = force_;
    force_ = law_.bounded(borne, 0.0, normal_ + stuck * (normal - normal_)).force;
    if (!(law_.damping >
          0.0)) { // the spring at once too; what the slider does not lose meanwhile the damper takes
      slider_ += dot(force_, compliance_ * (spring_ - force_));
      friction_loss_ += slider_;
      spring_ = force_;
    }
    const Vector fallen = force_;
    slide((1.0 - stuck) * share, part_of(table, 1.0 - stuck), slip, force);
    const Vector mean = (0.5 * stuck) * (first + borne) + (0.5 * (1.0 - stuck)) * (fallen + force);
    return {force, share * (mean - 0.5 * (first + force)), (1.0 - stuck) * share};
  }
  void stick(double share, Vector slip) {
    const Vector moved = way(share, slip), before = force_;
    spring_ = spring_ - law_.stiffness * moved;
    force_ = law_.trial(spring_, slip);
    slip_ = slip;
    work_ += 0.5 * dot(force_ + before, moved);
  }
  /// Or open.
  void slide(double share, const SpringTable& table, Vector slip, Vector force) {
    const Vector moved = way(share, slip), stretched = spring_;
    const Vector mean = 0.5 * (force_ + force);
    spring_ = table.keep_part * spring_ + table.part_by_last * force_ + table.part_by_force * force;
    force_ = force;
    slip_ = slip;
    work_ += dot(mean, moved);
    const double lost = std::max(0.0, dot(mean, compliance_ * (stretched - spring_) - moved));
    slider_ += lost;
    friction_loss_ += lost;
  }
  /// m
  [[nodiscard]] Vector way(double share, Vector slip) const { return (share * half_part_) * (slip + slip_); }
  [[nodiscard]] double energy() const { return law_.spring_energy(spring_); }
  const contact::FrictionLaw& law_;
  const SpringTable& table_;
  double compliance_, half_part_;
  double normal_; ///< N
  Vector spring_, slip_, force_, stuck_{}, last_{}, moved_{};
  double held_;                                  ///< J, by the spring at the begin
  double slider_ = 0.0;                          ///< J, lost in the last part
  double forgotten_ = 0.0;                       ///< J, of springs of the opposite face
  double work_ = 0.0;                            ///< J, of the force
  double friction_loss_ = 0.0, jump_loss_ = 0.0; ///< J, lost by the slider
  bool slides_, slid_ = false;
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
  Slider<D> slider(support.friction, table, nodes[0], h / all_parts);
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
      const auto rub = [&](const typename Slider<D>::Passed& passed) {
        friction.add(q.s[i], q.weight[i] * passed.force);
        friction.add(q.s[i] - passed.before_end / all_parts, (1.0 / all_parts) * passed.missing);
      };
      if ((before.depth > 0.0) == (after.depth > 0.0)) {
        if (with_friction)
          rub(slider.move(after.force, slip));
      } else {
        const Jump jump(law, before, after);
        const double at = q.s[i] - jump.before_end / all_parts;
        normal.add(at, jump.missing / all_parts);
        work += jump.missing * deeper;
        if (with_friction && closes(before, after)) {
          rub(slider.close(jump.closed, jump.at_touch, after.force, slip));
        } else if (with_friction) {
          rub(slider.move(after.force, slip));
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
