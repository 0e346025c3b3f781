// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact over an interval of a step of the splitting scheme: its normal force and friction by the laws over intervals
/// (contact/normal_interval.hpp, contact/friction_interval.hpp), and where they take it.
#pragma once
#include "contact/friction_interval.hpp"
#include "contact/normal_interval.hpp"
#include "contact/support.hpp"
#include <cmath>

namespace fretwork::transient {

/// A vector along y z x. What moves in the plane of the contact is computed in pairs.
struct Components {
  using Pair [[gnu::vector_size(16)]] = double;
  Pair yz = {};
  double x = 0.0;
  Components() = default;
  Components(double along_y, double along_z, double along_x) : yz{along_y, along_z}, x(along_x) {}
  Components(Pair plane, double along_x) : yz(plane), x(along_x) {}
  [[nodiscard]] double y() const { return yz[0]; }
  [[nodiscard]] double z() const { return yz[1]; }
};
inline Components operator+(const Components& a, const Components& b) { return {a.yz + b.yz, a.x + b.x}; }
inline Components operator-(const Components& a, const Components& b) { return {a.yz - b.yz, a.x - b.x}; }
inline Components operator*(double s, const Components& a) { return {s * a.yz, s * a.x}; }
/// Along n, and along t.
[[nodiscard]] inline double normal(const contact::ContactAxes& axes, const Components& c) {
  return axes.normal(c.y(), c.z());
}
[[nodiscard]] inline double tangent(const contact::ContactAxes& axes, const Components& c) {
  return axes.tangent(c.y(), c.z());
}
inline double sum_of_sizes(const Components& c) { return std::abs(c.y()) + std::abs(c.z()) + std::abs(c.x); }

/// Acceleration of one contact by a force on another, or on itself: W, 1/kg, rows and columns y z x.
class Mobility {
public:
  [[nodiscard]] double operator()(int to, int from) const { return to < 2 ? yz_[from][to] : x_[from]; }
  void add(int to, int from, double w) {
    if (to < 2)
      yz_[from][to] += w;
    else
      x_[from] += w;
  }
  [[nodiscard]] Components operator*(const Components& f) const {
    return {f.y() * yz_[0] + f.z() * yz_[1] + f.x * yz_[2], x_[0] * f.y() + x_[1] * f.z() + x_[2] * f.x};
  }

private:
  Components::Pair yz_[3] = {}; ///< columns
  double x_[3] = {};            ///< row
};

/// What is remembered of a contact from step to step.
struct ContactPast {
  contact::FrictionMemory friction;
  contact::ContactAxes axes; ///< of its last force
  bool closed = false;       ///< at the end of the last step
  bool before_run = false;   ///< it has been closed since before the run: its impact is still to be counted
  double spring_at_opening = 0.0; ///< N2, square of the spring's force
  Components rise;                ///< N/s, of its force in its last interval
};

/// Where a contact is in a step and what acts on it. Without its own force it moves by u + v t + a t^2/2 + j t^3/6.
struct ContactPath {
  double t = 0.0; ///< s, in the step
  Components u, v, a, j;
  Components force, rise; ///< N, N/s: at the end of the last interval; the first guess of the next goes on so
  contact::Location at;   ///< its gap is that of the laws while the contact is closed
  [[nodiscard]] Components displacement(double time) const {
    return time * (v + 0.5 * time * (a + (time / 3.0) * j));
  }
  [[nodiscard]] Components velocity(double time) const { return v + time * (a + 0.5 * time * j); }
  /// With a further acceleration that is linear in time: its mean and its growth, m/s2.
  void move(double time, const Components& by, const Components& growth) {
    u = u + displacement(time) + (time * time) * (0.5 * by - (1.0 / 12.0) * growth);
    v = velocity(time) + time * by;
    a = a + time * j;
    t += time;
  }
};

/// What the laws need of an interval of a given length.
struct IntervalTable {
  double length = 0.0;            ///< s
  double apparent_mass = 0.0;     ///< kg: force for an acceleration of 1 m/s2 over it
  double growing = 0.0;           ///< N s/m, c' of normal_interval.hpp
  contact::FrictionTable table{}; ///< of the memory `reference`
};

/// An interval with its forces.
struct IntervalForces {
  contact::ContactAxes axes; ///< of the interval
  contact::Location to;      ///< at its end
  double turned = 1.0;       ///< cosine of the angle by which the normal turns
  double curvature = 0.0;    ///< 1/m, by which it turns on the way
  Components turn;           ///< of the normal, its change
  contact::NormalInterval normal;
  contact::FrictionMemory memory;                        ///< at its end
  contact::Vec2 friction, friction_growth, displacement; ///< N, N, m
  double friction_square = 0.0, slider_work = 0.0, damper_work = 0.0, wear_work = 0.0, slid = 0.0,
         sliding_time = 0.0;
  Components force, growth; ///< N: the mean, and how much a linear force with its mean and first moment grows
  /// By more than 0.2 rad, as over an edge.
  [[nodiscard]] bool turns_far() const { return turned < 0.98 && normal.force > 0.0; }
};

class ContactIntervals {
public:
  /// @param support  must live longer   @param rest  of the contact without displacement, m   @param in_plane  friction acts along x too
  /// @param usual  s, length of most intervals
  /// @param tolerance  rad: an interval is made again until what its force changes turns its normal by so little
  ContactIntervals(const contact::Support& support, const Components& rest, const Mobility& mobility,
                   bool in_plane, double usual, double tolerance);
  /// From now on most intervals have this length. No allocation.
  void set_usual(double length);
  [[nodiscard]] const IntervalTable& usual() const { return usual_; }
  [[nodiscard]] IntervalTable table(double length) const;

  [[nodiscard]] contact::Location locate(const Components& u) const {
    return contact::locate(obstacle_, u.y() + rest_.y(), u.z() + rest_.z());
  }
  /// 1/m, by which the normal turns towards t where the contact moves along t.
  [[nodiscard]] double curvature(const Components& u) const {
    return contact::curvature(obstacle_, u.y() + rest_.y(), u.z() + rest_.z());
  }
  /// The forces of an interval. No allocation.
  /// @param may_shorten  friction is not looked for where the contact opens in the interval, or its normal turns far
  /// @return whether all forces have been found
  bool find_forces(const ContactPath& m, const ContactPast& past, const IntervalTable& of, bool may_shorten,
                   IntervalForces& p) const;
  /// An open contact forgets over `time`. Returns what its spring dissipates, J.
  double relax(ContactPast& past, double time) const;
  [[nodiscard]] const Mobility& mobility() const { return w_; }

private:
  void find_normal_force(const ContactPath& m, const Components& guessed, const Components& growth,
                         const IntervalTable& of, IntervalForces& p) const;
  void find_friction(const ContactPath& m, const ContactPast& past, const IntervalTable& of,
                     IntervalForces& p) const;
  void find_closed_friction(const ContactPath& m, const IntervalTable& of, IntervalForces& p) const;

  const contact::Obstacle& obstacle_;
  const contact::NormalLaw normal_;
  const contact::FrictionLaw friction_;
  Components rest_;
  Mobility w_;
  bool in_plane_;
  double mobility_; ///< 1/kg, the largest along any direction
  double across_;   ///< 1/kg: acceleration along one of its directions by a force along another
  double tolerance_;
  IntervalTable usual_;
  contact::PieceTables usual_pieces_{}; ///< of an interval of the usual length
};

} // namespace fretwork::transient
