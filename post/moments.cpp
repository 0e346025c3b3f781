// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/moments.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::post {

double Accumulator::mean() const { return weight_ > 0.0 ? first_ + sum_ / weight_ : 0.0; }

double Accumulator::std() const {
  if (!(weight_ > 0.0))
    return 0.0;
  const double shift = sum_ / weight_;
  return std::sqrt(std::max(0.0, squares_ / weight_ - shift * shift));
}

} // namespace fretwork::post
