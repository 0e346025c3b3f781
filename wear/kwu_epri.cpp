// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/kwu_epri.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::wear {

namespace {

constexpr double class_limit = 1e-12; ///< of a class, in widths

} // namespace

KwuClasses::KwuClasses(double force_max, double speed_max)
    : force_width_(force_max / kwu_classes), speed_width_(speed_max / kwu_classes) {
  check_positive("kwu_epri", "largest normal force", force_max, "N");
  check_positive("kwu_epri", "largest sliding speed", speed_max, "m/s");
}

int KwuClasses::class_of(double in_widths) {
  for (int i = 0; i < kwu_classes; ++i)
    if (in_widths <= i + 1 + class_limit)
      return i;
  return kwu_classes;
}

double KwuClasses::share(int speed_class, int force_class) const {
  return time_ > 0.0
             ? times_[static_cast<std::size_t>(speed_class)][static_cast<std::size_t>(force_class)] / time_
             : 0.0;
}

ImpactSliding KwuClasses::indices(const KwuConstants& constants) const {
  check_positive("kwu_epri", "k1", constants.k1, "");
  check_positive("kwu_epri", "k2", constants.k2, "s2/N/m2");
  check_positive("kwu_epri", "k", constants.k, "");
  check_positive("kwu_epri", "force C", constants.force, "N");
  ImpactSliding out{0.0, 0.0};
  for (int j = 0; j < kwu_classes; ++j) {
    const double force = (j + 0.5) * force_width_, ratio = force / constants.force;
    out.impact += share(0, j) * constants.k1 * constants.k * ratio * ratio * ratio;
    for (int i = 0; i < kwu_classes; ++i) {
      const double speed = (i + 0.5) * speed_width_;
      if (i > 0 || j == 0)
        out.sliding += share(i, j) * constants.k2 * force * speed * speed;
    }
  }
  return out;
}

double combined_index(const ImpactSliding& indices) {
  const double sum = indices.sliding + indices.impact;
  return sum > 0.0 ? indices.sliding * (indices.sliding / sum) : 0.0;
}

} // namespace fretwork::wear
