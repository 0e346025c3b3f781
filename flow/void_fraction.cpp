// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/void_fraction.hpp"
#include "core/error.hpp"
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <initializer_list>

namespace fretwork::flow {
namespace {

constexpr double feenstra_constant = 25.7; ///< Feenstra, Weaver and Judd 2000
/// Lower end of the bracket over x: alpha falls in proportion to x, and by more than this only where S is above 1e6.
constexpr double bracket_from = 1e-9;
constexpr std::uintmax_t most_iterations = 200; ///< some 15 are needed

void require_positive(double value, const char* name, const char* unit) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(fmt::format("void fraction: {} = {:g} {}; give a number > 0", name, value, unit));
}

void check_quality(double x) {
  if (!(x >= 0.0 && x <= 1.0))
    throw core::Error(fmt::format("void fraction: steam quality = {:g}; give a number from 0 to 1", x));
}

double void_fraction(double x, double velocity_ratio, double density_ratio) {
  return x / (x + velocity_ratio * density_ratio * (1.0 - x));
}

} // namespace

double homogeneous_void_fraction(double quality, double liquid_density, double gas_density) {
  check_quality(quality);
  require_positive(liquid_density, "liquid density", "kg/m3");
  require_positive(gas_density, "gas density", "kg/m3");
  return void_fraction(quality, 1.0, gas_density / liquid_density);
}

VoidFraction feenstra_void_fraction(double quality, const Phases& phases, const CrossFlow& flow) {
  const double homogeneous = homogeneous_void_fraction(quality, phases.liquid_density, phases.gas_density);
  require_positive(phases.liquid_viscosity, "liquid viscosity", "m2/s");
  require_positive(phases.surface_tension, "surface tension", "N/m");
  require_positive(phases.gravity, "gravity", "m/s2");
  require_positive(flow.mass_flux, "pitch mass flux", "kg/m2/s");
  require_positive(flow.diameter, "outer diameter", "m");
  require_positive(flow.pitch - flow.diameter, "pitch less outer diameter", "m");
  if (quality == 0.0 || quality == 1.0)
    return {homogeneous, 1.0};
  const double difference = phases.liquid_density - phases.gas_density,
               dynamic_viscosity = phases.liquid_viscosity * phases.liquid_density,
               richardson = difference * difference * phases.gravity * (flow.pitch - flow.diameter) /
                            (flow.mass_flux * flow.mass_flux),
               capillary_times_alpha = dynamic_viscosity * quality * flow.mass_flux /
                                       (phases.gas_density * phases.surface_tension);
  const auto velocity_ratio = [&](double alpha) {
    return 1.0 + feenstra_constant * std::sqrt(richardson * capillary_times_alpha / alpha) * flow.diameter /
                     flow.pitch;
  };
  const auto excess = [&](double alpha) {
    return alpha - void_fraction(quality, velocity_ratio(alpha), phases.gas_density / phases.liquid_density);
  };
  const double from = bracket_from * quality;
  std::uintmax_t iterations = most_iterations;
  if (!(excess(from) < 0.0))
    throw core::ComputationError(fmt::format(
        "void fraction: no root above alpha = {:g} at steam quality {:g} and pitch mass flux {:g} kg/m2/s; "
        "take the homogeneous void fraction",
        from, quality, flow.mass_flux));
  const auto [low, high] = boost::math::tools::toms748_solve(
      excess, from, 1.0, boost::math::tools::eps_tolerance<double>(), iterations);
  if (iterations >= most_iterations)
    throw core::ComputationError(fmt::format(
        "void fraction: not converged at steam quality {:g}, between {:g} and {:g}", quality, low, high));
  const double alpha = 0.5 * (low + high);
  return {alpha, velocity_ratio(alpha)};
}

double mixture_density(double void_fraction, const Phases& phases) {
  return std::lerp(phases.liquid_density, phases.gas_density, void_fraction);
}

double mixture_viscosity(double void_fraction, const Phases& phases) {
  return phases.liquid_viscosity /
         (1.0 + void_fraction * (phases.liquid_viscosity / phases.gas_viscosity - 1.0));
}

} // namespace fretwork::flow
