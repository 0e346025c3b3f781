// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Normal forces and paths of the tests of friction over an interval.
#pragma once
#include "contact/friction_interval.hpp"

namespace fretwork::tests {

/// A spring without damper.
inline const contact::FrictionLaw law{2.0, 0.0, 0.5, 0.5};

/// A normal force that is linear in time.
inline contact::ParabolicForce line(double first, double last) { return {first, last, 0.5 * (first + last)}; }

/// A path that its force does not change.
template <class V, class M> contact::TangentialPath<V, M> driven(V velocity) {
  return {velocity, {}, {}, {}};
}

} // namespace fretwork::tests
