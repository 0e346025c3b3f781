// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The model with its tubes pinned at supports: the linear modes that stability is judged by, where the tube of the
/// transient hangs in its clearances.
///
/// A pin holds its node along the directions in which the obstacle of the contact can press: y_loc or z_loc of planes, stops
/// and bars, both of all others; where it sticks, along those too in which the friction of the contact acts. Rotations stay free. The pin is a
/// massless rod of 1 m along the direction to a fixed point, with pin_stiffness times the largest translational stiffness of the beams at
/// the node: the node moves by some 1e-6 of what a span bends. An elastic pin has the normal or tangential stiffness of the contact.
#pragma once
#include "app/build_contacts.hpp"
#include "modal/basis.hpp"

namespace fretwork::app {

inline constexpr double pin_stiffness = 1e3; ///< times that of the beams at the node

struct PinKind {
  bool elastic = false;  ///< as stiff as the contact
  bool sticking = false; ///< also where friction acts
};

/// Contacts between two nodes pin where the other is restrained in all translations.
[[nodiscard]] bool can_pin(const fem::Model& model, const PlacedContact& contact);

/// @param pins  contacts, each of which can pin
/// @return the model with the nodes of the old one first, under their numbers
[[nodiscard]] fem::Model pinned_model(const study::Study& study, const fem::Model& model,
                                      const std::vector<PlacedContact>& pins, const PinKind& kind);

/// Those of some contacts that can pin, at nodes that carry a beam.
[[nodiscard]] std::vector<PlacedContact> that_can_pin(const fem::Model& model,
                                                      const std::vector<PlacedContact>& contacts);

/// omega^2 of the first `modes` modes of a structure without pins and the stiffness of the pins at its nodes, 1/s2, in modal coordinates:
///     omega^2 + sum over pins k b b^T,   b = phi^T n at the node
/// @param model, pinned  without and with pins
[[nodiscard]] Eigen::MatrixXd stiffness_with_pins(const modal::Basis& basis, Eigen::Index modes,
                                                  const fem::Model& model, const fem::Model& pinned);

} // namespace fretwork::app
