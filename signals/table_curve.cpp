// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/table_curve.hpp"
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fretwork::signals {
namespace {

/// A cubic is monotone where its slopes at both ends are at most so many times the chord's.
constexpr double steepest = 3.0;
/// Second differences of neighbouring rows of a smooth maximum, the largest over the smallest.
constexpr double most_uneven = 2.0;
/// Excess of a smooth maximum over its rows: twice that of a parabola of second derivative 1 over an interval of 1.
constexpr double most_excess = 2.0 / 8.0;

/// The intervals of a table.
struct Chords {
  explicit Chords(const Table& table) : length(table.time.size() - 1), change(length), slope(length) {
    for (std::size_t i = 0; i < slope.size(); ++i) {
      length[i] = table.time[i + 1] - table.time[i];
      change[i] = table.value[i + 1] - table.value[i];
      slope[i] = change[i] / length[i];
    }
  }
  std::vector<double> length, change, slope; ///< s; of the value; 1/s of it
};

/// Second derivatives at the rows of the spline with slope 0 at both ends. With h_i between rows and d_i the slopes of the chords,
///     h_{i-1} m_{i-1} + 2 (h_{i-1} + h_i) m_i + h_i m_{i+1} = 6 (d_i - d_{i-1}),   at the ends 2 m_0 + m_1 = 6 d_0/h_0 ...
std::vector<double> curvatures(const Chords& chords) {
  const std::size_t n = chords.slope.size() + 1;
  std::vector<double> diagonal(n, 0.0), m(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) { // an interval adds to the equations of its ends
    diagonal[i] += 2.0 * chords.length[i];
    diagonal[i + 1] += 2.0 * chords.length[i];
    m[i] += 6.0 * chords.slope[i];
    m[i + 1] -= 6.0 * chords.slope[i];
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double share = chords.length[i] / diagonal[i];
    diagonal[i + 1] -= share * chords.length[i];
    m[i + 1] -= share * m[i];
  }
  for (std::size_t i = n; i-- > 0;)
    m[i] = (m[i] - (i + 1 < n ? chords.length[i] * m[i + 1] : 0.0)) / diagonal[i];
  return m;
}

std::vector<double> spline_slopes(const Chords& chords) {
  const std::vector<double> m = curvatures(chords);
  std::vector<double> slope(m.size(), 0.0);
  for (std::size_t i = 1; i + 1 < m.size(); ++i)
    slope[i] = chords.slope[i] - chords.length[i] / 6.0 * (2.0 * m[i] + m[i + 1]);
  return slope;
}

/// Second differences at the rows, per second squared; the table reflected at its ends.
std::vector<double> second_differences(const Chords& chords) {
  const std::size_t last = chords.slope.size();
  std::vector<double> out(last + 1);
  out[0] = 2.0 * chords.slope[0] / chords.length[0];
  out[last] = -2.0 * chords.slope[last - 1] / chords.length[last - 1];
  for (std::size_t i = 1; i < last; ++i)
    out[i] = 2.0 * (chords.slope[i] - chords.slope[i - 1]) / (chords.length[i] + chords.length[i - 1]);
  return out;
}

/// How far a cubic with slopes a and b at its ends, over an interval of length h, leaves the range of its end values 0 and `change`.
double excess(double h, double change, double a, double b) {
  a *= h;
  b *= h;
  // y = a x + (3 change - 2 a - b) x^2 + (a + b - 2 change) x^3, turning where r x^2 + 2 q x + a = 0
  const double q = 3.0 * change - 2.0 * a - b, r = 3.0 * (a + b - 2.0 * change);
  const double discriminant = q * q - r * a;
  if (!(discriminant > 0.0))
    return 0.0;
  const double s = -(q + std::copysign(std::sqrt(discriminant), q));
  double out = 0.0;
  for (const double x : {s / r, a / s}) // one may be infinite or no number
    if (x > 0.0 && x < 1.0) {
      const double y = x * (a + x * (q + x * r / 3.0));
      out = std::max({out, y - std::max(0.0, change), std::min(0.0, change) - y});
    }
  return out;
}

/// Whether an interval may leave the range of its rows by so much: about a smooth maximum or minimum.
bool is_smooth_turn(const Chords& chords, const std::vector<double>& second, std::size_t interval,
                    double beyond) {
  const std::size_t last = chords.slope.size();
  const double around[] = {second[interval > 0 ? interval - 1 : 1], second[interval], second[interval + 1],
                           second[interval + 1 < last ? interval + 2 : last - 1]};
  const auto [low, high] = std::minmax_element(std::begin(around), std::end(around));
  if (!(*low * *high > 0.0))
    return false;
  const double least = std::min(std::abs(*low), std::abs(*high)),
               most = std::max(std::abs(*low), std::abs(*high));
  const double h = chords.length[interval];
  return most <= most_uneven * least && beyond <= most_excess * h * h * most;
}

double limited(double slope, double before, double after) {
  if (!(before * after > 0.0))
    return 0.0;
  const double bound = std::copysign(steepest * std::min(std::abs(before), std::abs(after)), after);
  return std::clamp(slope, std::min(0.0, bound), std::max(0.0, bound));
}

} // namespace

std::vector<double> shape_preserving_slopes(const Table& table) {
  const Chords chords(table);
  const std::size_t last = chords.slope.size();
  const std::vector<double> second = second_differences(chords);
  std::vector<double> slope = spline_slopes(chords);
  std::vector<bool> is_limited(last + 1, false);
  is_limited[0] = is_limited[last] = true; // the curve rests there
  const auto limit = [&](std::size_t row) {
    if (!is_limited[row])
      slope[row] = limited(slope[row], chords.slope[row - 1], chords.slope[row]);
    is_limited[row] = true;
  };
  for (bool again = true; again;) { // each pass but the last limits a row
    again = false;
    for (std::size_t i = 0; i < last; ++i) {
      if (is_limited[i] && is_limited[i + 1])
        continue; // monotone
      const double beyond = excess(chords.length[i], chords.change[i], slope[i], slope[i + 1]);
      if (!(beyond > 0.0) || is_smooth_turn(chords, second, i, beyond))
        continue;
      limit(i);
      limit(i + 1);
      again = true;
    }
  }
  return slope;
}

} // namespace fretwork::signals
