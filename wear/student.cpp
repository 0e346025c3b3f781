// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/student.hpp"
#include <boost/math/distributions/students_t.hpp>
#include <cassert>

namespace fretwork::wear {

double student_factor(double degrees, double confidence) {
  assert(degrees > 0.0 && confidence > 0.0 && confidence < 1.0);
  const boost::math::students_t distribution(degrees);
  return boost::math::quantile(boost::math::complement(distribution, 0.5 * (1.0 - confidence)));
}

} // namespace fretwork::wear
