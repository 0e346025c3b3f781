// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `[[turbulence]]` of a study: zones of the flow cut into patches, whatever the modes, and the modal forces that a basis makes of them.
///
/// Forces are the same for any basis, number of ranks and duration: band, period of blocks and patches follow from the flow alone
/// (flow/load_band.hpp; patches a fifth of the correlation length wide), random numbers from the seed and the names of tube and zone.
#pragma once
#include "app/build_flow.hpp"
#include "flow/load_band.hpp"
#include "modal/basis.hpp"
#include "signals/sampled_load.hpp"

namespace fretwork::app {

/// A zone of a tube under turbulence.
struct PatchedZone {
  flow::TurbulentZone zone; ///< its axes (drag, lift) with weights, their shapes of no meaning
  flow::Tube tube;
  core::Index start = -1;   ///< node of the model at s = 0
  Eigen::Matrix3Xd axes[2]; ///< e_D and e_L at the patches
  std::string flow;         ///< name
};

/// An entry of `[[turbulence]]` on all its tubes.
struct TurbulentLoad {
  std::string name; ///< for messages: `turbulence "inlet"`
  std::vector<PatchedZone> zones;
  flow::LoadBand band;
  flow::DrawOptions draw;
  double ramp = 0.0; ///< s
};

/// @param flows  of the study, placed
/// @param notes  takes the band of each entry and what is lost outside
/// @throws core::Error for names that do not exist, a zone of two entries, zones without velocity or direction, spectra that do not fit their fluid
[[nodiscard]] std::vector<TurbulentLoad> turbulent_loads(const study::Study& study, const fem::Model& model,
                                                         const std::vector<PlacedFlow>& flows,
                                                         std::vector<std::string>& notes);

/// Warnings of single-phase spectra in two-phase zones, by entries.
[[nodiscard]] std::vector<std::string> spectra_of_one_phase(const study::Study& study,
                                                            const std::vector<TurbulentLoad>& loads);

/// How many true modes of a basis lie above the band of a load, on which it does not act.
[[nodiscard]] Eigen::Index modes_above(const flow::LoadBand& band, const modal::Basis& basis);

/// The zones of a load with the shapes of a scene, structure after structure; those of other structures are left out.
/// @param bases  of the structures of the scene
[[nodiscard]] std::vector<flow::TurbulentZone> zones_on(const TurbulentLoad& load,
                                                        const std::vector<const modal::Basis*>& bases);

/// The modal forces of a draw for a scene; none where the load acts on no structure of it.
/// @param notes  takes shapes that the patches do not resolve
/// @throws core::Error where the draw would take too much memory
[[nodiscard]] std::optional<signals::SampledLoad> sampled_load(const TurbulentLoad& load,
                                                               const std::vector<const modal::Basis*>& bases,
                                                               std::vector<std::string>& notes);

/// The modal forces of all loads that act on a scene.
/// @param all, structures  bases, and the numbers of those of the scene
[[nodiscard]] std::vector<signals::SampledLoad> sampled_loads(const std::vector<TurbulentLoad>& loads,
                                                              const std::vector<modal::Basis>& all,
                                                              const std::vector<std::size_t>& structures,
                                                              std::vector<std::string>& notes);

/// The same forces with the random numbers of another seed; nothing is projected again.
/// @param load  of sampled_load
[[nodiscard]] signals::SampledLoad with_seed(signals::SampledLoad load, std::uint32_t seed);

} // namespace fretwork::app
