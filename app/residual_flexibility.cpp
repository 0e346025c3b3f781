// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/residual_flexibility.hpp"
#include "app/modal_truncation.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace fretwork::app {
namespace {

using Eigen::Index;

/// Missing flexibility times stiffness that makes impacts wrong by half of it: a percent.
constexpr double reported = 0.02;

/// Of the rms motion of a contact, by how much it is low without what turbulence moves beside the modes.
constexpr double low_motion = 0.01;

/// What is in series has no inertia: where a load jumps, the contacts would jump with it, at no finite speed.
void check_continuous(const Fields::Load& load) {
  const auto* table = std::get_if<transient::Table>(&load.function);
  if (!table)
    return;
  for (std::size_t i = 1; i < table->time.size(); ++i)
    if (table->time[i] == table->time[i - 1] && table->value[i] != table->value[i - 1])
      throw core::Error(fmt::format("{}: the table jumps at {} s, and with modes.static_modes = \"auto\" "
                                    "the contacts would jump with it: give "
                                    "the jump a rise of the shortest period that matters, or take "
                                    "static_modes = \"all\"",
                                    load.name, table->time[i]));
}

/// Values at t = 0 of the loads that a static equilibrium has.
Eigen::VectorXd static_values(const transient::Scene& scene) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Index>(scene.loads.size()));
  for (std::size_t l = 0; l < scene.loads.size(); ++l)
    if (!scene.loads[l].inertial)
      values(static_cast<Index>(l)) = transient::static_value(scene.loads[l].function, scene.duration);
  return values;
}

/// @param loads  those of the scene, with their names
void give_residual_flexibility(const ContactFlexibility& flexibility, const std::vector<Fields::Load>& loads,
                               transient::Scene& scene) {
  Eigen::MatrixXd under_loads = flexibility.under_loads;
  for (std::size_t l = 0; l < loads.size(); ++l) {
    auto column = under_loads.col(static_cast<Index>(l));
    // the acceleration of a curve jumps at its rows, and no structure follows that at once: its modes answer alone
    if (loads[l].of_curve)
      column.setZero();
    if (!column.isZero(0.0))
      check_continuous(loads[l]);
  }
  scene.residual = flexibility.missing;
  const Eigen::VectorXd at_start = static_values(scene);
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    transient::ContactPoint& point = scene.contacts[k];
    const Eigen::MatrixXd under = under_loads.middleRows<3>(3 * static_cast<Index>(k));
    if (under.isZero(0.0))
      continue;
    point.under_loads = under;
    point.loaded_at_start = under * at_start;
  }
}

} // namespace

double missing_times_stiffness(const ContactFlexibility& flexibility, std::size_t k,
                               const contact::Support& support) {
  const auto [y, z] = contact::normal_directions(support.obstacle);
  const bool normal[] = {false, y, z};
  const double tangential = support.friction.active() ? support.friction.stiffness : 0.0;
  double largest = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double stiffness = normal[d] ? std::max(support.normal.stiffness, tangential) : tangential;
    largest = std::max(largest, stiffness * ContactFlexibility::own(flexibility.missing, k)(d, d));
  }
  return largest;
}

void take_residual_flexibility(const study::Study& study, const ContactFlexibility& flexibility,
                               const std::vector<Fields::Load>& loads, BuiltScene& built) {
  for (std::size_t k = 0; k < built.scene.contacts.size(); ++k) {
    const transient::ContactPoint& point = built.scene.contacts[k];
    const double product = missing_times_stiffness(flexibility, k, point.support);
    if (product > much_missing)
      built.truncated.push_back(point.name);
    if (product > built.lacking || built.lacking_at.empty()) {
      built.lacking = product;
      built.lacking_at = point.name;
    }
  }
  switch (study.modes.static_modes) {
  case study::StaticModes::none:
  case study::StaticModes::added:
    return;
  case study::StaticModes::residual:
    if (built.lacking > worth_having)
      give_residual_flexibility(flexibility, loads, built.scene);
    return;
  }
}

std::string flexibility_note(const study::Study& study, const std::vector<BuiltScene>& scenes) {
  const auto worst =
      std::max_element(scenes.begin(), scenes.end(),
                       [](const BuiltScene& a, const BuiltScene& b) { return a.lacking < b.lacking; });
  if (worst == scenes.end() || worst->lacking_at.empty())
    return {};
  const std::string lack =
      fmt::format("the static flexibility that the modes lack at a contact times its stiffness is up to "
                  "{:.2g} (\"{}\")",
                  worst->lacking, worst->lacking_at);
  switch (study.modes.static_modes) {
  case study::StaticModes::none:
    return worst->lacking > reported && worst->lacking <= much_missing // more is a warning
               ? lack + ": contact forces are overestimated by up to half of that; set "
                        "modes.static_modes = \"auto\", or ask for more modes"
               : std::string();
  case study::StaticModes::residual:
    return lack + (worst->lacking > worth_having ? ": it is taken in series with the contacts"
                                                 : ": too little to be taken in series with the contacts");
  case study::StaticModes::added:
    return {}; // static_modes_note says what there is
  }
  return {};
}

void judge_turbulence(const std::vector<BuiltScene>& scenes,
                      const std::vector<ContactFlexibility>& flexibilities, results::RunResults& out) {
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const Eigen::VectorXd& beside = flexibilities[s].under_turbulence;
    for (std::size_t k = 0; k < scenes[s].contacts.size() && beside.size() > 0; ++k) {
      const post::ContactSummary& motion = out.contact_summaries[scenes[s].contacts[k]];
      const transient::ContactPoint& point = scenes[s].scene.contacts[k];
      const auto [y, z] = contact::normal_directions(point.support.obstacle);
      for (const auto& [is_normal, d, deviation] :
           {std::tuple(y, 1, motion.y.std), std::tuple(z, 2, motion.z.std)}) {
        const double rms = beside(static_cast<Index>(3 * k) + d);
        const double low = 1.0 - deviation / std::hypot(deviation, rms); // both parts add in squares
        if (!is_normal || !(low > low_motion))
          continue;
        out.warnings.push_back(fmt::format(
            "contact \"{}\": the turbulence would move it by {:.2g} m rms beside the modes, which "
            "the transient leaves out: its rms motion is low by up to {:.2g} %; ask for more modes",
            point.name, rms, 100.0 * low));
        break;
      }
    }
  }
}

} // namespace fretwork::app
