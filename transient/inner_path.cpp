// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/inner_path.hpp"
#include <algorithm>

namespace fretwork::transient {

using contact::Vec2;

namespace {

constexpr int parts = SpringTable::parts;

/// The end of a part of a half step: the cubic by p and h p'/2 at both ends, its derivative times h/2.
struct Cubic {
  double p[4], rate[4]; ///< by p and h p'/2 at the begin, p and h p'/2 at the end
};
constexpr Cubic cubic_at(double x) {
  const double y = 1.0 - x;
  return {{(1.0 + 2.0 * x) * y * y, x * y * y, x * x * (3.0 - 2.0 * x), -x * x * y},
          {-6.0 * x * y, y * (1.0 - 3.0 * x), 6.0 * x * y, x * (3.0 * x - 2.0)}};
}
constexpr auto cubics = [] {
  std::array<Cubic, parts> out{};
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = cubic_at(static_cast<double>(i + 1) / parts);
  return out;
}();

/// The quadratic through values at the nodes, at s.
template <class Value> Value quadratic(double s, const Value& first, const Value& middle, const Value& last) {
  return (1.0 - s) * (1.0 - 2.0 * s) * first + 4.0 * s * (1.0 - s) * middle + s * (2.0 * s - 1.0) * last;
}

enum class Branch { open, sticks, slides };
Branch branch_of(const ContactNode& node) {
  return !(node.normal > 0.0) ? Branch::open : node.slides ? Branch::slides : Branch::sticks;
}

/// Closed on the opposite face since.
bool opposite(const ContactNode& from, const ContactNode& to) {
  return from.face_y * to.face_y + from.face_z * to.face_z < 0.0;
}

/// The normal force from part to part.
class Presser {
public:
  Presser(const contact::NormalLaw& law, const ContactNode& start)
      : law_(law), depth_(start.penetration), force_(start.normal) {}
  /// The force at the end of a part, at the penetration and its rate there.
  double move(double depth, double rate) {
    const double force = contact::normal_force(law_, depth, rate), last = force_, ends = 0.5 * (last + force);
    closes_ = depth > 0.0 && !(depth_ > 0.0);
    const bool opens = depth_ > 0.0 && !(depth > 0.0);
    const double share =
        closes_ || opens ? std::max(depth, depth_) / std::abs(depth - depth_) : 1.0; // closed
    const double mean = closes_ ? 0.5 * share * (contact::normal_force(law_, 0.0, rate) + force)
                        : opens ? 0.5 * share * last
                                : ends;
    jump_ = mean - ends;
    jump_before_end_ = closes_ ? 0.5 * share : 1.0 - 0.5 * share;
    base_ = closes_ ? force : last;
    loss_ += mean * (depth - depth_) - energy(depth) + energy(depth_);
    depth_ = depth;
    return force_ = force;
  }
  /// What the mean of the forces at the ends of the last part lacks of that over the part, in which the contact closed or opened; how many
  /// parts before its end that stands; its share of the force at the end of the part that is closed.
  [[nodiscard]] double jump() const { return jump_; }
  [[nodiscard]] double jump_before_end() const { return jump_before_end_; }
  [[nodiscard]] double jump_share() const { return base_ > 0.0 ? jump_ / base_ : 0.0; }
  [[nodiscard]] bool closes() const { return closes_; }
  /// J, by the damper, and what the positive part cuts.
  [[nodiscard]] double loss() const { return loss_; }

private:
  [[nodiscard]] double energy(double depth) const {
    return depth > 0.0 ? 0.5 * law_.stiffness * depth * depth : 0.0;
  }
  const contact::NormalLaw& law_;
  double depth_, force_, jump_ = 0.0, jump_before_end_ = 0.0, base_ = 0.0, loss_ = 0.0;
  bool closes_ = false;
};

/// The tangential spring and the slider from part to part.
class Slider {
public:
  Slider(const contact::FrictionLaw& law, const SpringTable& table, const ContactNode& start, double part)
      : law_(law), table_(table), compliance_(law.stiffness > 0.0 ? 1.0 / law.stiffness : 0.0),
        bound_(start.slides ? law.mu_dynamic : law.mu_static), part_(part), spring_(start.spring),
        slip_(start.slip), force_(start.friction), slides_(start.slides) {}
  void forget() {
    loss_.damper += energy(spring_);
    spring_ = {};
  }
  /// The force at the end of a part, under the normal force and with the tangential velocity there.
  Vec2 move(double normal, Vec2 slip) {
    moved_ = (0.5 * part_) * (slip + slip_);
    const Vec2 before = spring_;
    last_ = force_;
    slid_ = slides_;
    const Vec2 stuck = before - law_.stiffness * moved_, trial = stuck - law_.damping * slip;
    const bool line = trial.x == 0.0; // neither root nor division
    const double length = line ? std::abs(trial.t) : norm(trial);
    const bool sticks = normal > 0.0 && length <= bound_ * normal;
    slip_ = slip;
    slides_ = normal > 0.0 && !sticks;
    if (normal > 0.0)
      bound_ = sticks ? law_.mu_static : law_.mu_dynamic;
    if (sticks) {
      force_ = trial;
      spring_ = stuck;
    } else {
      const double most = law_.mu_dynamic * normal;
      force_ = !(normal > 0.0) ? Vec2{}
               : line          ? Vec2{0.0, std::copysign(most, trial.t)}
                               : (most / length) * trial;
      spring_ = table_.keep_part * before + table_.part_by_last * last_ + table_.part_by_force * force_;
    }
    const Vec2 mean = 0.5 * (force_ + last_), stretch = compliance_ * (before - spring_);
    slider_ = sticks ? 0.0 : std::max(0.0, dot(mean, stretch - moved_));
    loss_.slider += slider_;
    loss_.damper += energy(before) - energy(spring_) - dot(mean, moved_) - slider_;
    return force_;
  }
  [[nodiscard]] Vec2 spring() const { return spring_; }
  /// More of the force in the mean over the last part, as a share of that at its closed end (of a contact that `closes` in it, or opens).
  /// Returns it. What sticks comes and goes without a jump.
  Vec2 jump(double share, bool closes) {
    if (!(closes ? slides_ : slid_))
      return {};
    const Vec2 more = share * (closes ? force_ : last_);
    loss_.slider += std::max(-slider_, -dot(more, moved_));
    return more;
  }
  [[nodiscard]] const PathLoss& loss() const { return loss_; }

private:
  [[nodiscard]] double energy(Vec2 spring) const { return 0.5 * compliance_ * dot(spring, spring); }
  const contact::FrictionLaw& law_;
  const SpringTable& table_;
  double compliance_, bound_, part_, slider_ = 0.0;
  Vec2 spring_, slip_, force_, last_, moved_;
  bool slides_, slid_ = false;
  PathLoss loss_;
};

} // namespace

bool changes_inside(const contact::Support& support, const ContactNode* nodes) {
  const bool rubs = support.friction.active();
  if (rubs && support.friction.kind != contact::FrictionMemoryKind::return_map)
    return false;
  for (int j = 1; j <= 2; ++j) {
    const Branch branch = branch_of(nodes[j]);
    if (branch != branch_of(nodes[j - 1]) ||
        (branch == Branch::slides && dot(nodes[j].friction, nodes[j - 1].friction) < 0.0))
      return true;
  }
  return false;
}

InnerPath inner_path(const contact::Support& support, const SpringTable& table, const ContactNode* nodes,
                     double h) {
  constexpr double part = 0.5 / parts; // of the step
  const bool rubs = support.friction.active();
  const double half = 0.5 * h;
  Presser presser(support.normal, nodes[0]);
  Slider slider(support.friction, table, nodes[0], part * h);
  double normal[2] = {}; // D_0, D_1; at the node 0 nothing is missing
  Vec2 friction[2];
  const auto miss = [&](double at, double pressed, Vec2 rubbed) {
    normal[0] += pressed;
    normal[1] += at * pressed;
    friction[0] = friction[0] + rubbed;
    friction[1] = friction[1] + at * rubbed;
  };
  InnerPath out;
  for (int j = 0; j < 2; ++j) {
    const ContactNode &from = nodes[j], &to = nodes[j + 1];
    if (opposite(from, to))
      slider.forget();
    for (int i = 0; i < parts; ++i) {
      const auto& [p, rate] = cubics[static_cast<std::size_t>(i)];
      const auto along = [&](const double* by) {
        return by[0] * from.penetration + by[1] * half * from.rate + by[2] * to.penetration +
               by[3] * half * to.rate;
      };
      const double s = part * (j * parts + i + 1), weight = s < 1.0 ? part : 0.5 * part;
      const double force = presser.move(along(p), along(rate) / half);
      const Vec2 rubbed =
          rubs ? slider.move(force, quadratic(s, nodes[0].slip, nodes[1].slip, nodes[2].slip)) : Vec2{};
      miss(s, weight * (force - quadratic(s, nodes[0].normal, nodes[1].normal, nodes[2].normal)),
           weight * (rubbed - quadratic(s, nodes[0].friction, nodes[1].friction, nodes[2].friction)));
      if (const double jump = presser.jump(); jump != 0.0)
        miss(s - part * presser.jump_before_end(), part * jump,
             part * slider.jump(presser.jump_share(), presser.closes()));
    }
    out.force[j].spring = slider.spring() - to.spring;
    out.loss[j] = {slider.loss().slider, slider.loss().damper + presser.loss()};
  }
  // the node 1 has what the node 1/2 hands on
  const double handed = opposite(nodes[1], nodes[2])            ? 0.0
                        : branch_of(nodes[2]) == Branch::sticks ? 1.0
                                                                : table.keep;
  out.force[1].spring = out.force[1].spring - handed * out.force[0].spring;
  out.force[0].normal = 3.0 * (normal[0] - normal[1]);
  out.force[1].normal = 12.0 * normal[1] - 6.0 * normal[0];
  out.force[0].friction = 3.0 * (friction[0] - friction[1]);
  out.force[1].friction = 12.0 * friction[1] - 6.0 * friction[0];
  return out;
}

} // namespace fretwork::transient
