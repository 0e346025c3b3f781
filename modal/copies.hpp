// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Equal structures, of which one solution serves all: the tubes of a bundle.
///
/// A structure is a copy of another where one translation takes its nodes, in their order, to those of the
/// other, and all else is equal to the last bit: elements, values of their properties, restraints, masses,
/// springs, dampers and ties. Their modes are then the same numbers at the nodes.
#pragma once
#include "fem/model.hpp"
#include <vector>

namespace fretwork::modal {

/// Distance between translated nodes that are still at one place, as a share of the size of the structure.
/// Coordinates written with 12 digits differ so much; frequencies then differ by twice that at most.
inline constexpr double same_place = 1e-11;

/// For each structure the number of the first one that it is a copy of: its own number where there is none
/// before it.
[[nodiscard]] std::vector<std::size_t> originals(const fem::Model& model,
                                                 const std::vector<fem::Structure>& structures);

} // namespace fretwork::modal
