// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/held_damping.hpp"
#include "app/pinned_model.hpp"
#include "core/symmetric.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

constexpr Eigen::Index modes_of_held = 200; ///< the lowest, of which the lowest held mode is made
/// Of the largest omega^2: a motion without strain.
constexpr double least_strain = 1e-12;
/// Of the ratio asked for, what a held mode may lack.
constexpr double noticed_lack = 0.1;

/// The lowest mode of a structure on its closed contacts that strains it.
struct HeldMode {
  double omega = 0.0, damping = 0.0; ///< rad/s, ratio to critical
  double share = 1.0;                ///< of the ratio that its modes have, in the mean of its dampers
};

HeldMode lowest_held(const modal::Basis& basis, const fem::Model& model, const fem::Model& pinned) {
  const Eigen::Index modes = std::min(basis.true_modes(), modes_of_held);
  const auto [squares, shapes] = core::symmetric_eigenpairs(stiffness_with_pins(basis, modes, model, pinned));
  const double rigid = least_strain * squares.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < squares.size(); ++i) {
    if (!(squares(i) > rigid))
      continue;
    HeldMode out;
    out.omega = std::sqrt(squares(i));
    const Eigen::ArrayXd speeds = shapes.col(i).array().square() * basis.omega.head(modes).array();
    out.damping = (speeds * basis.damping.head(modes).array()).sum() / out.omega;
    out.share = speeds.sum() / out.omega;
    return out;
  }
  return {};
}

std::string ratio_text(double ratio) { return fmt::format("{:.3g} %", 100.0 * ratio); }

} // namespace

void note_held_damping(const study::Study& study, const fem::Model& model,
                       const std::vector<modal::Basis>& bases, const std::vector<PlacedContact>& contacts,
                       results::RunResults& out) {
  const double* ratio = std::get_if<double>(&study.modes.damping);
  if (!study.modes.flow_damping && !(ratio && *ratio > 0.0))
    return;
  const std::vector<PlacedContact> held = that_can_pin(model, contacts);
  if (held.empty())
    return;
  const fem::Model pinned = pinned_model(study, model, held, {true, true});
  HeldMode worst;
  for (const modal::Basis& basis : bases)
    if (basis.damping_matrix.size() == 0)
      if (const HeldMode found = lowest_held(basis, model, pinned); found.share < worst.share)
        worst = found;
  if (!(worst.share < 1.0 - noticed_lack))
    return;
  const std::string at = fmt::format("at {:.4g} Hz, held by closed contacts, the damping ratio is {}",
                                     worst.omega / (2.0 * std::numbers::pi), ratio_text(worst.damping));
  out.notes.push_back(
      study.modes.flow_damping
          ? at + ": that of the flow for modes without contacts, of which held ones are made"
          : fmt::format("{}, not {}: held modes are made of slower ones; modes.damping = {{ mass = {:.4g} }} "
                        "gives {} there",
                        at, ratio_text(*ratio), 2.0 * *ratio * worst.omega, ratio_text(*ratio)));
}

} // namespace fretwork::app
