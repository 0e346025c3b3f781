// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Obstacles that move by themselves while the modes are counted from the base: a contact's node moves by
///     u = b q + carried s(t),    u' = b q' + carried s'(t)
/// from its obstacle, in the contact's local axes. An obstacle that stays in space while the base moves by s along d has
/// carried = d. What it does on the structure is work from outside: each second, with the force f on the node, -f.(carried s').
///
/// With residual flexibility (Scene) loads move the contacts beside the modes, u = ... + under_loads g(t), at once: without inertia. Their
/// velocity is the difference of g over the step about the instant, which stays finite where a table jumps and adds up to what g does.
#pragma once
#include "transient/contact_motion.hpp"
#include "transient/contact_trial.hpp"
#include "transient/prescribed_motion.hpp"

namespace fretwork::transient {

class ObstacleMotion {
public:
  /// @param contacts  those of the scene, must live longer   @param step  s
  ObstacleMotion(const Scene& scene, const PackedContacts& contacts, double step);
  /// Adds what carries the contacts at a time to the displacements and velocities that `gather` has made of the modes. No allocation.
  void add(double time, ContactMotion& motion);
  /// f.(carried s') over all contacts at the time of the last `add`, W.
  [[nodiscard]] double power(const ContactTrial& trial) const;

private:
  [[nodiscard]] bool still() const { return signals_.empty() && loads_.empty(); }

  const PackedContacts& contacts_;
  double h_;
  std::vector<MotionSignal> signals_;
  std::vector<Signal> loads_;
  kernels::Array carried_;  ///< lanes of each motion, one after the other; then under_loads of each load
  kernels::Array velocity_; ///< carried s', in lanes
};

} // namespace fretwork::transient
