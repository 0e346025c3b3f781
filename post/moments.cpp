// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/moments.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::post {

Moments Accumulator::moments() const {
  if (count_ == 0)
    return {};
  const auto n = static_cast<double>(count_);
  const double shift = sum_ / n;
  return {first_ + shift, std::sqrt(std::max(0.0, squares_ / n - shift * shift)), min_, max_};
}

} // namespace fretwork::post
