// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/output_window.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

/// Share of the duration within which times are equal: output instants and what users write differ by round-off.
constexpr double same_time = 1e-9;

void check(const char* option, double value, const Eigen::VectorXd& time, double equal) {
  if (!(value >= time(0) - equal && value <= time(time.size() - 1) + equal)) // NaN too
    throw core::Error(fmt::format("{} {:g}: a time from {:g} to {:g} s is expected, which the series cover",
                                  option, value, time(0), time(time.size() - 1)));
}

} // namespace

std::vector<Eigen::Index> outputs_of(const OutputWindow& window, const Eigen::VectorXd& time) {
  const double last = time(time.size() - 1), equal = same_time * (last - time(0));
  const double from = window.from.value_or(time(0)), to = window.to.value_or(last);
  check("--from", from, time, equal);
  check("--to", to, time, equal);
  if (window.every && *window.every < 1)
    throw core::Error(
        fmt::format("--every {}: an integer >= 1 is expected; 1 takes every output", *window.every));
  if (from > to)
    throw core::Error(
        fmt::format("--from {:g} --to {:g}: the window ends before it begins; exchange them", from, to));
  const auto begin = std::lower_bound(time.begin(), time.end(), from - equal);
  const auto end = std::upper_bound(time.begin(), time.end(), to + equal);
  const Eigen::Index first = begin - time.begin(), count = end - begin;
  if (count <= 0)
    throw core::Error(
        fmt::format("--from {:g} --to {:g}: no output lies between them; the next are at {:g} and {:g} s",
                    from, to, time(first - 1), time(first)));
  std::vector<Eigen::Index> chosen;
  if (window.every)
    for (Eigen::Index i = 0; i < count;
         i += static_cast<Eigen::Index>(std::min<std::int64_t>(*window.every, count)))
      chosen.push_back(first + i);
  else {
    const Eigen::Index files = std::min(most_snapshots, count);
    for (Eigen::Index i = 0; i < files; ++i)
      chosen.push_back(first + (files > 1 ? i * (count - 1) / (files - 1) : 0));
  }
  return chosen;
}

} // namespace fretwork::results
