// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Damping of each mode of a tube from its fluid, its supports and the structure; terms (1) to (5) of damping_terms.hpp.
///
/// Distributed terms (viscous, two-phase) act as local dampers c(s) = 4 pi f m xi(s) per length:
///     xi_i = int xi(s; f_i) m |phi_n|^2 ds / int m |phi_n|^2 ds
/// over the tube, xi(s) = 0 in gas and where there is no fluid. Support terms are means over the supports, each with the
/// fluid of its own zone and its own length: (1) in gas, (3) and (4) in liquid and two-phase flow, none outside all zones.
///
/// Two sets, ratios to critical:
///     stability = all terms, at most 0.05, and at least 0.006 where there is liquid and no gas along the tube: the
///                 correlations were measured on tubes in supports and contain the damping of the structure
///     transient = structure + all terms but those of supports modelled as contacts, which take that energy themselves
/// A mode without frequency (rigid body), or of which less than 1e-6 moves the tube across, is not assessed: it has the damping
/// of the structure alone, none in the set of stability.
#pragma once
#include "flow/damping_terms.hpp"
#include "flow/limit.hpp"
#include "flow/sampling.hpp"

namespace fretwork::flow {

struct TubeSupport {
  double s = 0.0;       ///< m, its middle
  double length = 0.0;  ///< m, L_s along the tube, >= 0
  bool contact = false; ///< modelled as a contact: its terms are left out of the transient set
};

/// The void fraction that h of the two-phase term (5) is taken at: measured against the homogeneous one.
enum class DampingVoidFraction { of_the_zone, homogeneous };

struct DampingOptions {
  double structure = 0.002; ///< ratio, >= 0, only in the transient set
  DampingVoidFraction void_fraction = DampingVoidFraction::of_the_zone;
  std::optional<SpanLayout> layout = std::nullopt; ///< N and l_m; none: span_layout of the supports
};

/// Ratios to critical.
struct DampingTerms {
  double viscous = 0.0, two_phase = 0.0, squeeze_film = 0.0, friction = 0.0, gas = 0.0;

  [[nodiscard]] double of_fluid() const { return viscous + two_phase; }
  [[nodiscard]] double of_supports() const { return squeeze_film + friction + gas; }
  [[nodiscard]] double total() const { return of_fluid() + of_supports(); }
  DampingTerms& operator+=(const DampingTerms& other);
};

struct ModeDamping {
  bool assessed = true;            ///< see above
  std::vector<DampingTerms> zones; ///< what each zone contributes
  DampingTerms sum;                ///< over the zones
  DampingTerms contacts;           ///< the part of `sum` that the transient set leaves out
  double stability = 0.0;          ///< ratio, floor and ceiling applied
  double transient = 0.0;          ///< ratio, structure included
};

struct Damping {
  std::vector<ModeDamping> modes;
  SpanLayout layout;
  Limits limits; ///< those that act, and ranges that are left

  /// One ratio for each mode.
  [[nodiscard]] Eigen::VectorXd stability() const;
  [[nodiscard]] Eigen::VectorXd transient() const;
};

/// @throws core::Error for a support off the tube or of negative length, a negative structural damping, and a layout
///         without spans or length
[[nodiscard]] Damping damping(const Tube& tube, const Profile& profile, const Sampling& sampling,
                              std::span<const TubeSupport> supports, const DampingOptions& options = {});

} // namespace fretwork::flow
