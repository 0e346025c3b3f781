// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `[sweep]` of a study: what varies between the cases of a sweep, and what is to be said of them (doc/sweep.md).
#pragma once
#include "study/document.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fretwork::study {

/// Values that are listed: of a grid one after the other, of a random design each with its probability.
struct SweepLevels {
  std::vector<std::string> values;   ///< as TOML text
  std::vector<double> probabilities; ///< sum 1
};

/// A distribution of a number.
struct SweepDistribution {
  /// uniform {from, to}, normal {mean, deviation}, lognormal {mean, deviation}, triangular {from, mode, to}, weibull {scale, shape,
  /// from}, integers {from, to}, measured {values ...}
  std::string law;
  std::vector<double> parameters;
  std::optional<std::array<double, 2>> truncated; ///< between these
};

/// Case i has the seed first + i, the k-th key of the pattern k * seeds_apart more, so that its loads are independent. It is no variable of the design:
/// what it changes is scatter.
struct SweepSeeds {
  std::int64_t first = 1;
};
inline constexpr std::int64_t seeds_apart = 1'000'000;

struct SweepVariable {
  std::string name;              ///< column of the table
  std::vector<std::string> keys; ///< addresses as of --set, all given the same value, of seeds one each
  std::variant<SweepLevels, SweepDistribution, SweepSeeds> source;
};

enum class SweepDesign { grid, monte_carlo, latin_hypercube, sobol, saltelli };
[[nodiscard]] std::string name_of(SweepDesign design);

/// Rank correlation (Spearman) of two variables, by a normal copula.
struct SweepCorrelation {
  std::size_t first, second; ///< numbers of variables
  double value;              ///< -1 < value < 1
};

/// A probability that is asked for.
struct SweepLimit {
  std::string output;
  double value = 0.0;
  bool above = true;      ///< of values above the limit; false: below
  std::string where = {}; ///< of the output, for messages: `study.toml:12: sweep.limits.0.output`
};

/// More draws until a quantile is known well enough.
struct SweepUntil {
  double relative_error = 0.05; ///< half width of the interval over the quantile
  std::string output = {};      ///< column; empty: sweep::measure_of its table
  double quantile = 0.5;
  std::int64_t most_draws = 0; ///< in the end
  std::string where = {};      ///< of the output, as SweepLimit::where
};

struct Sweep {
  SweepDesign design = SweepDesign::monte_carlo;
  std::int64_t draws = 0; ///< of a grid 0: its size follows from its values
  std::uint32_t seed = 1;
  std::vector<SweepVariable> variables;
  std::vector<SweepCorrelation> correlations;
  std::vector<double> quantiles{0.05, 0.5, 0.95};
  double confidence = 0.95; ///< of intervals
  std::vector<SweepLimit> limits;
  std::optional<SweepUntil> until;
  std::int64_t keep = 0; ///< worst cases that are run again with all their results
  std::string keep_by = {},
              keep_by_where =
                  {}; ///< output that is largest there, as SweepUntil::output; as SweepLimit::where
};

/// `[sweep]` of a document, completed or not.
/// @throws core::Error where there is none, or naming line, key, value and cure
[[nodiscard]] Sweep read_sweep(const Document& document);

/// The addresses that a pattern stands for: of arrays of tables by name, group or index, of tables by key.
/// @throws core::Error where nothing fits; `path` names the key in the message
[[nodiscard]] std::vector<std::string> matching_keys(const Value& root, const Value& pattern,
                                                     const std::string& path);

} // namespace fretwork::study
