// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Geometry of wear of a support: that of the contact's own obstacle or the named one, with sizes of the study, else of the contact, else of
/// the beam at its node (largest radius, thinnest wall of the beams that meet there).
#pragma once
#include "app/build_contacts.hpp"
#include "results/wear_results.hpp"
#include "wear/depth.hpp"

namespace fretwork::app {

struct WornGeometry {
  wear::Pairing pairing;
  double wall; ///< m, of the tube
};

/// @throws core::Error for a size that nothing gives or that is out of range, and for an obstacle without a geometry of wear
[[nodiscard]] WornGeometry worn_geometry(const study::Wear& entry, const study::Contact& contact,
                                         const PlacedContact& placed, const fem::Model& model);

/// Kind, form and sizes for the results.
void set_geometry(const wear::Pairing& pairing, results::WearOfSupport& facts);

} // namespace fretwork::app
