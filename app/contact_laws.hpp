// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The laws of a contact, where they depend on how the modes move it.
///
/// With b the rows (x_loc, y_loc, z_loc) by which modes of unit mass move the contact, W = b b^T is its
/// mobility, 1/(n.W n) the mass it feels along n. A contact met in several directions takes their mean
/// mobility. The mass shrinks as modes are added: it is that of an impact which all of them follow. Static modes are not among them:
/// laws do not change with what stands in for the modes that are left out.
///
/// A support with a thickness has several contacts. Each gets its share of the stiffnesses and dampers of the
/// whole support, which are found as if one contact had them all.
#pragma once
#include "app/build_contacts.hpp"
#include "transient/scene/scene.hpp"

namespace fretwork::app {

/// Mass felt across an obstacle, kg.
/// @throws core::Error naming the contact where no mode moves it there
[[nodiscard]] double normal_mass(const contact::Obstacle& obstacle, const Eigen::MatrixXd& b,
                                 const std::string& name);

/// @throws core::Error where no mode moves the contact as a value to be found needs it
[[nodiscard]] contact::Support support_of(const study::Contact& contact, const PlacedContact& placed,
                                          const vibration::System& system, const Eigen::MatrixXd& b);

} // namespace fretwork::app
