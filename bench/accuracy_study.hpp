// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Statistics of runs against those of the reference solution, scene by scene.
///
/// Impacts with friction are chaotic: members of an ensemble differ by steps of 2 % of the gap in the initial state of each structure and by
/// the seeds of random loads. A member is run by both; the error of a figure is the mean of the differences, its standard error their
/// scatter over the square root of their number. Members are added until all standard errors are below a quarter of the tolerance, or the budget is used up.
///
/// A figure (sum over the contacts of a scene) fails where |error| > tolerance of the reference value + 2 standard errors; the tolerance is
/// 2 % at accuracy 0.01, in proportion at others but never below 0.4 %; 0.1 % between two schemes. Left out:
///     work_rate        below 1e-3 of the mean of F_N |v_T|, stick and slip
///     friction_power   below 1e-3 of mu_d times that
///     impact_rate      with less than 5 impacts a member, or where contacts are closed for more than 99.9 % of the time
///     all              where no contact closes
#pragma once
#include "bench/random_scenes.hpp"
#include "bench/reference_contact.hpp"
#include "transient/step_rule.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::bench {

enum Figure : std::size_t {
  work_rate,
  friction_power,
  normal_rms,
  normal_mean,
  contact_time_ratio,
  impact_rate,
  normal_max,
  figure_count
};
inline constexpr std::array<const char*, figure_count> figure_names = {
    "work_rate",          "friction_power", "normal_rms", "normal_mean",
    "contact_time_ratio", "impact_rate",    "normal_max"};
inline constexpr std::size_t judged_figures = normal_max; ///< the largest force is informative

struct StudyOptions {
  transient::StepOptions step; ///< of the run under test
  double step_factor = 1.0;    ///< times its step
  double resolution = 0.02;    ///< w_c h of the reference solution
  double budget = 1.0;         ///< s of the reference, a scene, estimated: sets duration and members
  bool halved = false;         ///< test the reference solution against the one at half its step
  /// The reference is this scheme, with the same factor and tolerance; the reference solution only says which figures count.
  std::optional<transient::SchemeKind> against;
  double tolerance() const { return against ? 0.001 : std::max(2.0 * step.accuracy, 0.004); } ///< relative
};

struct FigureError {
  Figure figure;
  double ours, reference, standard_error; ///< means; standard error of their difference
  bool judged, fails;
  double measured = 0.0,
         measured_spread = 0.0; ///< relative error by the step as the runs measure it, its standard error
  [[nodiscard]] double relative() const { return (ours - reference) / reference; }
};

struct SceneResult {
  RandomScene scene;
  double duration = 0.0; ///< s, a member
  int members = 0;
  double step = 0.0, resolution = 0.0;           ///< s, w_c h of the run under test
  std::string scheme, failure;                   ///< failure: why there are no figures
  double seconds = 0.0, reference_seconds = 0.0; ///< of processor time, all members
  double closed = 0.0, sliding = 0.0;            ///< mean share of the time; of the closed time that slides
  std::int64_t unresolved = 0;     ///< contact forces and closures that the reference solution has not found
  transient::StepError step_error; ///< sums over contacts and members, squares of standard errors
  std::vector<FigureError> figures;
};

[[nodiscard]] SceneResult study(RandomScene scene, const StudyOptions& options);

/// One line for each figure that fails, or for all.
void print_figures(const SceneResult& result, bool all);
/// Shares within tolerance, errors and times, for each figure and kind of scene.
void print_summary(const std::vector<SceneResult>& results, const StudyOptions& options);
/// One row a figure. @throws core::Error where the file cannot be written
void write_csv(const std::string& file, const std::vector<SceneResult>& results);

/// Single impacts (impact_bench.cpp).
void print_impacts(const StudyOptions& options, std::optional<double> tangential_ratio);

} // namespace fretwork::bench
