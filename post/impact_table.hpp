// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The impacts of every contact, one row each.
///
/// An impact is an interval of normal force > 0. Where the contact opens for less than `rest_time` and closes
/// again, the impact goes on: a rebound. It ends with the last opening before a longer rest.
///
/// Resolution. `splitting` finds the instants at which contacts close and open inside its steps; with other schemes they are edges of steps h, so that
/// the mean duration of many impacts is right and a single one is off by h. The impulse is the integral of the normal force, the peak its
/// largest value at the ends of the intervals in which the scheme moves the contacts.
#pragma once
#include "transient/run.hpp"
#include <limits>
#include <vector>

namespace fretwork::post {

struct Impact {
  double start = 0.0;           ///< s
  double duration = 0.0;        ///< s, from the first touch to the last opening, rebounds included
  double peak = 0.0;            ///< N, largest normal force
  double impulse = 0.0;         ///< N s, integral of the normal force
  double velocity_before = 0.0; ///< m/s, normal, towards the obstacle, at the first touch
  /// m/s, normal, away from the obstacle, at the last opening; NaN where the run ends before the contact
  /// opens
  double velocity_after = std::numeric_limits<double>::quiet_NaN();
  /// J, by the contact's dampers and by friction while there is a normal force. A linear damper ends the force
  /// while the spring is still pressed: what is left in the spring then (2 xi^2 m v'^2 of a mass m that leaves at v',
  /// 5 % of the loss at xi = 0.1) is lost without a force and not in it; nor is what the tangential spring still holds, T^2/(2 K_T),
  /// and loses after opening. The run's contact damping has both.
  double energy_lost = 0.0;
  std::int64_t rebounds = 0; ///< openings shorter than `rest_time`
};

/// Of one contact, in time: the first impacts, and how many there were beyond them.
struct ContactImpacts {
  std::vector<Impact> rows;
  std::int64_t left_out = 0;
  void visit(core::StateArchive& state) { state(rows, left_out); }
};

/// Impacts that start in the window; one under way at its start is none of them.
class ImpactTable final : public transient::ContactObserver {
public:
  /// @param contacts   number of contacts   @param from  start of the window, s
  /// @param rest_time  s, >= 0; 0: no rebounds, every interval of force is an impact
  /// @param most       rows of each contact, reserved here; further impacts are counted
  ImpactTable(std::size_t contacts, double from, double rest_time, std::size_t most);
  void step(const transient::Record& record) override;
  void visit(core::StateArchive& state) override { state(under_way_, out_); }
  /// One entry a contact; impacts under way end where the run stands.
  [[nodiscard]] std::vector<ContactImpacts> impacts() &&;

private:
  struct UnderWay {
    Impact row;
    double begin = 0.0, end = 0.0; ///< s: of the first and the last force
    bool begun = false;            ///< there has been one
    bool counted = false;          ///< it started in the window
  };
  void close(std::size_t contact, double time, double speed, bool counted);
  void keep(std::size_t contact);

  double from_, rest_time_;
  std::size_t most_;
  std::vector<UnderWay> under_way_;
  std::vector<ContactImpacts> out_;
};

} // namespace fretwork::post
