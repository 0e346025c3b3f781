// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One case of a sweep: the chain from its overrides to its row, without files. Statistics are those of a run of the study with the same
/// overrides, bit for bit; series are not sampled.
#pragma once
#include "app/case_bases.hpp"
#include "study/document.hpp"
#include "sweep/row.hpp"
#include "sweep/table.hpp"

namespace fretwork::app {

/// Runs the cases of a sweep; their outputs are those of case_row.hpp.
class CaseRunner {
public:
  /// Reads the nominal case: the study as it stands. PETSc must be running, here and below.
  /// @param nominal  with `base_overrides`
  /// @throws core::Error where it is refused
  CaseRunner(study::Document document, std::vector<std::string> base_overrides, const Inputs& nominal);

  [[nodiscard]] const std::vector<sweep::Column>& columns() const { return columns_; }
  /// Name and node of each contact, inactive ones included.
  [[nodiscard]] const std::vector<std::pair<std::string, core::Index>>& contacts() const { return contacts_; }
  /// Refuses a case as far as that takes no modes. What it warns of: random loads that follow one signal, where the nominal case's do not.
  /// @throws core::Error
  [[nodiscard]] std::vector<std::string> check(const std::vector<std::string>& overrides);
  /// Modes, flexibility and projections of the nominal case, which most cases share. What it warns of is no longer said of cases.
  /// @param keeps_cases  refuses series that would not fit in memory, before the first case
  /// @throws core::Error, core::ComputationError where it has none
  void compute_nominal(bool keeps_cases);
  /// @throws core::Error, core::ComputationError where the case has no result
  [[nodiscard]] sweep::CaseResult operator()(const std::vector<std::string>& overrides);

private:
  struct Case;
  [[nodiscard]] Case read_case(const std::vector<std::string>& overrides);
  [[nodiscard]] Case with_bases(Case read);
  [[nodiscard]] static std::vector<BuiltScene> scenes_of(const Case& of);
  /// A study that cannot be assessed warns.
  [[nodiscard]] ConnorsStability stability_of(const Case& of);
  [[nodiscard]] static std::vector<std::string> warnings_of(const Case& of,
                                                            const std::vector<BuiltScene>& scenes);

  study::Document document_; ///< with the base overrides, not yet completed
  std::vector<std::string> base_overrides_;
  CaseBases bases_;
  std::vector<sweep::Column> columns_;
  std::vector<std::pair<std::string, core::Index>> contacts_;
  std::vector<std::string> known_; ///< warnings of the nominal case
  std::size_t shared_signals_ = 0; ///< of the nominal case
};

} // namespace fretwork::app
