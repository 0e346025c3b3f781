// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/damping.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::modal {
namespace {

void require_not_negative(double value, const std::string& name) {
  if (!(value >= 0.0) || !std::isfinite(value))
    throw core::Error(fmt::format("[modes] damping: {} = {:g}; give a value >= 0", name, value));
}

void check_table(const DampingTable& table) {
  if (table.rows.empty())
    throw core::Error("[modes] damping: a table without rows; give one row [Hz, ratio] at least");
  double before = -1.0;
  for (const auto& [frequency, ratio] : table.rows) {
    require_not_negative(frequency, "frequency of the table");
    require_not_negative(ratio, fmt::format("ratio of the table at {:g} Hz", frequency));
    if (frequency <= before)
      throw core::Error(
          fmt::format("[modes] damping: {:g} Hz after {:g} Hz in the table; give frequencies that "
                      "rise from row to row",
                      frequency, before));
    before = frequency;
  }
}

double ratio_at(const DampingTable& table, double frequency) {
  const auto above = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const DampingTable::Row& row) { return row.frequency > frequency; });
  if (above == table.rows.begin())
    return above->ratio;
  const DampingTable::Row& below = *(above - 1);
  if (above == table.rows.end())
    return below.ratio;
  const double share = (frequency - below.frequency) / (above->frequency - below.frequency);
  return below.ratio + share * (above->ratio - below.ratio);
}

/// Ratios of all modes, static ones included; for a rigid mode whatever the list says: it has no effect there.
struct Ratios {
  const Eigen::VectorXd& omega;
  Eigen::Index true_modes;

  Eigen::VectorXd operator()(double ratio) const {
    require_not_negative(ratio, "ratio");
    return Eigen::VectorXd::Constant(omega.size(), ratio);
  }

  Eigen::VectorXd operator()(const std::vector<double>& ratios) const {
    if (static_cast<Eigen::Index>(ratios.size()) < true_modes)
      throw core::Error(fmt::format(
          "[modes] damping: a list of {} ratios for {} modes; give a ratio for every mode, or one "
          "ratio for all",
          ratios.size(), true_modes));
    for (std::size_t i = 0; i < ratios.size(); ++i)
      require_not_negative(ratios[i], fmt::format("ratio of mode {}", i + 1));
    Eigen::VectorXd out = Eigen::VectorXd::Constant(
        omega.size(), true_modes > 0 ? ratios[static_cast<std::size_t>(true_modes) - 1] : 0.0);
    out.head(true_modes) = Eigen::Map<const Eigen::VectorXd>(ratios.data(), true_modes);
    return out;
  }

  Eigen::VectorXd operator()(const Rayleigh& rayleigh) const {
    require_not_negative(rayleigh.stiffness, "stiffness");
    require_not_negative(rayleigh.mass, "mass");
    Eigen::VectorXd ratios = Eigen::VectorXd::Zero(omega.size());
    for (Eigen::Index i = 0; i < omega.size(); ++i)
      if (omega[i] > 0.0)
        ratios[i] = 0.5 * (rayleigh.stiffness * omega[i] + rayleigh.mass / omega[i]);
    return ratios;
  }

  Eigen::VectorXd operator()(const DampingTable& table) const {
    check_table(table);
    return (omega / (2.0 * std::numbers::pi)).unaryExpr([&](double hertz) { return ratio_at(table, hertz); });
  }
};

} // namespace

void apply_damping(Basis& basis, const Damping& damping) {
  basis.damping = std::visit(Ratios{basis.omega, basis.true_modes()}, damping);
  Eigen::VectorXd diagonal = 2.0 * basis.damping.cwiseProduct(basis.omega);
  if (const auto* rayleigh = std::get_if<Rayleigh>(&damping); rayleigh && rayleigh->mass > 0.0)
    for (Eigen::Index i = 0; i < basis.size(); ++i)
      if (basis.omega[i] == 0.0) { // a ratio to omega = 0 cannot say it
        diagonal[i] = rayleigh->mass;
        if (basis.damping_matrix.size() == 0)
          basis.damping_matrix = Eigen::MatrixXd::Zero(basis.size(), basis.size());
      }
  if (basis.damping_matrix.size() > 0)
    basis.damping_matrix.diagonal() += diagonal;
}

} // namespace fretwork::modal
