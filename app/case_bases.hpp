// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the cases of a sweep have in common, computed once and kept in memory: mesh, model, fields, modes, flexibility at the contacts,
/// projections of turbulence. Computed on one process, without other ranks: the same bytes for any number of them.
///
/// What depends on what:
///     structure   every key but those of contacts, of the transient and its output, of wear, the time functions of loads, seeds of turbulence
///     modes       the structure; with modes.accuracy their limit, which follows from the contacts
///     stability   the structure; of each contact what a pin takes of it, whether it is active, its stiffnesses; [[stability]] itself
///     contacts    the modes; of each contact its node, its axes, the directions in which it acts, whether it has friction, its thickness
/// Gaps, offsets, stiffnesses, dampers and coefficients of friction enter a case after that.
#pragma once
#include "app/build_scene.hpp"
#include "app/stability.hpp"
#include "app/stages.hpp"
#include <list>
#include <memory>

namespace fretwork::app {

struct CaseStructure {
  mesh::LineMesh mesh;
  fem::Model dry, model; ///< without and with the fluid of [[flow]]
  std::vector<PlacedFlow> flows;
  std::vector<TurbulentLoad> turbulence;
  std::vector<fem::Structure> structures;
  Fields fields; ///< time functions of loads are those of the case that was first
};

struct CaseContacts {
  std::vector<modal::Basis> bases; ///< damped
  std::vector<FluidForces> fluid;
  std::vector<std::vector<std::size_t>> joined;
  std::vector<ContactFlexibility> flexibilities;
  std::vector<std::vector<std::optional<signals::SampledLoad>>> turbulence; ///< by scenes and entries
};

/// The last few things that were made, by key.
template <class T> class Recent {
public:
  template <class Make> std::shared_ptr<const T> get(const std::string& key, const Make& make) {
    for (auto at = entries_.begin(); at != entries_.end(); ++at)
      if (at->first == key) {
        entries_.splice(entries_.begin(), entries_, at);
        return at->second;
      }
    entries_.emplace_front(key, std::make_shared<const T>(make()));
    if (entries_.size() > most)
      entries_.pop_back();
    return entries_.front().second;
  }

private:
  static constexpr std::size_t most = 8;
  std::list<std::pair<std::string, std::shared_ptr<const T>>> entries_;
};

/// Of one process. PETSc must be running.
class CaseBases {
public:
  /// @param nominal  the study of all cases, its mesh made
  explicit CaseBases(const Inputs& nominal) : nominal_(nominal) {}

  /// @param overrides  of the case
  [[nodiscard]] std::shared_ptr<const CaseStructure> structure(const study::Study& study,
                                                               const std::vector<std::string>& overrides);
  /// @param study  of the case; with modes.accuracy its limit is set
  [[nodiscard]] std::shared_ptr<const CaseContacts>
  contacts(study::Study& study, const std::vector<std::string>& overrides, const CaseStructure& structure,
           const std::vector<PlacedContact>& placed, const std::vector<PlacedContact>& inactive);

  /// The [[stability]] entries, by Connors.
  /// @throws core::Error where one cannot be assessed
  /// @param all  contacts, inactive ones included
  [[nodiscard]] std::shared_ptr<const ConnorsStability> stability(const study::Study& study,
                                                                  const std::vector<std::string>& overrides,
                                                                  const CaseStructure& structure,
                                                                  const std::vector<PlacedContact>& all);

private:
  const Inputs& nominal_;
  Recent<CaseStructure> structures_;
  Recent<std::vector<modal::Basis>> modes_;
  Recent<CaseContacts> contacts_;
  Recent<ConnorsStability> stabilities_;
};

} // namespace fretwork::app
