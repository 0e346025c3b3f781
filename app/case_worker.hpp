// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The process in which a rank has its cases computed: one that crashes, or is killed for want of memory, ends neither the rank nor the sweep.
/// MPI ends all ranks with any of them, so cases are computed outside of it.
///
///     rank -> {"case", "identity", "overrides"} -> process -> row -> rank
///
/// The process computes what cases have in common once and keeps it in memory. Where it ends within a case, the case is tried once more in a
/// new process: what an earlier case of the same process may have left behind is then no part of it. If that one ends too, the outcome of the
/// case is `crashed`. So the outcome depends on the case alone, for any number of ranks and any order.
#pragma once
#include "app/stages.hpp"
#include "core/coprocess.hpp"
#include "sweep/table.hpp"

namespace fretwork::app {

/// What all cases have in common in the table and the report.
struct SweepFacts {
  std::string key; ///< of the study as the process read it: Inputs::whole_key
  std::vector<sweep::Column> columns;
  std::vector<std::pair<std::string, core::Index>> contacts; ///< name and node of each
  std::vector<std::string> warnings; ///< of the study as it stands (warnings_of_case), where asked for
};

class CaseWorker {
public:
  /// Starts the process; it computes what the nominal case needs.
  /// @param request  the study without what varies; its directory has the mesh
  /// @param key      Inputs::whole_key, which a process that is started later must find too
  /// @param with_warnings  the facts are to have them
  /// @param between  called now and then while a case is computed
  /// @throws core::ComputationError where no process can be started
  CaseWorker(Request request, std::string key, bool with_warnings, std::function<void()> between);

  /// Waits for the nominal case.
  /// @throws core::Error, core::ComputationError where it has no result, where its process crashes, where the study has been changed
  [[nodiscard]] const SweepFacts& facts();
  /// The row of a case. @param overrides  `key=value`
  /// @throws what facts() throws, where a process is started again
  [[nodiscard]] sweep::Row operator()(std::int64_t number, const std::string& identity,
                                      const std::vector<std::string>& overrides);

private:
  void start(bool with_warnings);
  Request request_;
  std::string key_;
  std::function<void()> between_;
  std::optional<core::Coprocess> process_;
  std::optional<SweepFacts> facts_; ///< of the process that runs
};

/// What the process does, on its standard input and output, until the rank closes them. Signals that end a sweep are left to the rank.
/// @param with_warnings  of the study as it stands, in the facts
void serve_cases(const Request& request, bool with_warnings);

} // namespace fretwork::app
