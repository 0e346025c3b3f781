// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Damping of modes by the flow along the tubes of their structure (flow/damping.hpp).
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_flow.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// What damping and stability of tubes look at.
struct TubesInFlow {
  const study::Study& study;
  const mesh::LineMesh& mesh;
  const fem::Model& model; ///< with the mass of all fluid
  const std::vector<PlacedFlow>& flows;
};

/// m along the tube; none of a node that is not on it.
[[nodiscard]] std::optional<double> abscissa_of(const flow::Tube& tube, core::Index node);

/// The supports of a tube: those that the study lists, else the contacts at its nodes. Of listed supports with a contact
/// in `left_out`, none.
/// @param contacts  modelled, or standing for supports that hold the tube
/// @param left_out  contacts that do nothing: what they support is not there
/// @throws core::Error for a support that is not on the tube
[[nodiscard]] std::vector<flow::TubeSupport> supports_of(const TubesInFlow& tubes, const PlacedFlow& placed,
                                                         const flow::Tube& tube,
                                                         const std::vector<PlacedContact>& contacts,
                                                         const std::vector<PlacedContact>& left_out);

/// Whether modes of the study or its entries of stability are damped by supports of tubes.
[[nodiscard]] bool are_damped_by_supports(const study::Study& study);

/// Notes of tubes whose supports have no length, so that squeeze film and friction damp nothing: contacts without thickness where the flow
/// lists no supports.
[[nodiscard]] std::vector<std::string> supports_without_length(const TubesInFlow& tubes,
                                                               const std::vector<PlacedContact>& contacts);

/// @param bases  of the structures of a model with the nodes of tubes.model
/// @return number of the one that the tube belongs to
/// @throws core::Error where it belongs to none, being held everywhere
[[nodiscard]] std::size_t structure_of(const PlacedFlow& placed, const std::string& name,
                                       const std::vector<modal::Basis>& bases);

/// Damping of one tube in words and numbers. @param what  names it in notes
[[nodiscard]] results::TubeDamping damping_of_tube(const TubesInFlow& tubes, const PlacedFlow& placed,
                                                   const flow::Tube& tube, const flow::Sampling& sampling,
                                                   std::span<const flow::TubeSupport> supports,
                                                   const std::string& what);

/// The two sets of flow/damping.hpp: for linear modes whose supports hold the tube, and beside contacts that take energy themselves.
enum class DampingSet { stability, transient };

/// Gives every mode the ratio of a set; a mode of several tubes the mean of theirs, weighted by the share of
/// it that moves each (flow::transverse_share).
/// @param contacts  those that support the tubes   @param left_out  the others
/// @param bases     of a model with the nodes of tubes.model
/// @return the terms, by tubes
/// @throws core::Error for a structure without a flow
[[nodiscard]] std::vector<results::TubeDamping> damp_by_flow(const TubesInFlow& tubes, DampingSet set,
                                                             const std::vector<PlacedContact>& contacts,
                                                             const std::vector<PlacedContact>& left_out,
                                                             std::vector<modal::Basis>& bases);

} // namespace fretwork::app
