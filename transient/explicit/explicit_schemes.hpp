// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The explicit schemes: semi-implicit Euler; order 4 by de Vogelaere; order 5 with adaptive steps and located events, the oracle.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

[[nodiscard]] std::unique_ptr<Scheme> make_euler(const Scene& scene, double step);
[[nodiscard]] std::unique_ptr<Scheme> make_devogelaere(const Scene& scene, double step);
/// @param tolerance  of a step's error, in the energy norm   @param longest  s, step
[[nodiscard]] std::unique_ptr<Scheme> make_runge_kutta_54(const Scene& scene, double tolerance,
                                                          double longest);

} // namespace fretwork::transient
