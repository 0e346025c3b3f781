// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The local axes of a contact: those that the study gives, else along the beams at its node.
#pragma once
#include "contact/frame.hpp"
#include "fem/model.hpp"
#include "study/study.hpp"
#include <string>

namespace fretwork::app {

[[nodiscard]] bool has_beam(const fem::Model& model, core::Index node);

/// What is missing at a node that no beam meets: most often lines that gmsh has left out of the mesh.
[[nodiscard]] std::string without_beam(const fem::Model& model, core::Index node);

/// @param name  what messages call the contact
/// @throws core::Error without an axis where no beam or more than two meet, or they turn back; for a y_axis along the axis
[[nodiscard]] contact::Frame frame_of(const study::Contact& contact, const fem::Model& model,
                                      core::Index node, const std::string& name);

/// A given axis far from the beam, about which an obstacle that surrounds the tube is round; empty where it is along it, and of flat
/// obstacles, which may stop a beam at its end.
[[nodiscard]] std::string axis_warning(const study::Contact& contact, const fem::Model& model,
                                       core::Index node, const std::string& name);

} // namespace fretwork::app
