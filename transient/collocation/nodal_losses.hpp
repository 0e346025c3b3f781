// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a contact loses at the nodes 0, 1/2, 1 of a step of collocation:
///     normal damper (F_N - K_N p+) p',   slider -F.(v - w),   tangential damper -F.v + T.w less the slider's,   w = -T'/K_T
/// T' of the quadratic through T at the nodes, so that the sum of T.w by Simpson's rule is exactly the spring's energy.
#pragma once
#include "transient/collocation/inner_path.hpp"

namespace fretwork::transient {

/// W; or J, over a step.
struct Power {
  double slider = 0.0, damper = 0.0;
};

/// At node j.   @param nodes  the three nodes   @param h  s, the step
[[nodiscard]] Power power_of(const contact::Support& support, const ContactNode* nodes, int j, double h);

/// Of a contact with an inner path: powers that give its losses by Simpson's rule, in those nodes alone that records show (closed). The ends
/// keep those of the laws and the middle has the rest; where that would be negative the ends have less.
/// @param loss  J, up to the nodes 1/2 and 1   @param powers  at the three nodes, of the laws; changed
void spread(const PathLoss* loss, const ContactNode* nodes, double h, Power* powers);

} // namespace fretwork::transient
