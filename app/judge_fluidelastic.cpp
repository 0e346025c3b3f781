// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/judge_fluidelastic.hpp"
#include "app/tubes_of_laws.hpp"
#include "core/general_eigenvalues.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace fretwork::app {
namespace {

constexpr double largest_factor = 3.0; // of the search for the first crossing
constexpr int search_steps = 30, search_halvings = 30;
constexpr double no_growth = 1e-10; // of the largest root: growth below is none

/// The vibration modes of tubes in their flow.
class Roots {
public:
  /// @param most  modes of each structure
  Roots(const TubesOfLaw& all, const std::vector<modal::Basis>& bases, Eigen::Index most) {
    const TubesOfLaw of = lowest(all, bases, most);
    forces_ = forces_of(of, largest_factor);
    k_.resize(of.modes);
    c_ = Eigen::MatrixXd::Zero(of.modes, of.modes);
    for (std::size_t i = 0; i < of.structures.size(); ++i) {
      const modal::Basis& basis = bases[of.structures[i]];
      const Eigen::Index n = std::min(most, basis.true_modes());
      k_.segment(of.first[i], n) = basis.omega.head(n).cwiseAbs2();
      auto c = c_.block(of.first[i], of.first[i], n, n);
      if (basis.damping_matrix.size() > 0)
        c = basis.damping_matrix.topLeftCorner(n, n);
      else
        c.diagonal() = 2.0 * basis.damping.head(n).cwiseProduct(basis.omega.head(n));
    }
  }

  [[nodiscard]] Eigen::Index size() const { return 2 * k_.size() + forces_(1.0).states(); }

  /// The root that grows fastest at `factor` times the velocity, 1/s; where none grows, the vibration of least damping ratio.
  [[nodiscard]] std::complex<double> worst(double factor) const {
    const Eigen::Index n = k_.size();
    Eigen::MatrixXd a = flow::state_matrix(k_, Eigen::VectorXd::Zero(n), forces_(factor));
    a.block(n, n, n, n) -= c_;
    const Eigen::VectorXcd roots = core::general_eigenvalues(a);
    const double none = no_growth * roots.cwiseAbs().maxCoeff();
    std::complex<double> growing = none, vibrating = 0.0;
    double ratio = std::numeric_limits<double>::infinity();
    for (const std::complex<double>& s : roots) {
      if (s.real() > growing.real())
        growing = {s.real(), std::abs(s.imag())};
      if (s.imag() > 0.0 && -s.real() / std::abs(s) < ratio) {
        ratio = -s.real() / std::abs(s);
        vibrating = s;
      }
    }
    return growing.real() > none ? growing : std::complex(std::min(vibrating.real(), 0.0), vibrating.imag());
  }

  /// The least factor of all velocities at which a root crosses the imaginary axis, up to largest_factor.
  [[nodiscard]] std::optional<double> critical_factor() const {
    double low = 0.0;
    for (int i = 1; i <= search_steps; ++i) {
      double high = largest_factor * i / search_steps;
      if (worst(high).real() > 0.0) {
        for (int k = 0; k < search_halvings; ++k) {
          const double middle = 0.5 * (low + high);
          (worst(middle).real() > 0.0 ? high : low) = middle;
        }
        return high;
      }
      low = high;
    }
    return {};
  }

private:
  flow::ForcesOverFactor forces_;
  Eigen::VectorXd k_;
  Eigen::MatrixXd c_;
};

} // namespace

void judge_fluidelastic(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                        const std::vector<PlacedContact>& placed, results::RunResults& out) {
  for (const TubesOfLaw& of : tubes_of_laws(tubes, bases)) {
    const auto [velocity, diameter] = fastest(of);
    if (velocity == 0.0)
      continue;
    Eigen::Index most = 0;
    for (const std::size_t s : of.structures)
      most = std::max(most, bases[s].true_modes());
    std::optional<Roots> found(std::in_place, of, bases, most);
    bool some = false; // modes alone
    for (; found->size() > most_searched && most > 1; some = true)
      found.emplace(of, bases, most /= 2);
    const Roots& roots = *found;
    results::LawAtWork now{{}, roots.size(), roots.worst(1.0), velocity, diameter, roots.critical_factor()};
    for (const std::size_t f : of.flows)
      now.tubes.push_back(tubes.study.flows[tubes.flows[f].entry].name);
    if (of.law.frozen && !placed.empty())
      out.warnings.push_back(fmt::format(
          "{}: the law is frozen at the frequency of each mode, which contacts change: it holds up to the "
          "threshold, and past it no stop limits the motion; give a law with lags",
          of.name));
    const std::complex<double> root = now.root;
    const double frequency = flow::frequency_of(root), reduced = now.reduced_velocity();
    const std::optional<double> critical = now.critical_factor;
    out.laws.push_back(std::move(now));
    const bool unstable = root.real() > 0.0;
    std::string crossing =
        critical
            ? fmt::format("critical velocity {:.5g} m/s, factor {:.5g}, with the damping of the transient",
                          *critical * velocity, *critical)
            : fmt::format("stable up to {:g} times the velocity", largest_factor);
    if (some)
      crossing +=
          fmt::format(" (of the {} lowest modes{})", most, of.structures.size() > 1 ? " of each tube" : "");
    const bool diverges = unstable && root.imag() == 0.0;
    const std::string motion = diverges ? fmt::format("divergence, which grows by {:.4g} 1/s", root.real())
                                        : fmt::format("{:.5g} Hz with damping {:.4g} at V/(f D) = {:.4g}",
                                                      frequency, flow::damping_of(root), reduced);
    std::string text =
        fmt::format("{}: fluidelastic law, without contacts: {}; {}", of.name, motion, crossing);
    if (unstable)
      text += ": unstable, supports must limit the motion";
    (unstable ? out.warnings : out.notes).push_back(std::move(text));
    if (const auto& range = of.law.range;
        range && unstable && !diverges && (reduced < (*range)[0] || reduced > (*range)[1]))
      out.warnings.push_back(
          fmt::format("{}: reduced velocity {:.4g} of the unstable mode is outside the law's range "
                      "{:g} to {:g}; the law is extrapolated",
                      of.name, reduced, (*range)[0], (*range)[1]));
  }
}

} // namespace fretwork::app
