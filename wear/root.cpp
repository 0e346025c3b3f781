// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/root.hpp"
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace fretwork::wear {

namespace {

constexpr std::uintmax_t most_evaluations = 300; ///< bisection alone ends within 64 * 3

} // namespace

double root(const Function& f, double low, double high) {
  const double f_low = f(low), f_high = f(high);
  assert(low <= high && f_low <= 0.0 && f_high >= 0.0);
  if (f_low == 0.0)
    return low;
  if (f_high == 0.0)
    return high;
  std::uintmax_t evaluations = most_evaluations;
  const auto [a, b] = boost::math::tools::toms748_solve(
      f, low, high, f_low, f_high, boost::math::tools::eps_tolerance<double>(52), evaluations);
  return 0.5 * (a + b);
}

double root_of_positive(const Function& f, double low, double high) {
  assert(low > 0.0);
  return high * std::exp(root([&](double u) { return f(high * std::exp(u)); }, std::log(low / high), 0.0));
}

double integral(const Function& f, double from, double to) {
  if (!(from < to))
    return 0.0;
  return boost::math::quadrature::gauss<double, 30>::integrate(f, from, to);
}

} // namespace fretwork::wear
