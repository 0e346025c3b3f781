// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the flow along tubes gives: damping of the modes and stability, as plain data.
#pragma once
#include "flow/damping.hpp"
#include "flow/mode_direction.hpp"
#include "flow/stability.hpp"
#include "flow/stability_diagram.hpp"
#include "post/growth.hpp"
#include "post/power_balance.hpp"
#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::results {

/// Damping of the modes of one structure by the flow along one tube.
struct TubeDamping {
  std::string tube;
  std::vector<std::string> zones; ///< names
  double length = 0.0;            ///< m
  std::size_t structure = 0;      ///< number in RunResults::bases
  Eigen::VectorXd frequency;      ///< Hz, of the modes
  flow::Damping damping;
  std::vector<std::string> limits; ///< those of `damping`, in words
};

/// The roots of the modes of the tubes of a fluidelastic law.
struct LawStability {
  /// A column of the diagram.
  struct Mode {
    std::string tube;
    Eigen::Index number; ///< from 0, of the tube's structure
    double connors;      ///< factor of all velocities at which Connors has it unstable; not finite: none
  };
  double velocity = 0.0, diameter = 0.0;      ///< m/s, m, where V is largest at factor 1
  std::optional<std::array<double, 2>> range; ///< of V/(f D) in which the law was measured
  flow::StabilityDiagram diagram;
  std::vector<std::string> tubes; ///< names, in the order of the law
  std::vector<Mode> modes;

  /// V/(f D); none of divergence.
  [[nodiscard]] std::optional<double> reduced_velocity(double factor, double frequency) const {
    if (!(frequency > 0.0))
      return {};
    return factor * velocity / (frequency * diameter);
  }
  /// Where a mode becomes unstable first.
  [[nodiscard]] std::optional<double> critical_factor(Eigen::Index mode) const {
    for (const flow::Crossing& one : diagram.crossings)
      if (one.mode == mode && one.to_unstable)
        return one.factor;
    return {};
  }
  /// True where a root of the modes or lags grows: more crossings to there than back.
  [[nodiscard]] bool unstable_at(double factor) const {
    int growing = 0;
    for (const flow::Crossing& one : diagram.crossings)
      if (one.factor < factor)
        growing += one.to_unstable ? 1 : -1;
    return growing > 0;
  }
  /// True where the law says nothing on a vibration of this reduced velocity.
  [[nodiscard]] bool outside(double reduced) const {
    return range && (reduced < (*range)[0] || reduced > (*range)[1]);
  }
};

/// What a run found of the motion of tubes that a law makes unstable without contacts: in the window of the statistics, and `later`, in
/// that of the second half of the run.
struct LawMotion {
  /// Where it moves most about its mean.
  struct Place {
    bool contact = false; ///< or an observed node
    std::string name;
    char axis = 'x';                 ///< of a contact y or z of its local axes
    double rms = 0.0, largest = 0.0; ///< m, from the mean
    std::optional<double> frequency; ///< Hz, dominant, later; none: few outputs, or folded ones
    double resolution = 0.0;         ///< Hz, between lines of its spectrum
  };
  std::optional<Place> place;         ///< none without contacts and observed nodes, or at rest
  double later_from = 0.0;            ///< s
  std::optional<post::Growth> growth; ///< later
  std::vector<std::string> tubes;     ///< with laws, that run together: theirs are the powers
  post::PowerBalance power;
};

/// What a fluidelastic law makes of the modes without contacts at the velocities given.
struct LawAtWork {
  std::vector<std::string> tubes;        ///< names, in the order of the law
  std::int64_t unknowns = 0;             ///< of modes and lags
  std::complex<double> root;             ///< 1/s, that grows fastest, or else the vibration of least damping
  double velocity = 0.0, diameter = 0.0; ///< m/s, m, where V is largest
  std::optional<double> critical_factor = {}; ///< of all velocities; none: stable up to the last one searched

  std::optional<LawMotion> motion = {}; ///< after a run, of an unstable one

  [[nodiscard]] bool unstable() const { return root.real() > 0.0; }
  /// V/(f D); not finite of divergence.
  [[nodiscard]] double reduced_velocity() const { return reduced_velocity(flow::frequency_of(root)); }
  [[nodiscard]] double reduced_velocity(double frequency) const { return velocity / (frequency * diameter); }
};

/// Stability of one tube on modes pinned at supports.
struct StabilityAssessment {
  std::string name;
  std::vector<std::string> pinned;        ///< names of the contacts at which the modes are held
  bool elastic = false, sticking = false; ///< the pins: as stiff as the contacts; also where friction acts
  bool damping_given = false;             ///< by the study: then not of `damping`
  TubeDamping damping;                    ///< on the pinned modes
  flow::Stability stability;
  std::vector<flow::ModeDirection> directions; ///< of its modes
  std::vector<double> sweep;                   ///< factors of all velocities
  std::optional<LawStability> law; ///< where the flow has a fluidelastic law, of several tubes with the first
};

} // namespace fretwork::results
