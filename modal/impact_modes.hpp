// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far modes must reach for the forces of impacts on beams to have a given relative error.
///
/// The point receptance of an infinite beam (bending EI, mass m per length) is 1/(2 sqrt(2) EI k^3), k^4 = m w^2/EI; at the end of a
/// half-infinite beam it is four times as much. A contact of stiffness K between beams vibrates where K times the sum of their receptances is 1:
///     w_c^(3/2) = K sum over the beams of y,   y = c / (2 sqrt(2) EI^(1/4) m^(3/4)),   c = 1 along a beam, 4 at its end.
/// Modes above w leave a static flexibility that goes with w^(-3/2), what it leaves of their inertia with w^(-7/2); so does the error a of
/// the largest force. The modes needed reach up to s w_c,
///     s = 7 (0.01/a)^(2/3), or with static modes 3 (0.01/a)^(2/7),
/// and one mode of each span beyond, or else few modes may end far below:
///     sqrt(w) = sqrt(s w_c) + sqrt(w_l),   w_l = (4.730/l)^2 sqrt(EI/m), the lowest of a span of length l clamped at both ends.
/// (In wave numbers, which sqrt(w) is like: modes of a span are pi/l apart.)
///
/// Factors 7 and 3 and exponents: first impacts of pinned spans in their first mode, w_c = 0.05 to 8 w_1, at 0.12 to 0.47 of the span; the error
/// is below a for a = 0.1, 0.03, 0.01 and 0.003 (doc/theory.md, section 5).
/// Limits: contacts across slender beams; without shear, axial force and lumped masses.
#pragma once

namespace fretwork::modal {

/// Where on a beam the contact is: within it, or at its end.
enum class BeamPoint { interior, end };

/// y, s^(3/2) per N/m.
/// @param bending  N m2, > 0: the smaller of both planes errs on the safe side; @param mass  kg/m, > 0
[[nodiscard]] double point_receptance(double bending, double mass, BeamPoint point);

/// w_c, rad/s.
/// @param stiffness  N/m, > 0; @param receptance  sum over the beams of the contact, > 0
[[nodiscard]] double contact_frequency(double stiffness, double receptance);

/// w_l, rad/s.
/// @param length  m, > 0
[[nodiscard]] double clamped_span_frequency(double length, double bending, double mass);

/// s, of contact frequencies.
/// @param error  a, relative, > 0 and at most 0.1; @param static_modes  whether these have the flexibility of the modes left out
[[nodiscard]] double contact_frequencies_needed(double error, bool static_modes);

/// w, rad/s.
[[nodiscard]] double modes_needed_up_to(double contact_frequency, double span_frequency, double error,
                                        bool static_modes);

} // namespace fretwork::modal
