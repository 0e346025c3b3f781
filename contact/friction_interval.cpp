// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_interval.hpp"
#include "contact/turning_slip.hpp"
#include <algorithm>
#include <type_traits>

namespace fretwork::contact {
namespace {

/// Changes between stick and slip that an interval is searched for: to slide, stick, slide and stick again.
constexpr int most_events = 4;
/// Where it begins or ends to slide: false position, and what may be left of the difference of both ends.
constexpr int most_iterations = 8;
constexpr double located = 1e-3;
/// Of an interval: what is shorter is none.
constexpr double shortest_piece = 1e-9;
/// Of the bound: what is above it by less is at it.
constexpr double round_off = 1e-9;
/// Share of a usual interval within which the spring is to be at its bound again for the contact to slide on. Larger: contacts that have stopped slide on
/// for an interval. 0: contacts that slide stick, up to mu_s N.
constexpr double soon = 0.5;
/// Cosine of the turn of a slip, and of its force from what drives it, from which it is a stop and a start the other way: the slider stands in between.
constexpr double turned_round = -0.9;

double unit(double a) { return std::copysign(1.0, a); }
Vec2 unit(Vec2 a) {
  const double length = norm(a);
  return length > 0.0 ? (1.0 / length) * a : Vec2{};
}

double solve(double m, double b) { return b / m; }
Vec2 solve(const Sym2& m, Vec2 b) {
  const double det = m.xx * m.tt - m.xt * m.xt;
  return {(m.tt * b.x - m.xt * b.t) / det, (m.xx * b.t - m.xt * b.x) / det};
}
/// Direction of the f of a length with (1 + s A + l) f = b, l >= 0.
Vec2 direction(double s, const Sym2& a, Vec2 b, double length) {
  if (!(length > 0.0) || (a.xt == 0.0 && a.xx == a.tt))
    return unit(b);
  return unit(force_of_length(length, plus(1.0, s * a), b));
}

template <class V, class M> class Pieces {
public:
  Pieces(const FrictionLaw& law, const PieceTables& usual, double mobility, V spring, bool sliding,
         double length, const ParabolicForce& normal, const TangentialPath<V, M>& path)
      : law_(law), usual_(usual), mobility_(mobility), path_(path), course_(normal),
        acceleration_(path.acceleration), length_(length), left_(length), normal_(normal.first),
        lag_(law.stiffness * length < no_damper * law.damping ? law.damping / law.stiffness : 0.0) {
    out_.spring = spring;
    out_.velocity = path.velocity;
    out_.sliding = sliding;
  }

  FrictionInterval<V> all() {
    // Below its bound, as the normal force is not what it was expected to be: it slides on where its spring is at the bound again soon.
    if (const V along = heading(); out_.sliding) {
      const double below = law_.mu_dynamic * normal_ - dot(trial(), along);
      if (below > -round_off * law_.mu_dynamic * normal_ &&
          law_.stiffness * soon * usual_.slip.length * settled_speed(along) < below)
        out_.sliding = false;
    }
    for (int events = 0; left_ > 0.0; ++events)
      out_.sliding ? slip(events >= most_events) : stick(events >= most_events);
    return out_;
  }

private:
  [[nodiscard]] StickTable stick_table(double time) const {
    return time == usual_.stick.length ? usual_.stick : contact::stick_table(law_, mobility_, time);
  }
  [[nodiscard]] SlipTable slip_table(double time) const {
    return time == usual_.slip.length ? usual_.slip : contact::slip_table(law_, time);
  }
  /// Of the force, and where there is none yet of what builds it up.
  [[nodiscard]] V heading() const {
    const V force = trial();
    return unit(norm(force) > 0.0 ? force : V(-1.0 * out_.velocity));
  }
  [[nodiscard]] V trial() const { return law_.trial(out_.spring, out_.velocity); }

  /// N, so many seconds after the piece begins.
  [[nodiscard]] double normal_after(double time) const {
    return course_.at((length_ - left_ + time) / length_);
  }
  /// N: mean over a piece.
  [[nodiscard]] double mean_normal(double time, double normal1) const {
    return (normal_ + 4.0 * normal_after(0.5 * time) + normal1) / 6.0;
  }
  /// s: until the normal force is lowest inside the interval; what is left of that where it is lowest at its ends.
  [[nodiscard]] double lowest_after() const {
    const double bow = course_.bow(), time = course_.slope() / (12.0 * bow) * length_ - (length_ - left_);
    return bow < 0.0 && time > shortest_piece * length_ && time < left_ ? time : left_;
  }
  /// N: that of the normal force in a piece.
  [[nodiscard]] double bow(const SlipTable& t) const {
    const double share = t.length / length_;
    return share * share * course_.bow();
  }
  /// N/s, so many seconds after the piece begins.
  [[nodiscard]] double normal_rate(double time) const {
    return (course_.slope() - 12.0 * course_.bow() * (length_ - left_ + time) / length_) / length_;
  }
  /// Shortens a piece to where a value is 0 that changes its sign in it from a time on, by false position (Illinois). `make` makes a piece of a
  /// length and gives its value at the end.   @return whether anything is left of it
  template <class Make>
  bool cut(double from, double to, double at_start, double at_end, const Make& make) const {
    const double enough = located * std::abs(at_end - at_start);
    bool was_before = false;
    for (int i = 0; i < most_iterations; ++i) {
      const double time = from + (to - from) * at_start / (at_start - at_end);
      if (!(time > shortest_piece * length_))
        return false;
      const double value = make(time);
      if (std::abs(value) <= enough)
        break;
      const bool before = (value > 0.0) == (at_start > 0.0);
      (before ? from : to) = time;
      (before ? at_start : at_end) = value;
      if (i > 0 && before == was_before)
        (before ? at_end : at_start) *= 0.5;
      was_before = before;
    }
    return true;
  }

  /// A piece with its state at the end.
  struct Piece {
    V force, growth, by, velocity, spring, along;
    double normal; ///< N, at the end
  };
  /// m/s2, mean over a piece.
  [[nodiscard]] V acceleration(double time) const { return acceleration_ + (0.5 * time) * path_.jerk; }
  /// m: without friction, and without what a damper adds that answers the velocity.
  [[nodiscard]] V free_displacement(double time) const {
    return time * (out_.velocity + (0.5 * time) * acceleration(time) - (time * time / 12.0) * path_.jerk) +
           fourth_of(time) * path_.shift;
  }
  [[nodiscard]] V velocity_after(double time, V force) const {
    return out_.velocity + time * (acceleration(time) + path_.mobility * force);
  }

  void move_sticking(const StickTable& t, const StickTerms<M>& terms, const M& straight, const M& answer,
                     V free, Piece& p) const {
    p.by = solve(straight, V(free + answer * (path_.mobility * p.force)));
    p.velocity = velocity_after(t.length, p.force);
    p.spring = out_.spring - law_.stiffness * p.by;
    p.growth = -1.0 * (terms.stiffness * p.by + terms.damping * V(p.velocity - out_.velocity));
  }
  /// Of what grows as the fourth power of the time.
  [[nodiscard]] double fourth_of(double time) const {
    return time == length_ ? 1.0 : fourth_power(time / length_);
  }
  /// In a plane for mobilities and compliances of the same axes; of others to their commutator, of the order of Y.
  [[nodiscard]] Piece sticking(const StickTable& t) const {
    Piece p;
    const double fourth = fourth_of(t.length), twelfth = t.half / 6.0;
    const StickTerms<M> terms = stick_terms(law_, t, mobility_, path_.mobility);
    const M& k = terms.stiffness;
    const M compliance = fourth * path_.compliance,
            by_growth = twelfth * path_.mobility + (-1.0) * compliance,  // m/N
        damped = t.length * symmetric_product(terms.damping, by_growth), // s2
        straight = plus(1.0, M(-1.0 * symmetric_product(k, by_growth))), answer = plus(t.half, damped),
            gradient = plus(t.rate,
                            M(law_.stiffness * terms.end + 0.625 * symmetric_product(square(k), compliance)));
    const V a = acceleration(t.length), free = free_displacement(t.length) + damped * a;
    const V pulled = straight * V(out_.spring + k * V(twelfth * a - fourth * path_.lift));
    p.force =
        solve(M(square(straight) + symmetric_product(gradient, symmetric_product(answer, path_.mobility))),
              V(pulled - gradient * free));
    p.normal = normal_after(t.length);
    const double bound = law_.mu_static * mean_normal(t.length, p.normal), length = norm(p.force);
    if (length >
        bound) // the mean: of what is undecided after many pieces, of a bound that is touched at both ends, or passed near the end
      p.force = (bound / length) * p.force;
    move_sticking(t, terms, straight, answer, free, p);
    return p;
  }
  void stick(bool last) {
    const double over0 = norm(trial()) - law_.mu_static * normal_;
    if (over0 > 0.0 && !stands_ && !last) {
      out_.sliding = true;
      return;
    }
    StickTable t = stick_table(left_);
    Piece p = sticking(t);
    const auto over = [&] { return norm(law_.trial(p.spring, p.velocity)) - law_.mu_static * p.normal; };
    double over1 = over();
    if (const double time = lowest_after();
        over1 <= 0.0 && time < left_ && !last &&
        law_.mu_static * normal_after(time) <
            std::max(norm(trial()), norm(law_.trial(p.spring, p.velocity)))) {
      t = stick_table(time);
      p = sticking(t);
      over1 = over();
    }
    if (over1 > round_off * law_.mu_static * p.normal && !last) {
      out_.sliding = true;
      // One that has just come to a stand is at its bound, but for what locating it leaves: the bound is looked for in the direction of the end.
      const V end = unit(law_.trial(p.spring, p.velocity));
      const bool inside = over0 < -located * (over1 - over0);
      const double start = inside ? over0 : dot(trial(), end) - law_.mu_static * normal_;
      if (!(start < 0.0) || !cut(0.0, t.length, start, over1, [&](double time) {
            t = stick_table(time);
            p = sticking(t);
            return inside ? over() : dot(law_.trial(p.spring, p.velocity), end) - law_.mu_static * p.normal;
          }))
        return;
    }
    stands_ = false;
    pass(t.length, p);
  }

  /// Against the force, m/s.
  [[nodiscard]] double slider_speed(V along) const {
    return slider_speed(along, out_.spring, out_.velocity, normal_, normal_rate(0.0));
  }
  [[nodiscard]] double slider_speed(V along, V spring, V velocity, double normal, double rate) const {
    return lag_ > 0.0 ? (dot(law_.trial(spring, velocity), along) - law_.mu_dynamic * normal) / law_.damping
                      : settled_speed(along, velocity, rate);
  }
  /// What that speed goes to, as e^(-t K_T/C_T): the spring then follows its bound.
  [[nodiscard]] double settled_speed(V along) const {
    return settled_speed(along, out_.velocity, normal_rate(0.0));
  }
  [[nodiscard]] double settled_speed(V along, V velocity, double rate) const {
    return -dot(velocity, along) - law_.mu_dynamic * rate / law_.stiffness;
  }
  /// The direction of the force in a piece: at the share s, and its mean, which is shorter than 1 where it turns.
  struct Directions {
    V at_share, mean;
  };
  /// Force and displacement of a piece.
  void push_slipping(const SlipTable& t, V before, const Directions& force, V free, Piece& p) const {
    const double mu = law_.mu_dynamic;
    p.along = unit(before + (1.0 / t.share) * (force.at_share - before));
    p.normal = normal_after(t.length);
    p.force = mu * mean_normal(t.length, p.normal) * force.mean;
    p.growth = mu * (p.normal * p.along - normal_ * before);
    p.by = free + t.half * (path_.mobility * V(p.force - (1.0 / 6.0) * p.growth)) +
           fourth_of(t.length) * (path_.compliance * p.growth);
  }
  /// By radial return, which is implicit.
  [[nodiscard]] Directions returned(const SlipTable& t, V before, V free, double bound) const {
    const Vec2 at = direction(t.gradient * t.half, path_.mobility, out_.spring - t.gradient * free, bound);
    return dot(at, before) < turned_round ? Directions{before, before}
                                          : Directions{at, unit(before + (0.5 / t.share) * (at - before))};
  }
  /// N: 1/N has the mean 1/n until a time, by Radau's rule, which has the start among its places and not the end. A spring of a touch has no direction yet: n = 0.
  [[nodiscard]] double turning_normal(double until) const {
    const double later = normal_after(2.0 / 3.0 * until), sum = later + 3.0 * normal_;
    return sum > 0.0 ? 4.0 * normal_ * later / sum : 0.0;
  }
  /// As the piece moves by a displacement. The slider does not move against its force: |P| goes to mu_d N or more.
  [[nodiscard]] Directions turned(const SlipTable& t, V before, V by) const {
    const double moved = norm(by);
    if (!(moved > 0.0))
      return {before, before};
    const Vec2 trial = out_.spring - t.rate * by, to = (-1.0 / moved) * by,
               start = norm(trial) > 0.0 ? unit(trial) : to;
    if (dot(start, to) < turned_round)
      return {before, before};
    const double goes_to =
        law_.mu_dynamic * turning_normal(t.share * t.length) + t.rate * moved * std::max(0.0, dot(start, to));
    const double length = goes_to + (norm(trial) - goes_to) * mean_decay(t);
    const TurningSlip turning(start, to);
    const double a = law_.stiffness * moved / length;
    const Vec2 at = turning.after(t.share * a);
    return dot(at, before) < turned_round ? Directions{before, before} : Directions{at, turning.mean(a)};
  }
  [[nodiscard]] Piece slipping(const SlipTable& t, V before) const {
    Piece p;
    const double bound = law_.mu_dynamic * (normal_after(t.share * t.length) - 6.0 * bow(t) * t.spread);
    const V free = free_displacement(t.length);
    Directions force{before, before};
    if constexpr (std::is_same_v<V, Vec2>) {
      push_slipping(t, before, returned(t, before, free, bound), free, p);
      force = turned(t, before, p.by);
    }
    push_slipping(t, before, force, free, p);
    p.velocity = velocity_after(t.length, p.force);
    p.spring = out_.spring + t.relaxed * (bound * force.at_share - out_.spring);
    return p;
  }
  void slip(bool last) {
    const V before = heading();
    SlipTable t = slip_table(left_);
    Piece p = slipping(t, before);
    const auto speed = [&] {
      return slider_speed(p.along, p.spring, p.velocity, p.normal, normal_rate(t.length));
    };
    if (const double speed1 = speed(); speed1 < 0.0 && !last) {
      out_.sliding = false;
      stands_ = true;
      const auto make = [&](double time) {
        t = slip_table(time);
        p = slipping(t, before);
        return speed();
      };
      const double speed0 = slider_speed(before), settled = settled_speed(before);
      // past the fall of the spring false position would have nothing to go by but a speed that has gone
      const double fall = settled > 0.0 ? lag_ * std::log(std::max(1.0, std::abs(speed0 - settled) / settled))
                          : settled < 0.0 ? lag_ * std::log1p(std::max(0.0, speed0) / -settled)
                                          : 0.0;
      double from = 0.0, to = left_, at_start = speed0, at_end = speed1;
      if (fall > shortest_piece * length_ && fall < 0.5 * left_) {
        const double fallen = make(fall);
        (fallen > 0.0 ? from : to) = fall;
        (fallen > 0.0 ? at_start : at_end) = fallen;
      }
      if (!(at_start > 0.0) || !cut(from, to, at_start, at_end, make))
        return;
    }
    // Simpson's rule, the velocity a parabola by its ends and its mean
    const double n1 = p.normal, v0 = norm(out_.velocity), v1 = norm(p.velocity),
                 middle = norm(V((1.5 / t.length) * p.by - 0.25 * (out_.velocity + p.velocity)));
    out_.slid += t.length * (v0 + 4.0 * middle + v1) / 6.0;
    out_.wear_work += t.length * (normal_ * v0 + 4.0 * normal_after(0.5 * t.length) * middle + n1 * v1) / 6.0;
    out_.sliding_time += t.length;
    // Force and speed of the slider are parabolas in time, the speed but for what is left of its start, which decays as e^-r: to the product of their means,
    // what they grow together.
    const double mu = law_.mu_dynamic, growth = mu * (n1 - normal_), b = mu * bow(t);
    const double lag = law_.damping / (law_.stiffness * t.length); // 1/r
    const double decaying =
        dot(out_.spring, before) - mu * normal_ + lag * (growth + 6.0 * b + 12.0 * lag * b);
    // A force that turns at one length does no work on the spring: it is between the forces at both ends.
    const V between = norm(p.force) * unit(V(before + p.along));
    const double work = -dot(p.force, p.by) - dot(between, V(p.spring - out_.spring)) / law_.stiffness -
                        growth * (t.length / 12.0 * (dot(p.velocity, p.along) - dot(out_.velocity, before)) -
                                  dot(path_.lift_under(p.force, p.growth, fourth_of(t.length)), before) +
                                  (t.relaxed * (t.share - 0.5) * decaying - b) / law_.stiffness);
    out_.slider_work += std::max(0.0, work); // below 0 only where nothing is resolved
    pass(t.length, p);
  }

  void pass(double time, const Piece& p) {
    const double done = length_ - left_, middle = done + 0.5 * time - 0.5 * length_;
    out_.impulse = out_.impulse + time * p.force;
    out_.moment = out_.moment + time * (middle * p.force + time / 12.0 * p.growth);
    out_.displacement = out_.displacement + p.by;
    out_.velocity = p.velocity;
    acceleration_ = acceleration_ + time * path_.jerk;
    out_.spring = p.spring;
    normal_ = p.normal;
    if (time < left_)
      out_.at_changes = std::max(out_.at_changes, std::min(law_.mu_static * normal_, norm(trial())));
    left_ = time < left_ ? left_ - time : 0.0;
  }

  const FrictionLaw& law_;
  const PieceTables& usual_;
  double mobility_;
  const TangentialPath<V, M>& path_;
  const ParabolicForce& course_;
  V acceleration_; ///< m/s2, without friction
  FrictionInterval<V> out_;
  double length_, left_, normal_; ///< s, s, N
  double lag_;                    ///< s, C_T/K_T; 0: as without damper
  bool stands_ = false; ///< the slider has just come to a stand: round-off may have it above the bound
};

} // namespace
FrictionInterval<double> friction_over_interval(const FrictionLaw& law, const PieceTables& usual,
                                                double mobility, double spring, bool sliding, double length,
                                                const ParabolicForce& normal,
                                                const TangentialPath<double, double>& path) {
  return Pieces<double, double>(law, usual, mobility, spring, sliding, length, normal, path).all();
}
FrictionInterval<Vec2> friction_over_interval(const FrictionLaw& law, const PieceTables& usual,
                                              double mobility, Vec2 spring, bool sliding, double length,
                                              const ParabolicForce& normal,
                                              const TangentialPath<Vec2, Sym2>& path) {
  return Pieces<Vec2, Sym2>(law, usual, mobility, spring, sliding, length, normal, path).all();
}

double spring_left(const FrictionLaw& law, double t) {
  return law.damping > 0.0 ? std::exp(-law.stiffness * t / law.damping) : 0.0;
}

} // namespace fretwork::contact
