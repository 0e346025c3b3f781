// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A direction D for the mean normal force of a step that takes a node from x0 to x1, such that
///     D.(x1 - x0) = gap(x1) - gap(x0)
/// to round-off, however long the step: a force along D does exactly the work that the gap tells. D tends to the normal with order 2.
///     circle, round pair   D = -+ (x0 + x1)/(r0 + r1)
///     plane pair           the same along its axis: -(c0 + c1)/(|c0| + |c1|) e, which is the normal on either side
///     stop, facing planes  D = n
///     any other            D = b + (gap1 - gap0 - b.d) d/|d|^2 with d = x1 - x0 and b = (n0 + n1)/2; on one facet of a profile D = n
/// The identity holds with any b: where a step ends near a place where n1 jumps (two parts of the profile are equally near), b may be
/// held so that D is continuous in x1.
/// |D| <= 1, by the last form <= sqrt(2): it falls short of 1 where the normal turns in the step.
/// Source: O. Gonzalez, J. Nonlinear Sci. 6 (1996) 449, eq. 3.1, with the mean of the ends in place of the middle.
#pragma once
#include "contact/obstacle.hpp"

namespace fretwork::transient {

struct DiscreteGradient {
  double gap;    ///< m, at x1
  double ny, nz; ///< gradient of the gap at x1
  double y, z;   ///< D
  double yy, yz, zy,
      zz; ///< 1/m: derivatives of D by x1, the second letter that of x1; one-sided where the normal jumps
};

/// @param from  where the node is at x0   @param held  b where it is held, otherwise null
[[nodiscard]] DiscreteGradient discrete_gradient(const contact::Obstacle& obstacle, contact::PlanePoint x0,
                                                 const contact::Location& from, contact::PlanePoint x1,
                                                 const contact::PlanePoint* held = nullptr);

} // namespace fretwork::transient
