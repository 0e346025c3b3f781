// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/moments.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::post {

Moments Accumulator::moments() const {
  if (!(weight_ > 0.0))
    return {};
  const double shift = sum_ / weight_;
  return {first_ + shift, std::sqrt(std::max(0.0, squares_ / weight_ - shift * shift)), min_, max_};
}

} // namespace fretwork::post
