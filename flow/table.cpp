// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/table.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::flow {

void check_rows(std::span<const double> s, std::size_t values, const std::string& what) {
  if (s.empty() || s.size() != values)
    throw core::Error(
        fmt::format("{}: {} positions and {} values; give one value for each position, at least one row",
                    what, s.size(), values));
  for (std::size_t k = 0; k < s.size(); ++k) {
    if (!std::isfinite(s[k]))
      throw core::Error(fmt::format("{}: row {} has s = {:g}; give a position in metres", what, k + 1, s[k]));
    if (k > 0 && !(s[k] > s[k - 1]))
      throw core::Error(
          fmt::format("{}: row {} at s = {:g} m does not come after row {} at {:g} m; sort the rows by s, "
                      "each s once",
                      what, k + 1, s[k], k, s[k - 1]));
  }
}

void check_values(const Table<double>& table, double least, double greatest, const std::string& what) {
  check_rows(table.s, table.values.size(), what);
  for (std::size_t k = 0; k < table.values.size(); ++k)
    if (!std::isfinite(table.values[k]) || table.values[k] < least || table.values[k] > greatest)
      throw core::Error(fmt::format("{}: row {} at s = {:g} m has the value {:g}; give a number {}", what,
                                    k + 1, table.s[k], table.values[k],
                                    std::isfinite(greatest)
                                        ? fmt::format("from {:g} to {:g}", least, greatest)
                                        : fmt::format(">= {:g}", least)));
}

void check_values(const Table<core::Vec3>& table, const std::string& what) {
  check_rows(table.s, table.values.size(), what);
  for (std::size_t k = 0; k < table.values.size(); ++k)
    if (!table.values[k].allFinite())
      throw core::Error(fmt::format("{}: row {} at s = {:g} m is not finite; give three components", what,
                                    k + 1, table.s[k]));
}

} // namespace fretwork::flow
