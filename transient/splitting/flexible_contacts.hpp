// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces of a step h, of which all act at one instant, where the contacts move by R f beside the modes
/// (Scene::residual): what a truncated basis lacks of the static flexibility, without inertia, so that no step is too long for it.
/// One contact sees it as a spring in series; several share it.
///
/// At the instant t_k of the action the contacts stand at u = B q + R f, with f = f_k the force of this step, and move by
/// u' = w + R f', w = B (v- + v+)/2, f' = (3 f_k - 4 f_{k-1} + f_{k-2})/(2 h), of order 2 and without a limit of stability (the first
/// action is h/2 after the start). With p0 the penetration (where open: 0) without the contact's own n.R n F_N,
///     normal    F_N = <K_N p + c(p) p'>+,  p = p0 - n.R n F_N       (contact::series_force)
/// and p0 such that the spring in series alone gives F_K of contact::InstantSpring
///     friction  step_friction with the velocity that makes its trial T - G h w the one at t_k:
///       return_map   trial = T - K_T (h w/2 + R f_k - y) - C_T (w + R f'),  y = R (3 f_{k-1} - f_{k-2})/2
///       reference    trial = F0 - (K_T h/2 + C_T)(w + R f'), whose slip is opposite to w + R f'
///     over the step the spring is stretched by h (w + R f'): the sum of the f' is the f that y takes at its start
/// all implicit in f, by Gauss-Seidel sweeps from the forces that the last two steps extrapolate, after some of which forces are mixed
/// (anderson_mixing.hpp): contacts that share a large K_N R answer each other strongly. A contact that the others' forces close
/// joins the sweeps. A lone contact without friction and dampers is the one of stiffness K_N/(1 + K_N R) to the last digit.
///
/// Normals turn with the forces: where R f is far above the gap, forces that only the last steps tell would swing round a hole. The
/// normal at a place is that at u - r F_N n, r the largest eigenvalue of the contact's own R across x_loc, which lies on it, deeper: a
/// round hole gives n = N(B q + (R - r) f), whose own part is a contraction at any r F_N, and nothing at all where R is the same along
/// y and z. Deeper in a profile another part may be nearest, past a corner that protrudes: there the place itself gives the normal (a facet
/// needs no contraction), and a step starts from the normal where the forces extrapolated take the contact. Normals are held after some sweeps, and so are
/// what an impact's beginning or end adds to p0 and contacts that slide: all these make the forces jump, and where the sweeps swing between two sides of a
/// jump there is no solution but on one of them.
///
/// Energy: f.R f/2 is stored.
#pragma once
#include "contact/series.hpp"
#include "transient/contacts/contact_memory.hpp"
#include "transient/splitting/anderson_mixing.hpp"

namespace fretwork::transient {

class FlexibleContacts {
public:
  /// @param contacts  must live longer   @param residual  as Scene::residual, not empty   @param step  s
  FlexibleContacts(const PackedContacts& contacts, const Eigen::MatrixXd& residual, double step);

  /// Rest before the first step: normal forces in equilibrium with the places of the modes, nothing else. Moves the contacts of `motion`
  /// by R f. Returns f.R f/2, J.
  double start(ContactMotion& motion);
  struct Action {
    double work = 0.0; ///< J, on the modes: h f.w
    double jump = 0.0; ///< J, h f.(w - B v-) = (h^2/2) f.W.f
    bool converged = true;
  };
  /// Forces at the displacements and velocities v- of `motion`, whose contacts are moved by R f. The memory is read only. No allocation.
  /// @param trial  overwritten
  Action solve(const ContactMemory& memory, ContactMotion& motion, ContactTrial& trial);
  /// The forces of the last `solve` have acted. No allocation.
  void accept();
  void visit(core::StateArchive& state) {
    state(last_, before_, last_deflection_, deflection_before_, last_own_deflection_, own_deflection_before_,
          actions_, inactive_);
  }

private:
  /// A derivative or difference in time: now f_k + last f_{k-1} + before f_{k-2}.
  struct Rate {
    double now, last, before;
  };
  struct ActiveContact {
    int contact = 0;
    double compliance = 0.0;            ///< m/N: r
    Eigen::Matrix3d mobility, residual; ///< own A and R, along n, t, x_loc
    bool friction = false, in_plane = false, slides = false;
    bool has_slid = false; ///< it has slid: from now on by the dynamic coefficient
    contact::NormalLaw normal{};
    contact::ContactAxes axes;
    double modal_penetration = 0.0; ///< m: penetration without any R f
    double closed = 0.0;            ///< share of the step with penetration
    double approach = 0.0;          ///< m/s: p' before the action
    double mean_rate = 0.0;         ///< m/s: of the modes, mean of p' since the last action
    double instant_more = 0.0;  ///< m: beyond p0, for the force that the spring in series bears at an instant
    double instant_share = 1.0; ///< of that force: contact::InstantSpring::Push
    double alone = 0.0;         ///< m: p0 and that, >= 0
    [[nodiscard]] bool acts() const { return alone > 0.0 || normal.damping > 0.0; }
    double force[3] = {};    ///< N, along n, t, x_loc, as all that follows
    double velocity[3] = {}; ///< m/s, of the modes before the action
    double last[3] = {};     ///< m, R f_{k-1}
    double before[3] = {};   ///< m, R f_{k-2}
    Rate rate{};             ///< 1/s: what R adds to the velocity of friction
  };

