// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Values of contacts and output that are legal and hardly meant: each a warning or note that asks.
#pragma once
#include "app/build_contacts.hpp"

namespace fretwork::app {

/// Warnings, one an entry: a thickness that reaches the next support along the tube, and a tangential stiffness of more than ten times the
/// normal one where there is friction.
[[nodiscard]] std::vector<std::string> contact_questions(const study::Study& study, const fem::Model& model,
                                                         const std::vector<PlacedContact>& placed);

/// A note where `output.every` leaves fewer than 20 outputs of a run; else empty.
[[nodiscard]] std::string few_outputs(const study::Study& study);

} // namespace fretwork::app
