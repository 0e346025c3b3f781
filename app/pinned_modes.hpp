// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Modes of the tubes pinned at supports (pinned_model.hpp), which an assessment of linear modes is made on.
#pragma once
#include "app/flow_damping.hpp"
#include "app/pinned_model.hpp"
#include <mpi.h>

namespace fretwork::app {

/// What an assessment pins.
struct PinsAsked {
  std::string what; ///< for messages: `stability "both plates"`
  study::Pinned pinned = study::Pinned::contacts;
  std::vector<std::string> contacts = {}; ///< of Pinned::named
  PinKind kind = {};
};

struct Pins {
  std::vector<PlacedContact> held;     ///< at which the tubes are pinned
  std::vector<PlacedContact> left_out; ///< the others
};

/// @param contacts  all of the study, inactive ones included
/// @param notes     takes contacts between two moving nodes, which pin nothing
/// @throws core::Error where a contact that the study names cannot pin
[[nodiscard]] Pins pins_of(const PinsAsked& asked, const study::Study& study, const fem::Model& model,
                           const std::vector<PlacedContact>& contacts, std::vector<std::string>& notes);

/// Names of the `[[contacts]]` that are held, each once; where some nodes of a group are left out those of the supports that are held.
[[nodiscard]] std::vector<std::string> names_of(const study::Study& study, const Pins& pins);

struct PinnedModes {
  Pins pins;
  std::vector<modal::Basis> bases; ///< by structures of the pinned model, without damping
};

/// Collective. As many modes as `[modes]` asks for.
[[nodiscard]] PinnedModes pinned_modes(MPI_Comm comm, const PinsAsked& asked, const TubesInFlow& tubes,
                                       const std::vector<PlacedContact>& contacts,
                                       std::vector<std::string>& notes);

/// Collective. Hz, the lowest of all structures, ascending: with the contacts on fixed obstacles closed, as springs of K_N and, with friction, K_T; empty where none
/// of them can pin.
[[nodiscard]] std::vector<double> closed_frequencies(MPI_Comm comm, const study::Study& study,
                                                     const fem::Model& model,
                                                     const std::vector<PlacedContact>& contacts);

} // namespace fretwork::app
