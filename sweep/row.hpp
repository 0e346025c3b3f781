// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A row of the table of a sweep: what one case gave. A row is one line of text
///
///     checksum case identity outcome value value ... | message
///
/// with the first 16 digits of the SHA-256 of all that follows the checksum. Numbers read back bit for bit.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fretwork::sweep {

enum class Outcome {
  done,
  refused, ///< the inputs of the case are wrong: a gap below 0, for example
  failed,  ///< the computation gave no result: divergence, no convergence
  defect,  ///< of the program
  crashed  ///< its process ended in the case: a signal, no memory
};
[[nodiscard]] std::string name_of(Outcome outcome);

struct Row {
  static constexpr const char* between = " | "; ///< of warnings in a message
  std::int64_t number = 0;                      ///< of the case, from 0
  std::string identity;                         ///< digest of all that the case was computed from
  Outcome outcome = Outcome::done;
  std::vector<double> values = {}; ///< by columns; empty unless done
  std::string message = {};        ///< why it is not done; of a done one its warnings
};

/// What a case gives that has a result.
struct CaseResult {
  std::vector<double> values; ///< by columns
  std::vector<std::string> warnings = {};
};

/// Digits of checksums and identities.
inline constexpr std::size_t digest_digits = 16;

/// The first digits of the SHA-256 of a text.
[[nodiscard]] std::string short_digest(std::string_view text);

/// With its end of line.
[[nodiscard]] std::string line_of(const Row& row);

/// None where the line is not as line_of wrote it. @param line  without its end
[[nodiscard]] std::optional<Row> row_of(std::string_view line);

} // namespace fretwork::sweep
