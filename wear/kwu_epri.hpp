// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Indices of impact and sliding of the law kwu_epri, from the normal forces F and sliding speeds v of a contact.
///
/// Samples with F > 0 are counted in 5 x 5 classes of width F_max/5 and v_max/5; a class holds (lower, upper], its
/// limits taken to a relative 1e-12 of the width, and v = 0 belongs to the first. With the shares x_ij of the
/// samples (class i of speed, j of force) and the class centres v_i, F_j
///     Si = sum_j x_1j k1 k (F_j/C)^3                                        slow: impact
///     Sg = sum_(i >= 2, j) x_ij k2 F_j v_i^2 + x_11 k2 F_1 v_1^2            sliding
///     I  = Sg^2/(Sg + Si)
/// k2 carries the unit that makes Sg a number (s2/N/m2). A sample counts with the length of time it stands for.
/// A sample above a given maximum is in no class; the share of the time of such samples is returned.
/// Source: Code_Aster 17, POST_USURE, which rounds F_max/5 down to whole newtons (not repeated here).
#pragma once
#include "core/state_archive.hpp"
#include "wear/laws.hpp"
#include <array>
#include <span>

namespace fretwork::wear {

/// k and C are Code_Aster's.
struct KwuConstants {
  double k1, k2; ///< > 0; k2 in s2/N/m2
  double k = 5.0;
  double force = 10.0; ///< C, N
};

inline constexpr int kwu_classes = 5;

/// Counts samples as they come, in constant memory: one pass, for maxima that are known.
class KwuClasses {
public:
  /// @param force_max, speed_max  N, m/s, > 0. @throws core::Error
  KwuClasses(double force_max, double speed_max);

  /// @param force  N; samples without contact (<= 0) do not count   @param speed  m/s, >= 0
  /// @param time   what the sample stands for, s, > 0 (equal samples: 1)
  void add(double force, double speed, double time = 1.0) {
    if (!(force > 0.0))
      return;
    const int i = class_of(speed / speed_width_), j = class_of(force / force_width_);
    time_ += time;
    if (i < kwu_classes && j < kwu_classes)
      times_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += time;
    else
      above_ += time;
  }

  /// The samples of another contact of the same support, counted with the same maxima.
  void add(const KwuClasses& other) {
    for (std::size_t i = 0; i < times_.size(); ++i)
      for (std::size_t j = 0; j < times_[i].size(); ++j)
        times_[i][j] += other.times_[i][j];
    time_ += other.time_;
    above_ += other.above_;
  }
  void visit(core::StateArchive& state) { state(times_, time_, above_); }

  /// x_ij of class i of speed and j of force, from 0; all 0 without a sample.
  [[nodiscard]] double share(int speed_class, int force_class) const;
  /// Share of the time in contact in which a sample was above a maximum.
  [[nodiscard]] double share_above() const { return time_ > 0.0 ? above_ / time_ : 0.0; }
  /// @throws core::Error for constants that are not > 0
  [[nodiscard]] ImpactSliding indices(const KwuConstants& constants) const;

private:
  static int class_of(double in_widths);

  double force_width_, speed_width_;
  std::array<std::array<double, kwu_classes>, kwu_classes> times_{}; ///< s, by speed, force
  double time_ = 0.0, above_ = 0.0;                                  ///< s
};

/// Largest force and speed of the samples with F > 0, for a second pass; 0 without such a sample.
struct KwuMaxima {
  double force = 0.0, speed = 0.0; ///< N, m/s
  void add(double normal_force, double sliding_speed) {
    if (!(normal_force > 0.0))
      return;
    force = normal_force > force ? normal_force : force;
    speed = sliding_speed > speed ? sliding_speed : speed;
  }
};

/// I; 0 where both indices are 0.
[[nodiscard]] double combined_index(const ImpactSliding& indices);

} // namespace fretwork::wear
