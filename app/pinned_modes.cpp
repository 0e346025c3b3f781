// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pinned_modes.hpp"
#include "app/stages.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "modal/slepc_structures.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace fretwork::app {
namespace {

/// @param entry  the name of the contact, whose group of supports it is one of
bool is_pinned(const PinsAsked& asked, const std::string& entry, const PlacedContact& contact) {
  switch (asked.pinned) {
  case study::Pinned::contacts:
    return contact.active;
  case study::Pinned::none:
    return false;
  case study::Pinned::named:
    break;
  }
  return std::any_of(asked.contacts.begin(), asked.contacts.end(),
                     [&](const std::string& name) { return name == entry || name == contact.support; });
}

} // namespace

Pins pins_of(const PinsAsked& asked, const study::Study& study, const fem::Model& model,
             const std::vector<PlacedContact>& contacts, std::vector<std::string>& notes) {
  Pins pins;
  for (const std::string& name : asked.contacts)
    check_index(asked.what + ": pinned", name, study, contacts);
  for (const PlacedContact& contact : contacts) {
    if (!is_pinned(asked, study.contacts[contact.entry].name, contact)) {
      pins.left_out.push_back(contact);
      continue;
    }
    if (can_pin(model, contact)) {
      pins.held.push_back(contact);
      continue;
    }
    const std::string problem = fmt::format(
        "{}: contact \"{}\" is between two nodes that move and pins nothing", asked.what, contact.name);
    if (asked.pinned == study::Pinned::named)
      throw core::Error(problem + "; leave it out of pinned");
    notes.push_back(problem);
  }
  return pins;
}

std::vector<std::string> names_of(const study::Study& study, const Pins& pins) {
  std::vector<std::string> names;
  for (const PlacedContact& pin : pins.held) {
    const bool in_part = std::any_of(pins.left_out.begin(), pins.left_out.end(),
                                     [&](const PlacedContact& other) { return other.entry == pin.entry; });
    const std::string& name = in_part ? pin.support : study.contacts[pin.entry].name;
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

PinnedModes pinned_modes(MPI_Comm comm, const PinsAsked& asked, const TubesInFlow& tubes,
                         const std::vector<PlacedContact>& contacts, std::vector<std::string>& notes) {
  const study::Modes& modes = tubes.study.modes;
  PinnedModes out;
  fem::Model pinned;
  std::vector<fem::Structure> structures;
  core::agree(comm, [&] {
    out.pins = pins_of(asked, tubes.study, tubes.model, contacts, notes);
    pinned = pinned_model(tubes.study, tubes.model, out.pins.held, asked.kind);
    structures = moving_structures(pinned);
  });
  out.bases =
      modal::solve_structures(comm, pinned, structures, {modes.count, modes.up_to_hz}, modes.distributed);
  return out;
}

std::vector<double> closed_frequencies(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                                       const std::vector<PlacedContact>& contacts) {
  constexpr int most = 20;
  constexpr double without_strain = 1e-4; // of the highest: what the rods of the pins leave of a rotation
  fem::Model pinned;
  std::vector<fem::Structure> structures;
  std::vector<PlacedContact> held;
  core::agree(comm, [&] {
    held = that_can_pin(model, contacts);
    pinned = pinned_model(study, model, held, {true, true});
    structures = moving_structures(pinned);
  });
  std::vector<double> out;
  if (held.empty())
    return out;
  for (const modal::Basis& basis :
       modal::solve_structures(comm, pinned, structures, {most, std::nullopt}, study.modes.distributed))
    for (Eigen::Index mode = 0; mode < basis.true_modes(); ++mode)
      out.push_back(basis.omega(mode) / (2.0 * std::numbers::pi));
  std::sort(out.begin(), out.end());
  out.resize(std::min(out.size(), std::size_t{most}));
  for (double& hz : out)
    if (hz < without_strain * out.back())
      hz = 0.0;
  return out;
}

} // namespace fretwork::app
