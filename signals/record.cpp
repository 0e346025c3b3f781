// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/record.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace fretwork::signals {
namespace {

constexpr std::size_t fewest_points = 64;
constexpr double closest = 0.5;     // of the mean interval
constexpr double round_off = 1e-12; // of differences of means, of the means

/// A table from left to right, in pieces on which it is linear.
class Walk {
public:
  explicit Walk(const Table& table) : table_(table) {}

  /// Calls piece(from, to, value at from, value at to) for the pieces up to `end`, from where the last call ended.
  template <class Piece> void to(double end, Piece piece) {
    while (time_ < end) {
      while (next_ < table_.time.size() && table_.time[next_] <= time_)
        ++next_;
      const double until = next_ < table_.time.size() ? std::min(end, table_.time[next_]) : end;
      piece(time_, until, value(time_), value(until));
      time_ = until;
    }
  }

private:
  /// On the piece that `next_` ends.
  [[nodiscard]] double value(double time) const {
    if (next_ == 0)
      return table_.value.front();
    if (next_ == table_.time.size())
      return table_.value.back();
    const double begin = table_.time[next_ - 1], end = table_.time[next_];
    return table_.value[next_ - 1] +
           (time - begin) / (end - begin) * (table_.value[next_] - table_.value[next_ - 1]);
  }

  const Table& table_;
  std::size_t next_ = 0; ///< first point later than time_
  double time_ = 0.0;
};

/// (h/6) [2 1; 1 4 1; ... ; 1 2] c = b, the mass matrix of the hats; the solution replaces b.
void solve_for_corners(std::vector<double>& b, double h) {
  const std::size_t n = b.size();
  std::vector<double> upper(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double diagonal = (k == 0 || k + 1 == n ? 2.0 : 4.0) - (k > 0 ? upper[k - 1] : 0.0);
    upper[k] = 1.0 / diagonal;
    b[k] = (6.0 / h * b[k] - (k > 0 ? b[k - 1] : 0.0)) / diagonal;
  }
  for (std::size_t k = n - 1; k-- > 0;)
    b[k] -= upper[k] * b[k + 1];
}

} // namespace

double mean_interval(const Table& table) {
  assert(table.time.size() > 1);
  return (table.time.back() - table.time.front()) / static_cast<double>(table.time.size() - 1);
}

bool is_record(const Table& table) {
  if (table.time.size() < fewest_points)
    return false;
  const double least = closest * mean_interval(table);
  for (std::size_t i = 1; i < table.time.size(); ++i)
    if (table.time[i] - table.time[i - 1] < least)
      return false;
  return true;
}

double rate_of_record(const Table& record, double highest, double duration) {
  const double window = std::max(1.0 / highest, 0.5 * mean_interval(record)),
               first = std::max(0.0, record.time.front()), last = std::min(duration, record.time.back());
  const auto windows =
      static_cast<std::size_t>(std::floor(std::max(0.0, last - first) / window * (1.0 + 1e-9)));
  Walk walk(record);
  walk.to(first, [](double, double, double, double) {});
  double before = 0.0, difference_before = 0.0, squares = 0.0, first_squares = 0.0, second_squares = 0.0;
  for (std::size_t k = 0; k < windows; ++k) {
    double mean = 0.0;
    walk.to(first + static_cast<double>(k + 1) * window, [&](double from, double to, double a, double b) {
      mean += 0.5 * (a + b) * (to - from) / window;
    });
    const double difference = mean - before;
    if (k > 0)
      first_squares += difference * difference;
    if (k > 1)
      second_squares += std::pow(difference - difference_before, 2);
    squares += mean * mean;
    before = mean;
    difference_before = difference;
  }
  return first_squares > round_off * round_off * squares
             ? std::min(highest, std::sqrt(second_squares / first_squares) / window)
             : 0.0;
}

std::vector<double> nearest_polygon(const Table& table, double step, std::size_t corners) {
  assert(corners > 1);
  std::vector<double> out(corners, 0.0); // first the integrals over the hats
  Walk walk(table);
  for (std::size_t k = 0; k + 1 < corners; ++k) {
    const double begin = static_cast<double>(k) * step;
    walk.to(begin + step, [&](double from, double to, double a, double b) {
      // Simpson's rule is exact: both factors are linear
      const double length = to - from, middle = 0.5 * (a + b);
      const double at_from = (from - begin) / step, at_to = (to - begin) / step,
                   at_middle = 0.5 * (at_from + at_to);
      const double right = length / 6.0 * (a * at_from + 4.0 * middle * at_middle + b * at_to);
      out[k + 1] += right;
      out[k] += length * middle - right;
    });
  }
  solve_for_corners(out, step);
  return out;
}

} // namespace fretwork::signals
