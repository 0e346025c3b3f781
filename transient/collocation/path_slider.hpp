// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The tangential spring and the slider of a contact along its path inside a step of collocation (inner_path.hpp), by the laws of
/// nodal_contact.hpp: the tangential velocity is linear over a part, the force too but where it jumps.
#pragma once
#include "transient/collocation/inner_path.hpp"
#include "transient/collocation/tangential.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

/// From part to part.
template <int D> class PathSlider {
public:
  using Vector = Tangential<D>;
  PathSlider(const contact::FrictionLaw& law, const SpringTable& table, const ContactNode& start, double part)
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
    Vector force, missing; ///< N, at the end; the mean over the part less that of begin and end
    double before_end;     ///< place of `missing`, in parts before the end
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
          0.0)) { // the spring falls at once too; what the slider does not lose the damper takes
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

} // namespace fretwork::transient
