// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/stability_diagram.hpp"
#include "core/bracketed_root.hpp"
#include "core/general_eigenvalues.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace fretwork::flow {
namespace {

using Eigen::MatrixXd;

constexpr double smallest_factor = 1e-3;   // of the largest: where roots are those of the modes
constexpr double kept_share = 0.5;         // of a mode in its root from one factor to the next
constexpr int most_halvings = 3;           // of a step in which a mode keeps less
constexpr int most_halvings_of_pairs = 20; // of a step in which a pair meets on the real axis and crosses 0
constexpr double found = 1e-13;            // width of a bracket, of the factor
constexpr double round_off = 1e-10;        // of the largest root: growth below is none

/// Places of largest entries, one in each row and each column, by descending entry.
/// @return for each column its row
std::vector<Eigen::Index> assigned(const MatrixXd& entries) {
  std::vector<std::tuple<double, Eigen::Index, Eigen::Index>> sorted;
  for (Eigen::Index column = 0; column < entries.cols(); ++column)
    for (Eigen::Index row = 0; row < entries.rows(); ++row)
      sorted.emplace_back(-entries(row, column), row, column);
  std::sort(sorted.begin(), sorted.end());
  std::vector<Eigen::Index> out(static_cast<std::size_t>(entries.cols()), -1);
  std::vector<bool> taken(static_cast<std::size_t>(entries.rows()), false);
  for (const auto& [negative, row, column] : sorted) {
    Eigen::Index& to = out[static_cast<std::size_t>(column)];
    if (to >= 0 || taken[static_cast<std::size_t>(row)])
      continue;
    to = row;
    taken[static_cast<std::size_t>(row)] = true;
  }
  return out;
}

class Roots {
public:
  Roots(const Eigen::VectorXd& k, const Eigen::VectorXd& c, const ForcesOverFactor& forces)
      : k_(k), c_(c), forces_(forces) {}

  /// Follows all roots from a small factor on; those that grow there cross at 0.
  void begin(double factor, std::vector<Crossing>& crossings) {
    at_ = solved(factor);
    name_roots();
    none_ = round_off * at_.values.cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < at_.values.size(); ++j)
      if (const std::complex<double> s = at_.values(j); s.real() > none_ && s.imag() >= 0.0)
        crossings.push_back({0.0, {0.0, s.imag()}, mode_[static_cast<std::size_t>(j)], true});
  }

  /// To a larger factor; crossings on the way are appended.
  void advance(double factor, std::vector<Crossing>& crossings) { advance(factor, 0, crossings); }

  /// Of each mode the root of positive imaginary part; of two real ones the larger.
  [[nodiscard]] Eigen::RowVectorXcd of_modes() const {
    Eigen::RowVectorXcd out = Eigen::RowVectorXcd::Zero(k_.size());
    std::vector<bool> seen(static_cast<std::size_t>(k_.size()), false);
    for (Eigen::Index j = 0; j < at_.values.size(); ++j) {
      const Eigen::Index mode = mode_[static_cast<std::size_t>(j)];
      const std::complex<double> s = at_.values(j);
      if (mode < 0 || s.imag() < 0.0)
        continue;
      if (!seen[static_cast<std::size_t>(mode)] || s.imag() > out(mode).imag() ||
          (s.imag() == out(mode).imag() && s.real() > out(mode).real()))
        out(mode) = s;
      seen[static_cast<std::size_t>(mode)] = true;
    }
    return out;
  }

private:
  struct System {
    double factor;
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors, inverse;
  };

  [[nodiscard]] System solved(double factor) const {
    core::Diagonalised roots = core::diagonalised(state_matrix(k_, c_, forces_(factor)));
    return {factor, std::move(roots.values), std::move(roots.vectors), std::move(roots.inverse)};
  }

  /// Gives each mode the pair of roots in which it takes part most.
  void name_roots() {
    const Eigen::Index n = k_.size(), all = at_.values.size();
    // participation of a mode, by displacement and velocity; a pair of roots has the same
    MatrixXd part = MatrixXd::Zero(all, 2 * n);
    for (Eigen::Index mode = 0; mode < n; ++mode)
      for (Eigen::Index j = 0; j < all; ++j)
        part(j, 2 * mode) = part(j, 2 * mode + 1) =
            std::abs(at_.vectors(mode, j) * at_.inverse(j, mode)) +
            std::abs(at_.vectors(n + mode, j) * at_.inverse(j, n + mode));
    mode_.assign(static_cast<std::size_t>(all), -1);
    const std::vector<Eigen::Index> places = assigned(part);
    for (Eigen::Index mode = 0; mode < n; ++mode)
      for (const Eigen::Index place :
           {places[static_cast<std::size_t>(2 * mode)], places[static_cast<std::size_t>(2 * mode + 1)]})
        mode_[static_cast<std::size_t>(place)] = mode;
  }

  /// P_jk, rows by roots of `to`, columns by those of `from`.
  static MatrixXd shares(const System& from, const System& to) {
    return (to.inverse * from.vectors).cwiseProduct((from.inverse * to.vectors).transpose()).cwiseAbs();
  }

