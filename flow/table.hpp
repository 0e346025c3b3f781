// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A quantity along the tube, given by rows and linear between them. A single row is a constant.
///     v(s) = v_k + (v_(k+1) - v_k) (s - s_k)/(s_(k+1) - s_k),   s_k <= s <= s_(k+1)
/// Beyond its ends a table keeps its last value; how far it may do so is checked where it is used (profile.hpp).
#pragma once
#include "core/types.hpp"
#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace fretwork::flow {

template <class Value> struct Table {
  std::vector<double> s;     ///< m, along the tube, ascending
  std::vector<Value> values; ///< one for each s

  /// The same value everywhere.
  [[nodiscard]] static Table constant(const Value& value) { return {{0.0}, {value}}; }
  [[nodiscard]] bool is_constant() const { return s.size() == 1; }
  [[nodiscard]] Value at(double where) const {
    const auto next = std::upper_bound(s.begin(), s.end(), where);
    if (next == s.begin())
      return values.front();
    if (next == s.end())
      return values.back();
    const auto k = static_cast<std::size_t>(next - s.begin());
    const double share = (where - s[k - 1]) / (s[k] - s[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }
};

/// @param what  names the table in messages: `zone "inlet": velocity`
/// @throws core::Error for rows that are missing, of different number, not finite or not ascending
void check_rows(std::span<const double> s, std::size_t values, const std::string& what);

/// @param least, greatest  the values must lie between them, both included
/// @throws core::Error naming the row, counted from 1, for a value that is not finite or outside
void check_values(const Table<double>& table, double least, double greatest, const std::string& what);

/// @throws core::Error naming the row for a component that is not finite
void check_values(const Table<core::Vec3>& table, const std::string& what);

} // namespace fretwork::flow
