// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Archard's coefficients K of tubes, by the pair of materials tube_support and the class of geometry.
///
/// Alloys 600 and 690 (TT: thermally treated); steels Z10C13, Z6C13, 405, 347, 304; Cr: chromium plated.
/// Values for one pair differ by decades with the geometry and the source: a study names its own, no value is a
/// default. Design practice is K = 10e-15 to 40e-15 m2/N (M. J. Pettigrew and C. E. Taylor, J. Fluids Struct. 18
/// (2003) 485, part 2; not compared with the paper).
/// Sources: in each row.
#pragma once
#include "wear/depth.hpp"
#include <span>
#include <string_view>

namespace fretwork::wear {

struct Coefficient {
  std::string_view
      geometry; ///< class: "flat_bar", "drilled_hole", "four_lands", "three_lands", "tube_on_tube", "any"
  std::string_view materials; ///< tube_support: "690_405"
  double value;               ///< K of the tube, m2/N
  std::string_view source;
};

[[nodiscard]] std::span<const Coefficient> coefficients();

/// The row of a class and a pair.
/// @throws core::Error naming the classes there are, or the pairs of the class and the classes that have the pair
[[nodiscard]] const Coefficient& coefficient(std::string_view geometry, std::string_view materials);

/// Class of a geometry: a ring has that of the drilled hole, lands by their number.
/// @throws core::Error for lands that are neither 3 nor 4, and for sectors, which do not know their hole
[[nodiscard]] std::string_view coefficient_class(const Geometry& geometry);

} // namespace fretwork::wear
