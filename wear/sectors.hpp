// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Work of sliding by angular sector of the contact point, for wear that is not alike all round.
///
/// n sectors of 2 pi/n on -pi..pi, from y_loc to z_loc; sector k (from 0) holds lower <= angle < upper with
/// lower = -pi + 2 pi k/n, the last also pi. Angles beyond a turn are brought back into it. Each step adds its
/// work to one sector: the sum over sectors is the work of all steps, and over the length of the window the
/// work rate. The cost of a step does not depend on n.
#pragma once
#include "core/state_archive.hpp"
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace fretwork::wear {

/// Angle, rad, at which the contact point lies, opposite to the normal of the contact (local axes).
[[nodiscard]] inline double contact_angle(double ny, double nz) { return std::atan2(-nz, -ny); }

class SectorWork {
public:
  static constexpr int most = 3600; ///< sectors: a tenth of a degree

  /// @throws core::Error unless 1 <= sectors <= most
  explicit SectorWork(int sectors);

  /// @param angle  of the contact point, rad, finite   @param work  J of the step, >= 0: integral of F_N |v_T| while it slides
  void add(double angle, double work) {
    if (work > 0.0)
      work_[sector_of(angle)] += work;
  }
  void visit(core::StateArchive& state) { state(work_); }

  [[nodiscard]] std::size_t sector_of(double angle) const {
    constexpr double turn = 2.0 * std::numbers::pi;
    if (!(std::abs(angle) <= std::numbers::pi))
      angle = std::remainder(angle, turn);
    const double place = (angle / turn + 0.5) * static_cast<double>(work_.size());
    const auto sector = static_cast<std::size_t>(place > 0.0 ? place : 0.0);
    return sector < work_.size() ? sector : work_.size() - 1;
  }
  [[nodiscard]] std::size_t size() const { return work_.size(); }
  /// Angle of a sector, rad.
  [[nodiscard]] double width() const { return 2.0 * std::numbers::pi / static_cast<double>(work_.size()); }
  /// Middle of a sector, rad.
  [[nodiscard]] double middle(std::size_t sector) const {
    return ((static_cast<double>(sector) + 0.5) / static_cast<double>(work_.size()) - 0.5) * 2.0 *
           std::numbers::pi;
  }
  /// J, by sector.
  [[nodiscard]] std::span<const double> work() const { return work_; }
  /// J, sum over sectors.
  [[nodiscard]] double total() const;
  /// W, by sector. @param duration  of the window, s, > 0. @throws core::Error
  [[nodiscard]] std::vector<double> rates(double duration) const;

private:
  std::vector<double> work_;
};

} // namespace fretwork::wear
