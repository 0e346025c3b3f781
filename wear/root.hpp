// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Roots and integrals of functions of one variable: Boost.Math, included in one file only.
///
/// Root: G. E. Alefeld, F. A. Potra and Y. Shi's algorithm 748 (ACM Trans. Math. Softw. 21 (1995) 327), which
/// never leaves the bracket. Integral: Gauss and Legendre's 30 points, exact for polynomials of degree 59.
#pragma once
#include <functional>

namespace fretwork::wear {

using Function = std::function<double(double)>;

/// Root of a function that is <= 0 at `low` and >= 0 at `high`, to the last digits of x.
/// @pre low <= high, finite values; the signs as said
[[nodiscard]] double root(const Function& f, double low, double high);

/// Root x > 0 of f(x) = 0 for f <= 0 at 0 < low and >= 0 at high, solved for ln x: x to a relative 1e-14
/// whatever its decade.
[[nodiscard]] double root_of_positive(const Function& f, double low, double high);

/// Integral from `from` to `to` of an analytic function: its error falls as r^-60, r > 1 being the ellipse round the
/// interval, in half its length, up to the function's nearest singularity. 0 where from >= to.
[[nodiscard]] double integral(const Function& f, double from, double to);

} // namespace fretwork::wear
