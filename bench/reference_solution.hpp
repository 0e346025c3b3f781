// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The reference solution of a scene: the modes move exactly (reference_flow.hpp), contacts act by impulses at instants a short fixed step
/// h apart, with w_c h = `resolution`. It shares with the program the geometry of obstacles, the functions of time and the rates that set
/// h; laws (reference_contact.hpp), time integration and statistics are its own.
///
///     instant t_n    velocities v -> v + h B^T f, f by the laws at the displacement q_n and at the mean (v_- + v_+)/2, all closed contacts
///                    together (Gauss-Seidel)
///     t_n to t_n+1   exact flow of the modes
///     all open       one exact flow over 2^k steps, at most 1 rad of the highest mode. It is accepted where every contact has, before and
///                    after, a gap larger than 0.16 times what its node moves at the two speeds: a cubic between the two keeps off 0
/// Order 2. A normal force that begins with a jump (C_N > 0) is met by instants at a random phase: its error has no mean of order 1.
/// `bench_accuracy reference` measures the error by the step itself and its half.
///
/// h is the shortest of resolution/w_c, 5 resolution/r_t, 10 resolution C_T/K_T, 10 resolution/w_max (scene_rates.hpp). Contacts that are
/// farther off than three times what the fastest contact moves until the next broad phase are left out (`missed` counts where that was wrong).
#pragma once
#include "bench/reference_contact.hpp"
#include "bench/reference_flow.hpp"

namespace fretwork::bench {

class ReferenceSolution {
public:
  /// @param scene  with modal damping only; no moving obstacles
  /// @throws core::Error for other scenes
  ReferenceSolution(const transient::Scene& scene, double resolution);

  /// From the initial state to the end of the scene, statistics from a time on, s.
  void run(double from);

  [[nodiscard]] std::vector<ReferenceFigures> figures() const;
  [[nodiscard]] const ReferenceFlow& modes() const { return flow_; } ///< in their sorted order
  [[nodiscard]] double step() const { return h_; }                   ///< s
  /// What a run has cost: exact flows, and forces of contacts found.
  [[nodiscard]] std::int64_t flows() const { return flows_; }
  [[nodiscard]] std::int64_t forces() const { return solved_; }
  /// Instants whose contact forces were not found, and contacts that closed unseen.
  [[nodiscard]] std::int64_t unconverged() const { return unconverged_; }
  [[nodiscard]] std::int64_t missed() const { return missed_; }

private:
  struct Rows { ///< of one contact, along x, y and z, over the modes in their order
    std::vector<double> x, y, z;
    bool in_plane; ///< moves along x_loc
  };
  [[nodiscard]] Local position(std::size_t c, const std::vector<double>& q) const;
  [[nodiscard]] Local velocity(std::size_t c, const std::vector<double>& v) const;
  void add_impulse(std::size_t c, double weight);
  void broad_phase();
  bool macro_step(std::int64_t end);
  void instant(bool in_window, double weight);
  void solve(double weight);

  const transient::Scene& scene_;
  std::size_t count_; ///< of contacts
  double h_;
  ReferenceFlow flow_;
  std::vector<Rows> rows_;
  std::vector<double> coupling_; ///< (h/2) W, 3 x 3 row by row, contact by contact
  std::vector<ReferenceContact> contacts_;
  std::vector<std::int64_t> open_since_; ///< of contacts that are left out: step of their last instant
  std::vector<std::size_t> candidates_, touching_;
  std::vector<double> speed_; ///< m/s, at the last broad phase
  std::vector<Local> speeds_, forces_;
  std::int64_t next_broad_phase_ = 0, broad_phase_every_ = 1, next_macro_step_ = 0; ///< steps
  double length_ = 0.0;                                                             ///< s, of the window
  std::int64_t flows_ = 0, solved_ = 0, unconverged_ = 0, missed_ = 0;
};

} // namespace fretwork::bench
