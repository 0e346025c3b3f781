// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A zone of turbulent flow along a tube, cut into patches: what spectra, cross-spectra and random draws are computed from.
///
/// Patch k has its midpoint at s_k and the width ds_k; its force is F_k = ds_k f(s_k), f the force per length. Within a zone
///     G(s, s', f) = sqrt(G(s,f) G(s',f)) exp(-|s - s'|/lambda)
/// real; zones and axes (lift, drag) are independent of each other. A patch moves by the mean of the shapes over it, along its axis at the
/// midpoint; modes are to have a patch and a half a half-wavelength at least. What is taken as fully correlated within a patch adds (ds/lambda)^2/6 to a modal force spectrum at
/// most: 0.7 % for ds = lambda/5, the widest that is accepted; of a zone of n patches that is shorter than lambda L/(3 lambda n^2).
///
/// Scaling of G by the velocity:
/// - local: by V, rho, D and nu of each patch;
/// - zone_mean: with U the mean of V over the zone, u = V/U, overbars means over the zone:
///       G(s, f) = (1/4) D^3 U_r^3 rho(s)^2 u(s)^4 Phi(f D/U_r),   U_r = running velocity (U where none is given)
///   For cor_4 rho in Phi is the mean. two_phase and absolute tables do not depend on rho V^2 and have no factor rho^2 u^4.
/// Both are the same where V and rho are constant. Patches with V < 1e-6 max V carry nothing; their number is returned.
/// Source of zone_mean: Code_Aster v17, PROJ_SPEC_BASE.
#pragma once
#include "flow/spectrum.hpp"
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::flow {

enum class Scaling { local, zone_mean };

/// Mode shapes projected on a direction of the force.
struct LoadAxis {
  Eigen::MatrixXd
      shapes; ///< modes x patches: displacement along the axis, mean over the patch, in any normalisation
  double weight = 1.0; ///< of the spectrum, >= 0
};

struct TurbulentZone {
  std::string name;     ///< in messages
  std::uint32_t id = 0; ///< its random numbers go by it: zones of a run have different ones, below 2^24
  Eigen::VectorXd s;    ///< midpoints, m, ascending
  Eigen::VectorXd ds;   ///< widths, m
  Eigen::VectorXd velocity, density, void_fraction, viscosity,
      diameter;                    ///< V, rho, a, nu, D at the midpoints
  double correlation_length = 0.0; ///< lambda, m
  Spectrum spectrum = Cor2{};
  Scaling scaling = Scaling::local;
  std::optional<double> running_velocity; ///< U_r of zone_mean, m/s
  bool two_sided = false; ///< the constants of the spectrum are those of a two-sided one: G is twice as large
  std::vector<LoadAxis> axes; ///< lift, drag; at most 256

  [[nodiscard]] Eigen::Index patches() const { return s.size(); }
  [[nodiscard]] Eigen::Index modes() const { return axes.empty() ? 0 : axes.front().shapes.rows(); }
};

/// @throws core::Error  arrays of different lengths, values that are no numbers or out of range, patches that overlap or are wider than
///     lambda/5
void check(const TurbulentZone& zone);
/// Also that all have the same number of modes and different numbers.
void check(const std::vector<TurbulentZone>& zones);

struct PatchGrid {
  Eigen::VectorXd s, ds; ///< midpoints and widths, m
};
/// Equal patches over [from, to], m, at most `width` wide.
/// @throws core::Error  an empty interval, a width that is not positive
[[nodiscard]] PatchGrid cut_into_patches(double from, double to, double width);

/// The spectra of all patches of a zone.
class ZoneSpectra {
public:
  /// @throws core::Error  as PointSpectrum and check
  explicit ZoneSpectra(const TurbulentZone& zone);

  /// sqrt(G(s_k, f)), N/m/sqrt(Hz), without the weights of the axes.  @param f  Hz
  [[nodiscard]] double amplitude(Eigen::Index patch, double f) const {
    const std::size_t which = common_ ? 0 : static_cast<std::size_t>(patch);
    return factor_[patch] > 0.0 ? factor_[patch] * std::sqrt(spectra_[which](f)) : 0.0;
  }
  /// a(s_k) of separable spectra: 1 or, of zone_mean, rho u^2 over the mean rho; 0 where there is no flow.
  [[nodiscard]] double factor(Eigen::Index patch) const { return factor_[patch]; }
  /// g(f) of separable spectra, N^2/m^2/Hz.
  [[nodiscard]] double common(double f) const { return spectra_.front()(f); }
  /// True where f lies in the range of the spectrum of the patch.
  [[nodiscard]] bool covers(Eigen::Index patch, double f) const {
    return spectra_[common_ ? 0 : static_cast<std::size_t>(patch)].covers(f);
  }
  /// True where G(s, f) = a(s)^2 g(f): all patches have the same spectrum but for a factor.
  [[nodiscard]] bool separable() const { return common_; }
  /// Patches that carry nothing, V being below 1e-6 of its largest value.
  [[nodiscard]] Eigen::Index idle() const { return (factor_.array() == 0.0).count(); }
  /// Frequencies at which slopes jump, Hz, ascending. Of spectra that differ from patch to patch none.
  [[nodiscard]] std::vector<double> breaks() const;
  /// Largest of the lower ends and smallest of the upper ends of the ranges of the patches, Hz.
  [[nodiscard]] double lowest() const { return lowest_; }
  [[nodiscard]] double highest() const { return highest_; }

private:
  void set_local(const TurbulentZone& zone, double mean_density);
  void set_zone_mean(const TurbulentZone& zone, double mean_density);
  void add(PointSpectrum spectrum);

  bool common_ = false;
  std::vector<PointSpectrum> spectra_; ///< one for all patches, or one each
  Eigen::VectorXd factor_;             ///< on sqrt(G)
  double lowest_ = 0.0, highest_ = std::numeric_limits<double>::infinity();
};

} // namespace fretwork::flow
