// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The path of sliding contacts in a scheme whose contact forces act at instants.
///
/// At an instant t_k the velocity jumps by h W f, and a sliding contact is moved by h w, w the mean of its velocities before and after.
/// Such a scheme does not keep H = v.v/2 + V(u) but, up to h^4 (Hairer, Lubich, Wanner, Geometric Numerical Integration, IX.3),
///     H + (h^2/12) w.V''w - (h^2/24) V'.W.V',
/// from which a friction F takes h F.(w + (h^2/6) W V''w): the slider's true path. -V''w is the rate of the normal force F_N n, which
/// turns with the contact point. Without it a tube that rocks in its hole slides too little, by (h^2/6) W_tt F_N/r at a curvature 1/r:
/// work rates were 2 % low at w_c h = 0.5 (doc/benchmarks.md). The rate is the change since the last step; of W the block of the contact
/// itself. A contact that has only closed keeps the path of w.
///
/// Slides that end inside a step (contact/ended_slide.hpp) are told in full where the damper ends them, C_T W_tt h >= 1. Their velocity
/// when the step begins: v- less half of what the flow has given since the last action. d is what they lose from action to action, by the
/// flow and all forces, with the friction at its bound. Those that begin with the contact's touch and end while its force still grows
/// (contact/begun_slide.hpp) likewise, told from the speeds before the action, where they end before what it stands for; not with normal
/// dampers, whose forces do not grow from nothing. The motion stays what it is: of the work of friction the slider's share changes,
/// and the paths that statistics see.
#pragma once
#include "contact/begun_slide.hpp"
#include "contact/ended_slide.hpp"
#include "transient/contact_memory.hpp"

namespace fretwork::transient {

class SlidingPaths {
public:
  /// @param contacts  must live longer   @param step  s
  /// @param moves_by_flow  whether contacts move with the modes alone: ends of slides are told only then
  SlidingPaths(const PackedContacts& contacts, double step, bool moves_by_flow);
  /// Corrects the displacements of the contacts that slide, m, and finds the slides that end; once for every step that is accepted,
  /// before its commit. No allocation.
  void correct(const ContactMotion& motion, const ContactMemory& memory, ContactTrial& trial);
  /// The same of a contact that makes its step by itself (kernels::step_alone): after its commit, as its path is corrected there.
  void end_alone(int c, bool closes, const kernels::LoneStep& step, const ContactMotion& motion,
                 const ContactState& s);
  [[nodiscard]] kernels::NormalPush& push(int c) { return last_[c].push; }
  [[nodiscard]] bool ends(int c) const { return own_[c].ends; }
  /// After the commit: paths and works of the slides that have ended. No allocation.
  void end_slides(ContactTrial& trial, ContactLosses& losses) const;
  void visit(core::StateArchive& state) { state(last_); }

private:
  struct Last {
    kernels::NormalPush push;
    contact::Vec2 left; ///< m/s, tangential velocity after the action
  };
  /// Tangential velocities after the last action, before this one and after it, m/s.
  struct Speeds {
    contact::Vec2 left, before, after;
  };
  struct Ended {
    int contact;
    double path;         ///< m
    double pressed_path; ///< J, integral of F_N over it
    double slider_work;  ///< J
    double normal_loss;  ///< J, by the normal damper
  };
  /// Of the contact itself.
  struct Own {
    double yy, yz, zz;        ///< W, 1/kg
    bool ends;                ///< its slides may be ended by its damper
    double per_damping = 0.0; ///< 1/C_T, m/(N s)
  };
  /// A contact before its commit, along x_loc and t.
  struct Before {
    contact::FrictionMemory memory;
    contact::Vec2 mean_slip; ///< m/s, of those before and after the action
    double normal_loss;      ///< J, by the normal damper
  };
  void find_ends(int c, bool closes, const Before& before, const ContactState& s,
                 const ContactMotion& motion);
  void find_end(int c, const ContactState& s, const Speeds& speeds, const Before& before);
  void find_begun(int c, const ContactState& s, const ContactMotion& motion, const Before& before);
  [[nodiscard]] bool ends_along_line(int c, const ContactState& s, const Speeds& speeds, double spring) const;
  [[nodiscard]] contact::Mobility tangent_mobility(int c, double ny, double nz) const;

  const PackedContacts& contacts_;
  double h_;
  std::vector<Own> own_;
  std::vector<Last> last_; ///< action
  std::vector<Ended> ended_;
};

} // namespace fretwork::transient
