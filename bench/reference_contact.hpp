// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The laws of doc/contact.md at the instants of contact impulses, for the reference solution (reference_solution.hpp). They are written
/// anew: nothing of the program's laws or step forms is used but the geometry (contact::locate).
///
///     normal     F_N = <K_N p + c(p) p'>+ for p >= 0,  c(p) = C_N + K_N d p
///     friction   trial = T - C_T v;  |trial| <= (sliding ? mu_d : mu_s) F_N: F = trial, else F = mu_d F_N trial/|trial|
///                T' = -(K_T/C_T)(T - F) in stick, in slip and (F = 0) open; in stick that is T' = -K_T v
/// From one instant to the next, h later, F is linear in the equation of T, which then is solved exactly,
///     T_1 = e T_0 + b_0 F_0 + b_1 F_1,  A = K_T h/C_T, e = exp(-A), b_1 = 1 - (1 - e)/A, b_0 = (1 - e)/A - e,
/// in stick from instant to instant T_1 = T_0 - K_T dx. C_T = 0 is the limit: T = F, T_1 = T_0 - K_T dx returned radially to the bound,
/// and the slider moves by (T_1 - (T_0 - K_T dx))/K_T.
#pragma once
#include "contact/support.hpp"
#include <cstdint>

namespace fretwork::bench {

/// Statistics of one contact over the window, defined as post::ContactSummary.
struct ReferenceFigures {
  double work_rate = 0.0, friction_power = 0.0;                 ///< W
  double tangential_rate = 0.0;                                 ///< W: mean of F_N |v_T|, sliding or not
  double normal_mean = 0.0, normal_rms = 0.0, normal_max = 0.0; ///< N, over all time
  double contact_time_ratio = 0.0, sliding_time_ratio = 0.0;    ///< of all time
  double impact_rate = 0.0;                                     ///< 1/s
  std::int64_t impacts = 0;
};

/// A vector in local axes x_loc, y_loc, z_loc.
struct Local {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// (h/2) W of a contact with itself: velocity by force, local axes, row by row.
using Response = double[9];

class ReferenceContact {
public:
  /// @param step  s, between instants
  ReferenceContact(const contact::Support& support, double step);

  /// Where the node is at an instant, m, local axes from the obstacle's centre. Returns whether p >= 0.
  bool place(Local position);
  /// Before the forces of an instant are found, with the velocity before them, m/s.
  void start(Local velocity);
  /// Forces that agree with a mean velocity over the impulse, `free` being that without this contact's own force. Returns the force.
  Local force(Local free, const Response& response);
  /// Ends the instant: commits the memory and adds to the sums of the window.
  void commit(bool in_window, double weight);
  /// The contact is open at the instant, and was so for `steps` steps of which it was the end.
  void leave_open(std::int64_t steps);

  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] double gap() const { return gap_; }
  /// Of a window of a length, s.
  [[nodiscard]] ReferenceFigures figures(double length) const;

private:
  struct Friction {
    contact::Vec2 force, spring;
    bool slides;
  };
  [[nodiscard]] contact::Vec2 tangential(Local v, double ny, double nz) const;
  /// @param slid  before, or from the touch on
  [[nodiscard]] Friction friction(double normal, contact::Vec2 free, const contact::Sym2& response,
                                  bool slid) const;
  void add(double weight);
  [[nodiscard]] double slip_began() const;

  contact::Support support_;
  double h_, relaxation_ = 0.0, by_first_ = 1.0, by_last_ = 0.0; ///< e, b_0, b_1
  // memory: of the last instant
  contact::Vec2 spring_, force_; ///< T, F, N
  double normal_before_ = 0.0;   ///< N, at the last instant
  bool counted_ = false;         ///< its last instant lay in the window
  bool closed_ = false, slides_ = false;
  double ny_ = 0.0, nz_ = 0.0, gap_ = 0.0; ///< normal where it was closed last
  Local position_;
  // the instant under way
  Local now_, friction_part_;
  double ny_now_ = 0.0, nz_now_ = 0.0, gap_now_ = 0.0, normal_ = 0.0;
  contact::Vec2 loaded_, velocity_; ///< T_0 - K_T dx; mean tangential velocity
  Friction friction_{};
  // sums over the window
  double work_ = 0.0, slider_ = 0.0, tangential_power_ = 0.0, impulse_ = 0.0, squares_ = 0.0, largest_ = 0.0,
         time_ = 0.0, sliding_ = 0.0;
  std::int64_t impacts_ = 0;
};

} // namespace fretwork::bench
