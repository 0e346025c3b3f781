// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces of a step h that keeps the energy, constant over the step, all contacts together. The places x of the contacts
/// at the end of the step, and their velocities, answer them,
///     x1 = xf + W f,    W = B diag(R0(h)) B^T,    x1' = xf' + W' f    (oscillator.hpp; xf: without contact forces)
/// and they are made from both ends, with p = -gap, <p> = max(p, 0):
///     normal    F from the penetrations at both ends and its rate at the end (conserving_normal.hpp), along the discrete gradient D of the
///               gap: the spring's part does the work -(V1 - V0), V = K_N <p>^2/2, and what the dampers and the positive part take is >= 0
///     friction  along t and x_loc, normal force F |D|, n = D/|D|, t = n x x_loc, of dx = (x1 - x0).(x_loc, t), from the spring T at the
///               start, over the part of the step in which p > 0: conserving_friction.hpp
/// The unknowns are the forces, f = Phi(xf + W f): Newton's method with the derivatives of every law and of D (semi-smooth: one side
/// at kinks), shortened until the residual falls, to round-off of the positions. Where Phi jumps it is made continuous and taken again:
///   - a contact that reaches mu_s F_N is solved with the bound mu_s F_N first, then with mu_d F_N;
///   - `reference` slip, opposite to dx, is F = P(F - rho dx), P onto |F| <= mu_d F_N, for any rho > 0: also where F stops the node;
///   - a profile's mean normal is held after some iterations (discrete_gradient.hpp).
/// Contacts that are open at both ends have no force. Those taken as open are tested again with the forces found.
#pragma once
#include "transient/conserving/conserving_friction.hpp"
#include "transient/conserving/discrete_gradient.hpp"

namespace fretwork::transient {

class ConservingContacts {
public:
  /// W, m/N, and W', m/s per N, laid out as PackedContacts::mobility.
  struct Mobilities {
    kernels::Array place, rate;
  };

  /// @param contacts  must live longer
  explicit ConservingContacts(const PackedContacts& contacts);

  /// Forces of a step. The memory is read only. No allocation.
  /// @param start, free  motion at the start of the step, and at its end without contact forces
  /// @param trial  overwritten: the step as it is to be committed; `springs` belong to its end
  /// @return whether the forces were found
  [[nodiscard]] bool solve(double step, const Mobilities& mobilities, const FrictionMemories& memory,
                           ContactMotion& start, ContactMotion& free, ContactTrial& trial);
  /// Accepts the step of the last solution, of h seconds (FrictionMemories::commit).   @param end  motion at its end
  ContactLosses commit(double h, const ContactMotion& end, FrictionMemories& memory,
                       ContactTrial& trial) const;
  /// Evaluations of all forces so far.
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
  void visit(core::StateArchive& state) { state(evaluations_); }

private:
  /// A contact that takes part in the step.
  struct ActiveContact {
    int contact;
    bool in_plane, broken, is_held;
    bool slides_at_touch; ///< FrictionLaw::slides_at_touch
    contact::PlanePoint x0, held;
    contact::Location from;
    double free[3];              ///< y, z from the obstacle's centre and x_loc, from where it started
    double stiffness;            ///< N/m, of all its laws: what the rounding of a position weighs
    double rho;                  ///< N/m
    contact::ContactAxes axes;   ///< where it is closed at the start, or would be at the end: of the rate p1'
    double free_rate, end_share; ///< m/s, p1' without contact forces; share of p1' in the damper's rate
  };
  /// What a contact answers to a place.
  struct Response {
    double force[3];       ///< y, z, x_loc
    double by_place[3][3]; ///< N/m
    double by_force[3][3];
    double by_rate[3];         ///< N s/m, of p1'
    double normal;             ///< F |D|
    contact::ContactAxes axes; ///< D/|D|
    double p0, p1;             ///< m
    ClosedPart closed;         ///< where p > 0
    double spring_force;       ///< N, of which `normal_of_gap` less this is the dampers'
    double normal_of_gap;      ///< F
    double rounding;           ///< N
    contact::Vec2 friction, displacement;
    bool slides, breaks; ///< breaks: to be taken again with the force of sliding
  };
  /// A contact with a force in the step: what its memory needs.
  struct ContactPart {
    int contact;
    ClosedPart closed;
    double end_penetration; ///< m, < 0: open
  };
  /// Derivatives of D/|D|, of F |D| and of the share of the step that is closed by the place, 1/m, N/m and 1/m; of F |D| by p1', N s/m.
  struct Turning {
    double turn[2], normal[2], share[2], by_rate;
  };
  struct Setting {
    double h;
    const Mobilities& mobilities;
    const FrictionMemories& memory;
  };

  void activate(int c, const Setting& s, const ContactMotion& start, const ContactMotion& free);
  [[nodiscard]] bool is_active(int c) const;
  [[nodiscard]] bool extend_active_set(const Setting& s, const ContactMotion& start,
                                       const ContactMotion& free);
  [[nodiscard]] bool break_loose();
  [[nodiscard]] bool iterate(const Setting& s);
  double respond(const Setting& s);
  void respond(const Setting& s, const ActiveContact& active, const double* place, double rate,
               const double* force, Response& r) const;
  void find_friction(const Setting& s, const ActiveContact& active, const double* place, const double* force,
                     const Turning& turning, Response& r) const;
  [[nodiscard]] bool converged(double slack) const;
  [[nodiscard]] bool direction(const Setting& s);
  [[nodiscard]] std::size_t place_of(std::size_t i, std::size_t a, std::size_t j, std::size_t b) const;
  [[nodiscard]] double mobility(const Setting& s, std::size_t i, std::size_t a, std::size_t j,
                                std::size_t b) const;
  [[nodiscard]] double rate_mobility(const Setting& s, std::size_t i, std::size_t j, std::size_t b) const;
  void close(const ContactMotion& start, ContactTrial& trial);

  const PackedContacts& contacts_;
  std::size_t size_; ///< components of a contact: y, z and, where a contact slides in the plane, x
  std::vector<ActiveContact> active_;
  std::vector<Response> response_;
  std::vector<ContactPart> parts_; ///< by increasing contact: those of the trial
  std::vector<double> force_, residual_, matrix_, step_, base_;
  ContactMotion answer_; ///< where all contacts end with the forces there are
  std::int64_t evaluations_ = 0;
};

} // namespace fretwork::transient
