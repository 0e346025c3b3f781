// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/added_mass.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::flow {
namespace {

/// De/P = constant + slope P/D (Rogers, Taylor and Pettigrew 1984).
struct EquivalentDiameter {
  double constant, slope;
};
constexpr EquivalentDiameter of_triangles{0.96, 0.50}, of_squares{1.07, 0.56};

} // namespace

bool is_single(const Bundle& bundle) { return bundle.arrangement == Arrangement::single; }

double pitch_ratio(const Bundle& bundle, double diameter) {
  if (is_single(bundle))
    throw core::Error("a single tube has no pitch; name the arrangement of the bundle and its pitch");
  const double ratio = bundle.pitch / diameter;
  if (!(ratio > least_pitch_ratio) || !std::isfinite(ratio))
    throw core::Error(
        fmt::format("pitch = {:g} m and outer diameter {:g} m: P/D = {:g}, where tubes nearly touch or "
                    "overlap; give the pitch between centres, above {:g} diameters",
                    bundle.pitch, diameter, ratio, least_pitch_ratio));
  return ratio;
}

double confinement_ratio(const Bundle& bundle, double diameter) {
  if (is_single(bundle))
    return std::numeric_limits<double>::infinity();
  const double ratio = pitch_ratio(bundle, diameter);
  const bool triangles =
      bundle.arrangement == Arrangement::triangle || bundle.arrangement == Arrangement::rotated_triangle;
  const auto [constant, slope] = triangles ? of_triangles : of_squares;
  return (constant + slope * ratio) * ratio;
}

double added_mass_coefficient(double confinement_ratio) {
  const double blockage = 1.0 / (confinement_ratio * confinement_ratio);
  return (1.0 + blockage) / (1.0 - blockage);
}

} // namespace fretwork::flow
