// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Operating states of wear whose work rates come from other runs.
///
/// A state with `results` is the run in that folder. In the run that writes that folder the state is this run, and a state with neither
/// `results` nor `work_rate` is then another one, whose work rates are not known there. So one study makes the runs of all its states.
#pragma once
#include "app/worn_places.hpp"
#include "contact/sides.hpp"
#include "results/run_results.hpp"
#include <map>

namespace fretwork::app {

/// A work rate as a run states it.
struct StatedRate {
  double value, error; ///< W, mean and its standard error, not a number: none
  double batches;      ///< effective number behind the error
  /// @param confidence  of the interval; none: +- the standard error
  [[nodiscard]] wear::WorkRate with(std::optional<double> confidence) const;
};

/// Of a contact.
struct ContactRates {
  StatedRate total;
  std::array<std::optional<StatedRate>, contact::most_sides> sides; ///< of obstacles that have several
  /// @param side  nothing: the total
  [[nodiscard]] const StatedRate& at(std::optional<std::size_t> side) const {
    return side ? sides[*side].value() : total;
  }
};

struct OtherRuns {
  /// Work rates by name of a contact, of each state of each entry; nothing for states that are no other run,
  /// and in a run that is a state itself.
  std::vector<std::vector<std::optional<std::map<std::string, ContactRates>>>> rates;
  std::string missing; ///< why wear cannot be computed: runs that have not been made; empty: it can
  std::string
      is_state_of; ///< the entry of which this run is a state for another run, which computes the wear; empty: none
  [[nodiscard]] bool complete() const { return missing.empty() && is_state_of.empty(); }
};

/// @param folder  of the results of this run
/// @throws core::Error for a folder without results of a transient, and a run that diverged
[[nodiscard]] OtherRuns read_other_runs(const study::Study& study, const std::filesystem::path& folder);

/// @throws core::Error for a contact that wears and that another run does not have, or not by side
void check_contacts_of(const OtherRuns& others, const study::Study& study,
                       const std::vector<WornPlace>& places, const std::vector<PlacedContact>& placed);

/// The contacts that wear against those of the other runs, which have them all.
/// @return a warning for each run that has another gap, stiffness or friction at one of them: the first difference
/// @throws core::Error for one at another place, with another obstacle or on another tube (section and material)
[[nodiscard]] std::vector<std::string> compare_with_other_runs(const OtherRuns& others,
                                                               const study::Study& study,
                                                               const std::vector<WornPlace>& places,
                                                               const std::vector<PlacedContact>& placed,
                                                               const fem::Model& model);

/// Why no wear is computed: a warning, or a note where another run computes it.
void note_other_runs(const OtherRuns& others, results::RunResults& out);

/// All work rates, for the key of a run that depends on them.
[[nodiscard]] std::string text_of(const OtherRuns& others);

} // namespace fretwork::app
