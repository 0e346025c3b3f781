// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_up.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

constexpr double circle = 2.0 * std::numbers::pi;

/// Of a mode: mean square in the steady state, and the part of it that builds up with the mode's decay.
struct ModeResponse {
  double mean_square = 0.0, building_up = 0.0;
  ModeResponse& operator+=(const ModeResponse& other) {
    mean_square += other.mean_square;
    building_up += other.building_up;
    return *this;
  }
};

/// @param omega  1/s, > 0   @param damping  2 zeta omega, 1/s, > 0
struct ForcedMode {
  double omega, damping;

  [[nodiscard]] ModeResponse to_harmonic(double amplitude, double frequency) const {
    const double drive = circle * frequency;
    const double detuning = omega * omega - drive * drive;
    const double square =
        0.5 * amplitude * amplitude / (detuning * detuning + damping * damping * drive * drive);
    return {square, square};
  }

  [[nodiscard]] ModeResponse to_noise(double rms, double low, double high) const {
    const double f = omega / circle;
    if (f > high) // follows the force
      return {rms * rms / std::pow(omega, 4), 0.0};
    if (f < low) // follows its double integral, at most
      return {rms * rms / std::pow(circle * low, 4), 0.0};
    const double square = rms * rms / (high - low) / (4.0 * damping * omega * omega);
    return {square, square};
  }
};

ModeResponse response_of(const ForcedMode& mode, const signals::TimeFunction& function, double force) {
  if (const auto* harmonic = std::get_if<signals::Harmonic>(&function))
    return mode.to_harmonic(force * harmonic->amplitude, harmonic->frequency);
  if (const auto* random = std::get_if<signals::Random>(&function))
    return mode.to_noise(force * random->rms, random->low, random->high);
  return {};
}

} // namespace

BuildUp build_up(const vibration::ForcedSystem& forced) {
  const vibration::System& system = forced.system;
  if (system.damping_matrix.size() > 0 || !system.motion.empty())
    return {};
  BuildUp out;
  double all = 0.0, most = 0.0;
  for (Eigen::Index k = 0; k < system.size(); ++k) {
    const ForcedMode mode{std::sqrt(system.stiffness[k]), system.damping[k]};
    const bool vibrates = mode.omega > 0.0 && mode.damping > 0.0;
    ModeResponse response;
    for (const vibration::Load& load : forced.loads)
      if (load.modal_force[k] != 0.0 && !std::holds_alternative<signals::Constant>(load.function)) {
        if (!vibrates)
          return {};
        response += response_of(mode, load.function, load.modal_force[k]);
      }
    for (const signals::SampledLoad& load : forced.sampled_loads)
      if (load.rms[k] != 0.0) {
        if (!vibrates)
          return {};
        response += mode.to_noise(load.rms[k], 0.0, load.highest);
      }
    if (response.mean_square == 0.0)
      continue;
    const double decay = 2.0 / mode.damping, windows = 2.0 * forced.duration / decay;
    const double building = response.building_up * -std::expm1(-windows) / windows;
    all += response.mean_square;
    out.share += building;
    if (building > most) {
      most = building;
      out.frequency = mode.omega / circle;
      out.decay_time = decay;
    }
  }
  out.share = all > 0.0 ? out.share / all : 0.0;
  return out;
}

std::string build_up_note(const study::Study& study, const std::vector<BuiltScene>& scenes) {
  if (study.output.statistics_from > 0.0 || !study.initial.empty())
    return {};
  BuildUp largest;
  for (const BuiltScene& scene : scenes)
    if (const BuildUp of = build_up(scene.scene); of.share > largest.share)
      largest = of;
  if (!(largest.share > least_build_up))
    return {};
  return fmt::format(
      "the statistics begin at t = 0, while the motion builds up from rest: without contacts that changes "
      "its "
      "mean square by about {:.2g} % (mode at {:.4g} Hz, decay time 1/(zeta omega) = {:.2g} s); set "
      "output.statistics_from to leave it out",
      100.0 * largest.share, largest.frequency, largest.decay_time);
}

} // namespace fretwork::app
