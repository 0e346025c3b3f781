// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `[[wear]]` as typed, checked values: which contacts wear, by which law, in which geometry, over which operating states.
#pragma once
#include "wear/depth.hpp"
#include "wear/kwu_epri.hpp"
#include "wear/laws.hpp"
#include "wear/life.hpp"
#include "wear/sectors.hpp"
#include "wear/work_rate.hpp"
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::study {

/// That of the contact's own obstacle, or a named one.
enum class WearGeometry { obstacle, flat_bar, drilled_hole, lands, ring, tube_on_tube, sectors };
/// As in the study file.
[[nodiscard]] std::string name_of(WearGeometry geometry);

/// Work rates of an operating state: of this run, of the results of another one, or given.
struct WearState {
  std::string name;
  double share = 1.0;                            ///< of the time; those of an entry sum to 1
  std::optional<std::filesystem::path> results;  ///< folder of another run, absolute
  std::optional<fretwork::wear::WorkRate> given; ///< of each support
};

struct Wear {
  std::string path;                  ///< of the entry, for messages: `wear.0`
  std::string name;                  ///< of the support where all contacts are one; else empty
  std::vector<std::string> contacts; ///< names and patterns; empty: all that no other entry names
  bool one_support = false;          ///< all these contacts wear one scar
  fretwork::wear::Law law; ///< of the tube; its coefficient is to be found where `materials` is given
  std::optional<std::string> materials, coefficient_class;
  double support_coefficient = 0.0; ///< K of the support, m2/N
  fretwork::wear::KwuConstants kwu{0.0, 0.0};
  fretwork::wear::KwuMaxima kwu_maxima; ///< N, m/s; 0: another law
  WearGeometry geometry = WearGeometry::obstacle;
  fretwork::wear::Form form = fretwork::wear::Form::exact;
  std::optional<double> tube_radius, wall; ///< m; none: of the beam at the contact
  std::optional<double> length;     ///< m, of the support along the tube; none: the contact's thickness
  std::optional<double> clearance;  ///< m, radial; none: the contact's gap
  std::optional<double> half_angle; ///< rad, of a land
  int lands = 4;                    ///< of geometry lands
  double inclination = 0.0;         ///< rad
  double limit = fretwork::wear::default_limit;  ///< of the wall
  std::optional<double> support_limit;           ///< m
  double initial_wear = 0.0;                     ///< of the wall, lost before the study begins
  std::map<std::string, double> initial_wear_of; ///< likewise, by sides
  double years = 40.0;
  std::optional<double> confidence; ///< of the interval of a work rate; none: +- its standard error
  int sectors = 36;                 ///< of the work by angle
  std::vector<WearState> states{{"this run", 1.0, {}, {}}};
};

/// `[gap_opening]`: the run is repeated at the gaps that wear has opened.
struct GapOpening {
  std::int64_t stages = 20; ///< runs at most, the first one included
  double years = 40.0;      ///< that are followed at most
  double gap_share = 0.1, wall_share = 0.05,
         least_wall_share = 0.005; ///< of wear::AdvanceOptions
};

} // namespace fretwork::study
