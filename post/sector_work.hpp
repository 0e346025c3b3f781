// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Work of sliding of every contact by angular sector of the contact point (wear/sectors.hpp), over every step of a window and
/// independent of any sampling. A record adds the integral of F_N |v_T| while the contact slides to the sector opposite to its normal.
/// Sum over sectors = work rate of contact_statistics.hpp. The cost is one angle for each contact that slides in a step.
/// Limit: within a record the contact point has one angle, that of the record's normal.
#pragma once
#include "transient/run.hpp"
#include "wear/sectors.hpp"
#include <span>
#include <vector>

namespace fretwork::post {

class SectorStatistics final : public transient::ContactObserver {
public:
  /// @param sectors  number for each contact; 0: the contact is not watched   @param from  start of the window, s
  /// @param by_place  the contacts of the scene, where obstacles in parts have their work by the angle of the contact's place: the normals of
  ///   facets, of a hole that has opened by angle, are few; empty: all by their normals. Must live longer.
  /// @throws core::Error for a number of sectors out of range
  SectorStatistics(const std::vector<int>& sectors, double from,
                   std::span<const transient::ContactPoint> by_place = {});
  void step(const transient::Record& record) override;
  void visit(core::StateArchive& state) override {
    state(time_);
    for (wear::SectorWork& of_contact : work_)
      state(of_contact);
  }
  /// W, by contact and sector, local axes; no sector of a contact that is not watched, all 0 before the first step of the window.
  [[nodiscard]] std::vector<std::vector<double>> rates() const;

private:
  static constexpr int none = -1;

  [[nodiscard]] double angle(const transient::Record& record, std::size_t contact) const;

  double from_;
  std::span<const transient::ContactPoint> by_place_;
  double time_ = 0.0;        ///< length of the window so far, s
  std::vector<int> watched_; ///< by contact: its place in work_, or none
  std::vector<wear::SectorWork> work_;
};

} // namespace fretwork::post
