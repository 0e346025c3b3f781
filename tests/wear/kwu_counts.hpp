// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Samples of equal time counted in classes of their own maxima.
#pragma once
#include "wear/kwu_epri.hpp"
#include <span>

namespace fretwork::wear {

/// @param forces, speeds  N, m/s, of the same length
inline KwuClasses counted(std::span<const double> forces, std::span<const double> speeds) {
  KwuMaxima maxima;
  for (std::size_t k = 0; k < forces.size(); ++k)
    maxima.add(forces[k], speeds[k]);
  KwuClasses classes(maxima.force, maxima.speed);
  for (std::size_t k = 0; k < forces.size(); ++k)
    classes.add(forces[k], speeds[k]);
  return classes;
}

} // namespace fretwork::wear
