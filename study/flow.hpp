// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The flow along tubes, and what its stability is assessed with, as the study says it.
#pragma once
#include "flow/damping.hpp"
#include "flow/fluidelastic_law.hpp"
#include "flow/stability.hpp"
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::study {

/// The end of a zone that reaches to the end of its tube, whose length only the mesh knows.
inline constexpr double end_of_tube = std::numeric_limits<double>::infinity();

/// A support as damping meets it.
struct FlowSupport {
  std::string group;   ///< a physical point of the tube
  double length = 0.0; ///< m, along the tube
};

struct Flow {
  std::string name;
  std::vector<std::string> groups;                  ///< curves that make up the tube
  std::string from;                                 ///< a group with the end of the tube at s = 0
  std::vector<flow::Zone> zones;                    ///< those with a fluid; `to` may be end_of_tube
  std::vector<flow::Extent> dry;                    ///< those that are declared to have none; `to` likewise
  std::optional<std::vector<FlowSupport>> supports; ///< none: the contacts on the tube
  double structural_damping = 0.002;
  flow::DampingVoidFraction void_fraction = flow::DampingVoidFraction::of_the_zone;
  std::optional<flow::FluidelasticLaw> law =
      std::nullopt;     ///< of the forces that depend on the motion; none: there are none
  std::string law_name; ///< the flows of a law of several tubes are these tubes, in their order
};

/// What holds the tubes in the modes that stability is assessed with.
enum class Pinned {
  contacts, ///< all active contacts of one node
  none,
  named
};

struct Stability {
  std::string name;
  Pinned pinned = Pinned::contacts;
  std::vector<std::string> contacts; ///< of Pinned::named
  flow::Component component;
  std::vector<double> sweep = {0.5, 1.0, 1.5, 2.0}; ///< factors of all velocities, >= 0
  std::optional<double> strouhal = std::nullopt;    ///< of the bundle: vortex shedding is screened for
  std::optional<double> damping = std::nullopt;     ///< one ratio for all modes, instead of that of the flow
  bool elastic = false;                             ///< pins have the stiffness of their contacts
  bool sticking = false;                            ///< pins hold where friction acts too
  /// Of the stability diagram of flows with a law:
  std::array<double, 2> factors{0.0, 2.0}; ///< of all velocities, first and last, 0 <= first < last
  int points = 101;                        ///< evenly between them
  int modes = 10;                          ///< those of lowest frequency
};

} // namespace fretwork::study
