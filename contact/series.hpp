// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The laws of a contact in series with a spring of flexibility R (m/N, >= 0), over the displacement u that both share. The contact takes the share
/// s = 1/(1 + K R) of it:
///     K_s = s K,    C_s = s^2 C,    d_s = s^2 d
/// K_s is exact. Of dampers it is the first order in R w C: a spring and a damper K + i w C have in series K + i w C over 1 + R (K + i w C).
#pragma once
#include "contact/friction_law.hpp"
#include "contact/normal_law.hpp"

namespace fretwork::contact {

[[nodiscard]] inline NormalLaw in_series(const NormalLaw& law, double flexibility) {
  const double share = 1.0 / (1.0 + law.stiffness * flexibility);
  return {share * law.stiffness, share * share * law.damping, share * share * law.dissipation};
}

[[nodiscard]] inline FrictionLaw in_series(FrictionLaw law, double flexibility) {
  const double share = 1.0 / (1.0 + law.stiffness * flexibility);
  law.stiffness *= share;
  law.damping *= share * share;
  return law;
}

} // namespace fretwork::contact
