// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Statistics of every contact over every step of a window, independent of any sampling. Means over time are
/// sums of value times step over the length of the window, whether steps are equal or not.
///
/// y and z are displacements of the node, from its rest. Radial figures are those of its position, about the obstacle's centre:
/// r^2 = (rest_y + y)^2 + (rest_z + z)^2. The penetration is that of the contact's law: F_N/K_N at the largest force where nothing damps
/// along the normal, else the largest of the motion inside the steps, of schemes that know it, and -gap of the records with a normal force.
#pragma once
#include "contact/sides.hpp"
#include "post/batch_maxima.hpp"
#include "post/batch_means.hpp"
#include "post/extremes.hpp"
#include "post/moments.hpp"
#include "transient/run.hpp"
#include <array>
#include <limits>
#include <vector>

namespace fretwork::post {

/// Standard errors of figures of a window, in their units: the scatter of one run, from batch means, of the largest force from the largest of
/// batches. Not numbers where the window is too short for 8 batches.
struct StandardErrors {
  double work_rate = 0.0, friction_power = 0.0; ///< W
  double normal_rms = 0.0;                      ///< N, over all time
  double impact_rate = 0.0;                     ///< 1/s
  double y_std = 0.0, z_std = 0.0;              ///< m
  double batches = 0.0;           ///< the smallest effective number behind one of them (batch_means.hpp)
  double work_rate_batches = 0.0; ///< that behind the error of the work rate
  double contact_time_ratio = 0.0;
  double normal_max = 0.0, normal_mean = 0.0; ///< N
};

/// Work rate at one side of the tube, or on one land.
struct SideWork {
  double work_rate = 0.0; ///< W
  double error = std::numeric_limits<
      double>::quiet_NaN(); ///< W, standard error; not a number: nothing slides, or a short window
  double batches = 0.0;     ///< effective number behind the error
};
using SideWorks = std::array<SideWork, contact::most_sides>;

/// Over the window. An impact is a maximal interval of normal force > 0; those that start in the window
/// count.
struct ContactSummary {
  std::int64_t impacts = 0;
  double contact_time_ratio = 0.0;
  double normal_mean = 0.0, normal_rms = 0.0, normal_max = 0.0;     ///< N, over all time
  double normal_in_contact_mean = 0.0, normal_in_contact_rms = 0.0; ///< N
  double tangential_rms = 0.0, tangential_max = 0.0;                ///< N, over all time
  Moments y, z;                                                     ///< m, displacement in local axes
  double radial_rms = 0.0, radial_max = 0.0; ///< m, distance from the obstacle's centre
  double penetration_max = 0.0;              ///< m, >= 0
  double work_rate = 0.0;      ///< W: mean over time of F_N |v_T| while the contact slides (Archard's input)
  double friction_power = 0.0; ///< W: dissipated by the Coulomb slider
  double impact_velocity_mean = 0.0, impact_velocity_rms = 0.0,
         impact_velocity_max = 0.0; ///< m/s, normal approach at the start of impacts
  double contact_duration_mean = 0.0, contact_duration_max = 0.0; ///< s
  double departure_velocity_mean = 0.0,
         departure_velocity_max = 0.0; ///< m/s, normal, at the end of impacts that have ended
  double impulse = 0.0;                ///< N s, integral of F_N
  double sliding_distance = 0.0;       ///< m, sum of |dx| while the contact slides (the path of `work_rate`)
  double sticking_ratio = 0.0;         ///< share of the time in contact in which it does not slide
  double damping_work = 0.0;           ///< J, by the normal and tangential dampers, as Impact::energy_lost
  double friction_work = 0.0;          ///< J, by the Coulomb slider
  double impact_rate = 0.0;            ///< 1/s, impacts over the length of the window
  StandardErrors error = {};
  SideWorks sides = {}; ///< `work_rate` by number of the side of the contact point (contact/sides.hpp)
  double corner_work_rate = 0.0; ///< W, the part of `work_rate` at corners of lands
};

class ContactStatistics final : public transient::ContactObserver {
public:
  /// @param contacts  of the scene   @param from  start of the window, s
  ContactStatistics(const std::vector<transient::ContactPoint>& contacts, double from);
  void step(const transient::Record& record) override;
  void visit(core::StateArchive& state) override { state(time_, sums_, motion_, ends_, maxima_); }
  [[nodiscard]] std::vector<ContactSummary> summaries() const;
  /// Of the sums over all contacts of work_rate, friction_power and impact_rate (contacts of one structure are not independent); the
  /// other errors stay 0.
  [[nodiscard]] StandardErrors errors_of_sums() const;

private:
  struct Sums {
    std::int64_t impacts = 0;
    double closed_time = 0.0, normal2 = 0.0, normal_max = 0.0, tangential2 = 0.0, tangential_max = 0.0;
    double slid = 0.0, friction = 0.0, speed = 0.0, speed2 = 0.0, speed_max = 0.0;
    double impulse = 0.0, distance = 0.0, sliding_time = 0.0, damping = 0.0;
    double leaving = 0.0, leaving_max = 0.0;
    std::int64_t departures = 0;
    double duration = 0.0, longest = 0.0;              ///< of the impact under way; of all
    double impact_time = 0.0;                          ///< of impacts that started in the window
    double deepest = 0.0;                              ///< m, penetration at the records and between
    bool counted = false;                              ///< the impact under way started in the window
    std::array<double, contact::most_sides> slid_at{}; ///< `slid` by side
    double slid_at_corners = 0.0;                      ///< of `slid`
    /// A step with force, in the window.
    void add(const transient::ContactState& state, double step, const contact::SideFinder& side_of);
  };
  /// Sums of displacements, weighted by the step, contact by contact in vector lanes; radii are those of positions.
  struct Motion {
    explicit Motion(std::size_t n)
        : y0(n), z0(n), y(n), z(n), y2(n), z2(n), r2(n), radius(n), of_y(n), of_z(n), of_radius(n) {}
    std::vector<double> y0, z0, y, z, y2, z2, r2;
    std::vector<double> radius; ///< m, in the step
    Extremes of_y, of_z, of_radius;
    void visit(core::StateArchive& state) { state(y0, z0, y, z, y2, z2, r2, of_y, of_z, of_radius); }
  };
  void watch_motion(const transient::Record& record);
  void watch_penetration(const transient::Record& record, std::size_t contact);
  void write_sums(double* row) const;
  [[nodiscard]] BatchSums batch_sums() const;
  [[nodiscard]] bool slides(std::size_t contact) const;
  [[nodiscard]] StandardErrors errors_of(const BatchSums& batches, std::size_t contact,
                                         const ContactSummary& o) const;
  [[nodiscard]] SideWorks sides_of(const BatchSums& batches, std::size_t contact) const;

  std::vector<contact::Support> supports_;
  std::vector<contact::SideFinder> side_of_;
  std::vector<double> rest_y_, rest_z_; ///< m, from the obstacle's centre
  double from_;
  double time_ = 0.0; ///< length of the window so far, s
  std::vector<Sums> sums_;
  Motion motion_;
  BatchEnds ends_;
  BatchMaxima maxima_; ///< of normal forces
};

} // namespace fretwork::post
