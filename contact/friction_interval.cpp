// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_interval.hpp"
#include "contact/normal_interval.hpp"
#include <algorithm>
#include <type_traits>

namespace fretwork::contact {
namespace {

/// Changes between stick and slip that an interval is searched for: to slide, stick, slide and stick again.
constexpr int most_events = 4;
/// Of an interval: what is shorter is none.
constexpr double shortest_piece = 1e-9;
/// K_T tau/C_T above which the damper is none, and below which e^-r is a series.
constexpr double no_damper = 1e8, slow_damper = 1e-4;

double unit(double a) { return std::copysign(1.0, a); }
Vec2 unit(Vec2 a) {
  const double length = norm(a);
  return length > 0.0 ? (1.0 / length) * a : Vec2{};
}

/// (1 + s A) f = b.
double solve(double s, double a, double b) { return b / (1.0 + s * a); }
Vec2 solve(double s, const Sym2& a, Vec2 b) {
  const double xx = 1.0 + s * a.xx, xt = s * a.xt, tt = 1.0 + s * a.tt;
  const double det = xx * tt - xt * xt;
  return {(tt * b.x - xt * b.t) / det, (xx * b.t - xt * b.x) / det};
}

/// Direction of the f of a length with (1 + s A + l) f = b, l >= 0.
Vec2 direction(double s, const Sym2& a, Vec2 b, double length) {
  if (!(length > 0.0) || (a.xt == 0.0 && a.xx == a.tt))
    return unit(b);
  return unit(force_of_length(length, {1.0 + s * a.xx, s * a.xt, 1.0 + s * a.tt}, b));
}

template <class V, class M> class Pieces {
public:
  Pieces(const FrictionLaw& law, const PieceTable& usual, double mobility, V spring, bool sliding,
         double length, double normal0, double normal1, const TangentialPath<V, M>& path)
      : law_(law), usual_(usual), mobility_(mobility), path_(path), left_(length), normal_(normal0),
        growth_((normal1 - normal0) / length) {
    out_.spring = spring;
    out_.velocity = path.velocity;
    out_.sliding = sliding;
  }

  FrictionInterval<V> all() {
    if (out_.sliding && slider_speed(unit(trial())) < 0.0)
      out_.sliding = false;
    for (int events = 0; left_ > 0.0; ++events)
      out_.sliding ? slip(events >= most_events) : stick(events >= most_events);
    return out_;
  }

private:
  [[nodiscard]] PieceTable table(double time) const {
    return time == usual_.length ? usual_ : piece_table(law_, mobility_, time);
  }
  [[nodiscard]] V trial() const { return law_.trial(out_.spring, out_.velocity); }

  /// A piece with its state at the end.
  struct Piece {
    V force, by, velocity, spring, along;
  };
  /// Without its own force; `answer`: what an acceleration of 1 moves it, s2.
  [[nodiscard]] V free_displacement(const PieceTable& t, double answer) const {
    return t.length * out_.velocity + answer * path_.acceleration;
  }
  void move(const PieceTable& t, V free, double answer, Piece& p) const {
    p.by = free + answer * (path_.mobility * p.force);
    p.velocity = out_.velocity + t.length * (path_.acceleration + path_.mobility * p.force);
  }

  [[nodiscard]] Piece sticking(const PieceTable& t) const {
    Piece p;
    const V free = free_displacement(t, t.answer);
    p.force = solve(t.stick_gradient * t.answer, path_.mobility, out_.spring - t.stick_gradient * free);
    move(t, free, t.answer, p);
    p.spring = out_.spring - law_.stiffness * p.by;
    return p;
  }
  void stick(bool last) {
    const double over0 = norm(trial()) - law_.mu_static * normal_;
    if (over0 > 0.0 && !stands_ && !last) {
      out_.sliding = true;
      return;
    }
    PieceTable t = table(left_);
    Piece p = sticking(t);
    const double over1 =
        norm(law_.trial(p.spring, p.velocity)) - law_.mu_static * (normal_ + growth_ * left_);
    if (over1 > 0.0 && !last) {
      out_.sliding = true;
      const double part = over0 < 0.0 ? over0 / (over0 - over1) : 0.0;
      if (!(part > shortest_piece))
        return;
      t = table(left_ * part);
      p = sticking(t);
    }
    const double bound = law_.mu_static * (normal_ + 0.5 * growth_ * t.length), length = norm(p.force);
    if (length >
        bound) { // the mean: of what `last` leaves undecided, of a bound that is touched at both ends, or passed near the end
      p.force = (bound / length) * p.force;
      move(t, free_displacement(t, t.answer), t.answer, p);
    }
    stands_ = false;
    pass(t, p);
  }

  /// Against the force, m/s.
  [[nodiscard]] double slider_speed(V along) const {
    return slider_speed(along, out_.spring, out_.velocity, normal_);
  }
  [[nodiscard]] double slider_speed(V along, V spring, V velocity, double normal) const {
    return law_.damping > 0.0
               ? (dot(law_.trial(spring, velocity), along) - law_.mu_dynamic * normal) / law_.damping
               : -dot(velocity, along) - law_.mu_dynamic * growth_ / law_.stiffness;
  }
  [[nodiscard]] Piece slipping(const PieceTable& t, V before) const {
    Piece p;
    const double mu = law_.mu_dynamic, bound = mu * (normal_ + t.share * growth_ * t.length);
    const double answer = 0.5 * t.length * t.length;
    const V free = free_displacement(t, answer);
    V mean = p.along = before;
    if constexpr (std::is_same_v<V, Vec2>) {
      p.along =
          direction(t.slip_gradient * answer, path_.mobility, out_.spring - t.slip_gradient * free, bound);
      mean = unit((1.0 - 0.5 / t.share) * before + (0.5 / t.share) * p.along);
    }
    p.force = mu * (normal_ + 0.5 * growth_ * t.length) * mean;
    move(t, free, answer, p);
    p.spring = out_.spring + t.relaxed * (bound * p.along - out_.spring);
    return p;
  }
  void slip(bool last) {
    const V before = unit(trial());
    PieceTable t = table(left_);
    Piece p = slipping(t, before);
    const double speed1 = slider_speed(p.along, p.spring, p.velocity, normal_ + growth_ * left_);
    if (speed1 < 0.0 && !last) {
      out_.sliding = false;
      stands_ = true;
      const double speed0 = slider_speed(before);
      const double part = speed0 > 0.0 ? speed0 / (speed0 - speed1) : 0.0;
      if (!(part > shortest_piece))
        return;
      t = table(left_ * part);
      p = slipping(t, before);
    }
    const double n1 = normal_ + growth_ * t.length;
    const double v0 = norm(out_.velocity), twice = 2.0 * norm(p.by) / t.length,
                 v1 = norm(p.velocity); // Simpson's rule
    out_.slid += t.length * (v0 + 2.0 * twice + v1) / 6.0;
    out_.wear_work += t.length * (normal_ * v0 + (normal_ + n1) * twice + n1 * v1) / 6.0;
    out_.sliding_time += t.length;
    // The force is linear in time. The slider's speed is linear but for what is left of |T| - mu_d N at the start, which decays as e^-r: to the
    // product of their means, by how much the motion of the slider lies before the middle of the piece.
    const double mu = law_.mu_dynamic, growth = mu * (n1 - normal_);
    const double before_middle = t.relaxed * (t.share - 0.5) / law_.stiffness;
    out_.slider_work -= dot(p.force, V(p.by + (1.0 / law_.stiffness) * (p.spring - out_.spring)));
    out_.slider_work -= growth * (t.length / 12.0 * (dot(p.velocity, p.along) - dot(out_.velocity, before)) +
                                  before_middle * (law_.damping / (law_.stiffness * t.length) * growth +
                                                   dot(out_.spring, before) - mu * normal_));
    pass(t, p);
  }

  void pass(const PieceTable& t, const Piece& p) {
    out_.impulse = out_.impulse + t.length * p.force;
    out_.displacement = out_.displacement + p.by;
    out_.velocity = p.velocity;
    out_.spring = p.spring;
    normal_ += growth_ * t.length;
    left_ = t.length < left_ ? left_ - t.length : 0.0;
  }

  const FrictionLaw& law_;
  const PieceTable& usual_;
  double mobility_;
  const TangentialPath<V, M>& path_;
  FrictionInterval<V> out_;
  double left_, normal_, growth_; ///< s, N, N/s
  bool stands_ = false; ///< the slider has just come to a stand: round-off may have it above the bound
};

} // namespace
PieceTable piece_table(const FrictionLaw& law, double mobility, double length) {
  PieceTable t;
  const double c = law.damping / length, r = law.damping > 0.0 ? law.stiffness / c : no_damper;
  t.length = length;
  t.answer = implicit_share(law.damping * mobility * length) * length * length;
  t.relaxed = r < no_damper ? -std::expm1(-r) : 1.0;
  t.share = r < slow_damper ? 0.5 + r / 12.0 : 1.0 / t.relaxed - (r < no_damper ? 1.0 / r : 0.0);
  t.stick_gradient = 0.5 * law.stiffness + c;
  t.slip_gradient = t.share * law.stiffness + c;
  return t;
}

FrictionInterval<double> friction_over_interval(const FrictionLaw& law, const PieceTable& usual,
                                                double mobility, double spring, bool sliding, double length,
                                                double normal0, double normal1,
                                                const TangentialPath<double, double>& path) {
  return Pieces<double, double>(law, usual, mobility, spring, sliding, length, normal0, normal1, path).all();
}
FrictionInterval<Vec2> friction_over_interval(const FrictionLaw& law, const PieceTable& usual,
                                              double mobility, Vec2 spring, bool sliding, double length,
                                              double normal0, double normal1,
                                              const TangentialPath<Vec2, Sym2>& path) {
  return Pieces<Vec2, Sym2>(law, usual, mobility, spring, sliding, length, normal0, normal1, path).all();
}

double spring_left(const FrictionLaw& law, double t) {
  return law.damping > 0.0 ? std::exp(-law.stiffness * t / law.damping) : 0.0;
}

} // namespace fretwork::contact