  /// `system` with its roots in the order of those of `from`. @param kept  the least share of a mode in its root
  [[nodiscard]] System ordered(const System& from, const System& system, double& kept) const {
    const MatrixXd share = shares(from, system);
    const std::vector<Eigen::Index> places = assigned(share);
    System out = system;
    kept = 1.0;
    for (Eigen::Index k = 0; k < share.cols(); ++k) {
      const Eigen::Index j = places[static_cast<std::size_t>(k)];
      out.values(k) = system.values(j);
      out.vectors.col(k) = system.vectors.col(j);
      out.inverse.row(k) = system.inverse.row(j);
      if (mode_[static_cast<std::size_t>(k)] >= 0)
        kept = std::min(kept, share(j, k));
    }
    return out;
  }

  void advance(double factor, int halvings, std::vector<Crossing>& crossings) {
    double kept = 0.0;
    System next = ordered(at_, solved(factor), kept);
    if ((!(kept >= kept_share) && halvings < most_halvings) ||
        (meets_where_it_crosses(next) && halvings < most_halvings_of_pairs)) {
      advance(0.5 * (at_.factor + factor), halvings + 1, crossings);
      advance(factor, halvings + 1, crossings);
      return;
    }
    for (Eigen::Index k = 0; k < next.values.size(); ++k)
      if (crosses(next, k))
        if (const Crossing one = crossing(next, k); one.root.imag() >= 0.0) // not the conjugate of another
          crossings.push_back(one);
    at_ = std::move(next);
  }

  /// Whether the real part of a root changes its sign on the way to `next`; of conjugates one does.
  [[nodiscard]] bool crosses(const System& next, Eigen::Index k) const {
    const std::complex<double> before = at_.values(k), after = next.values(k);
    return (before.real() > none_) != (after.real() > none_) && !(before.imag() < 0.0 && after.imag() < 0.0);
  }

  /// Whether a pair becomes two real roots, or back, in the same step as one crosses: the two cannot be distinguished there.
  [[nodiscard]] bool meets_where_it_crosses(const System& next) const {
    for (Eigen::Index k = 0; k < next.values.size(); ++k)
      if (crosses(next, k) && (at_.values(k).imag() == 0.0) != (next.values(k).imag() == 0.0))
        return true;
    return false;
  }

  /// Between here and a system in the same order whose root k has its real part on the other side of 0.
  [[nodiscard]] Crossing crossing(const System& next, Eigen::Index k) const {
    const double before = at_.values(k).real(), after = next.values(k).real();
    const double zero = (before > 0.0) != (after > 0.0) ? 0.0 : none_; // below, all is round-off
    std::complex<double> root = next.values(k);
    double kept = 0.0;
    const auto growth = [&](double factor) {
      root = ordered(at_, solved(factor), kept).values(k);
      return root.real() - zero;
    };
    const double factor =
        core::bracketed_root(growth, at_.factor, next.factor, before - zero, after - zero, found);
    return {factor, {0.0, root.imag()}, mode_[static_cast<std::size_t>(k)], after - zero > 0.0};
  }

  const Eigen::VectorXd &k_, &c_;
  const ForcesOverFactor& forces_;
  System at_{};
  double none_ = 0.0;              ///< 1/s, growth that is round-off
  std::vector<Eigen::Index> mode_; ///< of each root, -1 of lags
};

} // namespace

double frequency_of(std::complex<double> root) { return std::abs(root) / (2.0 * std::numbers::pi); }
double damping_of(std::complex<double> root) {
  const double size = std::abs(root);
  return size > 0.0 ? -root.real() / size : 0.0;
}

namespace {

/// Of the way to the nearest factor: the largest between factors, so that no window is passed over that is wider; at most `most_steps_before`.
double step_before(const std::vector<double>& factors, double nearest) {
  constexpr double most_steps_before = 200.0;
  double step = factors.size() > 1 ? nearest / most_steps_before : 0.05 * nearest;
  for (std::size_t i = 1; i < factors.size(); ++i)
    step = std::max(step, factors[i] - factors[i - 1]);
  return step;
}

} // namespace

const Crossing* StabilityDiagram::critical() const {
  const auto at =
      std::find_if(crossings.begin(), crossings.end(), [](const Crossing& c) { return c.to_unstable; });
  return at == crossings.end() ? nullptr : &*at;
}

StabilityDiagram stability_diagram(const Eigen::VectorXd& k, const Eigen::VectorXd& c,
                                   const ForcesOverFactor& forces, std::vector<double> factors) {
  StabilityDiagram out;
  out.factors = std::move(factors);
  out.roots.resize(static_cast<Eigen::Index>(out.factors.size()), k.size());
  double first = smallest_factor * out.factors.back();
  for (const double factor : out.factors)
    if (factor > 0.0)
      first = std::min(first, factor);
  Roots roots(k, c, forces);
  roots.begin(first, out.crossings);
  if (const auto nearest = std::upper_bound(out.factors.begin(), out.factors.end(), first);
      nearest != out.factors.end()) {
    const double step = step_before(out.factors, *nearest);
    for (int i = 1; first + i * step < *nearest; ++i)
      roots.advance(first + i * step, out.crossings);
  }
  for (std::size_t i = 0; i < out.factors.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (out.factors[i] == 0.0) { // the lags stand still
      for (Eigen::Index mode = 0; mode < k.size(); ++mode)
        out.roots(row, mode) =
            -0.5 * c(mode) + std::sqrt(std::complex<double>(0.25 * c(mode) * c(mode) - k(mode)));
      continue;
    }
    if (out.factors[i] > first)
      roots.advance(out.factors[i], out.crossings);
    out.roots.row(row) = roots.of_modes();
  }
  std::sort(out.crossings.begin(), out.crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.factor < b.factor; });
  return out;
}

} // namespace fretwork::flow