  [[nodiscard]] bool act(const ContactMemory* memory, ContactMotion& motion);
  void differentiate();
  void extrapolate(ContactMotion& motion);
  [[nodiscard]] contact::Location locate_active(int c, ContactMotion& motion) const;
  void activate(int c, ContactMotion& motion);
  [[nodiscard]] bool extend_active_set(ContactMotion& motion);
  void to_local(const ActiveContact& s, const kernels::Array& lanes, double* to) const;
  void find_instant(ActiveContact& s, double p0) const;
  void rotate_axes(ActiveContact& s, const ContactMotion& motion) const;
  [[nodiscard]] double turn_normal(std::size_t i, ContactMotion& motion);
  void build(const ContactMotion& motion);
  [[nodiscard]] static Eigen::Vector3d force(const ActiveContact& s);
  void add_force(int from, const Eigen::Vector3d& by);
  [[nodiscard]] bool sweep(const ContactMemory* memory, ContactMotion& motion);
  [[nodiscard]] double solve_contact(std::size_t i, const ContactMemory* memory, bool holds);
  void take_forces(Eigen::VectorXd& to) const;
  void set_forces(const Eigen::VectorXd& forces);
  [[nodiscard]] contact::Friction friction(std::size_t i, const ContactMemory& memory) const;
  void change(std::size_t i, int component, double by);
  [[nodiscard]] double component(const std::vector<double>& of, std::size_t i, int k) const;
  void move(ContactMotion& motion);
  void close(ContactTrial& trial, Action& action) const;
  void apply_compliance(const kernels::Array& force, kernels::Array& displacement) const;
  [[nodiscard]] double normal_rate(std::size_t i) const;

  const PackedContacts& contacts_;
  double h_, half_window_;
  Eigen::MatrixXd a_, r_; ///< A = h/2 B B^T, m/(s N), and R, m/N: y, z, x_loc of each contact
  Rate rate_{};           ///< f', 1/s
  Rate half_step_{};      ///< f_k less the f of y, 1
  std::int64_t actions_ = 0;
  bool static_ = false; ///< at the start: springs alone
  std::vector<ActiveContact> active_;
  AndersonMixing mixing_;
  Eigen::VectorXd mixed_, swept_; ///< N: forces of the active contacts before a sweep and after it
  std::vector<double> speed_,
      active_deflection_;    ///< m/s, B (v- + v+)/2, and m, R f, of y, z, x_loc of the active contacts
  kernels::Array modal_u_;   ///< m, lanes: B q
  kernels::Array mean_rate_; ///< m/s, lanes: mean of its rate since the last action
  kernels::Array now_, last_, before_; ///< N, lanes: f_k, f_{k-1}, f_{k-2}
  kernels::Array extrapolated_, deflection_, last_deflection_,
      deflection_before_; ///< extrapolated f_k; R times it and the last two
  kernels::Array own_deflection_, last_own_deflection_,
      own_deflection_before_; ///< m, lanes: n.R n F_N along the normal, extrapolated and of the last two steps
  bool inactive_ = true;      ///< no force in the last two steps
};

} // namespace fretwork::transient
