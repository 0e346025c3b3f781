// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The scenes of a study: what its modes make of contacts and loads, for every structure, or structures that meet, that can move.
#pragma once
#include "app/build_fields.hpp"
#include "app/build_scene.hpp"
#include "app/contact_flexibility.hpp"
#include "app/turbulent_loads.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// What scenes are built from besides the modes.
struct AtContacts {
  Fields fields;
  std::vector<TurbulentLoad> turbulence;
  std::vector<std::vector<std::size_t>> joined;  ///< structures of each scene
  std::vector<ContactFlexibility> flexibilities; ///< of each scene
};

/// The scenes; the facts of contacts, warnings and notes go to `out`.
/// @throws core::Error where an observed node belongs to nothing that moves
[[nodiscard]] std::vector<BuiltScene> build_scenes(const study::Study& study,
                                                   const std::vector<modal::Basis>& bases,
                                                   const std::vector<PlacedContact>& placed,
                                                   const std::vector<NamedNode>& nodes,
                                                   const AtContacts& at_contacts, results::RunResults& out);

} // namespace fretwork::app
