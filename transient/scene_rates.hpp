// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How fast a scene moves: what the steps of schemes have to resolve.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

/// Each 0 where there is no such thing.
struct SceneRates {
  /// w_c, rad/s, of all contacts closed: w_c^2 = largest eigenvalue of K_N^1/2 W K_N^1/2, W = B B^T over the normal directions of all
  /// contacts.
  double contact_frequency = 0.0;
  double stick_frequency =
      0.0; ///< w_t, rad/s, the same with K_T over the tangent directions in which friction acts
  /// w_s, rad/s, of the structure where the fastest contacts touch it: the rms of the frequencies of the modes by their shares of a contact's mobility along
  /// one direction, the largest of contacts that by themselves, closed or sticking, have half of the largest frequency of one.
  double structure_frequency = 0.0;
  double damper_rate =
      0.0; ///< r_t, 1/s, the largest eigenvalue of C_T^1/2 W C_T^1/2 over the same directions
  double normal_damper_rate =
      0.0; ///< r_n, 1/s, the largest eigenvalue of C_N^1/2 W C_N^1/2 over the normal directions; not of Hunt and
           ///< Crossley's dampers
  bool hunt_crossley =
      false; ///< there are dampers of theirs, whose rate grows with penetrations that no one knows before the run
  double highest_mode = 0.0; ///< rad/s
  double excitation = 0.0;   ///< Hz, the highest of the loads that act on the scene
  double sampled_excitation =
      0.0; ///< Hz, likewise of sampled forces, which are lines in every scheme (vibration/load_sum.hpp), and of integrals
  double table_interval =
      0.0; ///< s, the shortest between points of their tables, but those too close to rule a step; not of records
  double record_rate = 0.0;     ///< rad/s, how fast the fastest of their records changes (signals/record.hpp)
  double record_interval = 0.0; ///< s, the shortest mean interval of their records
};
[[nodiscard]] SceneRates rates_of(const Scene& scene);

/// 1/s: the largest rate of the structure's own damping, and of the normal dampers (c(p) at t = 0 in place of C_T).
[[nodiscard]] double explicit_damper_rate(const Scene& scene);

/// 1/s: the largest at which springs of sliding contacts follow their bound, K_T/C_T.
[[nodiscard]] double relaxation_rate(const Scene& scene);

} // namespace fretwork::transient
