// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/damping_terms.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <numeric>

namespace fretwork::flow {
namespace {

constexpr std::size_t longest_spans = 3; ///< of which l_m is the mean

} // namespace

SpanLayout span_layout(std::vector<double> supports, double tube_length) {
  for (const double s : supports)
    if (!(s >= 0.0 && s <= tube_length))
      throw core::Error(
          fmt::format("support at s = {:g} m is not on the tube; give an abscissa from 0 to its length, "
                      "{:g} m",
                      s, tube_length));
  supports.insert(supports.end(), {0.0, tube_length});
  std::sort(supports.begin(), supports.end());
  std::vector<double> spans(supports.size());
  std::adjacent_difference(supports.begin(), supports.end(), spans.begin());
  spans.erase(spans.begin());
  std::sort(spans.begin(), spans.end(), std::greater<>());
  const std::size_t taken = std::min(longest_spans, spans.size());
  return {static_cast<int>(spans.size()),
          std::accumulate(spans.begin(), spans.begin() + static_cast<std::ptrdiff_t>(taken), 0.0) /
              static_cast<double>(taken)};
}

double support_factor(const SpanLayout& layout, double support_length) {
  return (layout.spans - 1.0) / layout.spans * std::sqrt(support_length / layout.mean_span);
}

double viscous_confinement(double confinement_ratio) {
  const double inverse = 1.0 / confinement_ratio, clear = 1.0 - inverse * inverse;
  return (1.0 + inverse * inverse * inverse) / (clear * clear);
}

double stokes_number(double frequency, double diameter, double viscosity) {
  return std::numbers::pi * frequency * diameter * diameter / (2.0 * viscosity);
}

double viscous_damping(double mass_ratio, double stokes, double confinement) {
  return std::numbers::pi / std::sqrt(8.0) * mass_ratio * confinement / std::sqrt(stokes);
}

double squeeze_film_damping(double support, double frequency, double mass_ratio) {
  return support * squeeze_film_frequency / frequency * mass_ratio;
}

double void_shape(double alpha) {
  if (alpha < void_rise_end)
    return alpha / void_rise_end;
  return alpha <= void_fall_begin ? 1.0 : (1.0 - alpha) / (1.0 - void_fall_begin);
}

double two_phase_damping(double liquid_mass_ratio, double void_fraction, double confinement) {
  return two_phase_damping_level * liquid_mass_ratio * void_shape(void_fraction) * confinement;
}

} // namespace fretwork::flow
