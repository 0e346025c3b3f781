// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A study as typed, checked values: what the study file says, before anything is read or computed. Groups
/// are still names. The contract with users is doc/study-file.md; keys, defaults and units are given there.
#pragma once
#include "contact/friction_law.hpp"
#include "contact/obstacle.hpp"
#include "contact/support_shapes.hpp"
#include "fem/model.hpp"
#include "mesh/read.hpp"
#include "modal/damping.hpp"
#include "signals/time_function.hpp"
#include "study/flow.hpp"
#include "study/turbulence.hpp"
#include "study/wear.hpp"
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::study {

using core::Vec3;

/// What a group of beams is made of at its far end.
struct Taper {
  std::string from; ///< the group's near end, a physical point
  std::string section;
  double added_mass; ///< kg/m
  fem::Fluid fluid;
  double axial_force = 0.0; ///< N
};

struct Beams {
  std::string group;
  std::string material;
  std::string section;
  std::optional<Vec3> orientation;
  double added_mass = 0.0; ///< kg/m, besides that of the fluid
  fem::Fluid fluid;
  fem::AddedMass added_mass_direction = fem::AddedMass::transverse;
  double axial_force = 0.0;   ///< N, tension > 0
  std::optional<Taper> taper; ///< the values above then are those of the near end
};

struct Restraint {
  std::string group;
  std::uint8_t fixed; ///< bit d set = dof d (ux uy uz rx ry rz) restrained
};

struct Mass {
  std::string group;
  double mass = 0.0;
  Vec3 inertia = Vec3::Zero();
  Vec3 arm = Vec3::Zero();
};

struct Spring {
  std::string group;
  std::optional<std::string> other;
  std::array<double, 6> stiffness{};
  std::array<double, 6> damping{};
};

/// Components of two nodes that stay equal.
struct Tie {
  std::string group, other;
  std::uint8_t tied; ///< bit d set = dof d (ux uy uz rx ry rz) tied
};

/// What stands in for the modes that are left out at the contacts: nothing, or static modes.
enum class StaticModes { none, added };

struct Modes {
  std::optional<int> count = 40; ///< exactly one of count, up_to_hz and accuracy has a value
  bool number_given = false;     ///< one of the three by the study; otherwise contacts at beams say how many
  std::optional<double> up_to_hz;
  std::optional<double> accuracy; ///< relative error of contact forces, > 0 and at most 0.1
  modal::Damping damping = 0.0;
  bool flow_damping = false; ///< instead: that of [[flow]], for every structure
  StaticModes static_modes = StaticModes::none;
  std::optional<bool> distributed; ///< solve one structure over all ranks; default: by size
};

/// Obstacles of one node, or between two (doc/contact.md).
enum class ObstacleKind {
  circle,
  plane_y,
  plane_z,
  stop_y,
  stop_z,
  circle_inside,
  profile,
  ellipse,
  drilled,
  broached,
  egg_crate,
  bars_y,
  bars_z
};
/// Circles: met in any direction, so that the local axes do not matter.
[[nodiscard]] bool is_round(ObstacleKind kind);
/// As in the study file.
[[nodiscard]] std::string name_of(ObstacleKind kind);

enum class NormalDamper { reference, hunt_crossley };

/// The normal damper by what an impact leaves of the speed.
struct Restitution {
  double value = 1.0;         ///< 0 < e <= 1
  std::optional<double> mass; ///< kg, of the reference's law; none: 1/(n.W n) of the modes at the contact
  double velocity = 0.0;      ///< m/s, > 0: at which Hunt and Crossley's law gives e
};

struct Contact {
  std::string name;
  std::string group;
  std::optional<std::string> other; ///< group of the second nodes
  ObstacleKind obstacle = ObstacleKind::circle;
  contact::Obstacle shape; ///< flat bodies without `side`: it follows from the places of the two nodes
  std::optional<double> tube_radius; ///< m, of the obstacles that have it; the shape is made with it
  std::optional<double> side;        ///< two nodes, planes: +1 or -1
  std::optional<double>
      pair_gap; ///< m, two nodes: their clearance at rest, from which the shape's distance follows
  std::optional<Vec3> axis;
  std::optional<Vec3> y_axis; ///< instead of angle
  double angle = 0.0;         ///< degrees
  std::optional<Vec3> origin;
  std::array<double, 2> offset{};
  bool series = true;                     ///< false: no time series of it is kept in the results
  bool active = true;                     ///< false: it does nothing, but may be named by [[stability]]
  std::vector<std::string> inactive;      ///< of a group of nodes: `name[2]` ..., those that are not active
  bool grounded = false;                  ///< with base motion the obstacle stays in space
  std::optional<std::string> carrier;     ///< group of the support motions that carry the obstacle
  double thickness = 0.0;                 ///< m, of the support along the tube
  int points = 1;                         ///< along the thickness, from edge to edge
  std::optional<double> normal_stiffness; ///< none: that of the tube's wall
  NormalDamper normal_damper = NormalDamper::reference;
  double normal_damping = 0.0;            ///< reference
  double normal_dissipation = 0.0;        ///< hunt_crossley
  std::optional<Restitution> restitution; ///< instead of either
  double tangential_stiffness = 0.0;
  std::optional<double> tangential_damping; ///< none: the automatic value
  double friction_static = 0.0;
  double friction_dynamic = 0.0;
  contact::FrictionMemoryKind memory = contact::FrictionMemoryKind::return_map;
  contact::Vec2 friction_along{1.0, 1.0}; ///< 1 where friction acts: along x_loc, across it
};

struct Load {
  std::string name; ///< for messages and --set; empty: none
  std::string group;
  bool per_length = false;
  bool moment = false;
  Vec3 direction; ///< unit
  signals::TimeFunction function;
};

struct BaseMotion {
  Vec3 direction; ///< unit
  signals::TimeFunction acceleration;
  std::optional<double> velocity0, displacement0; ///< m/s and m, at t = 0
};

/// A group that is moved: by its restraints, or by the ground of its springs.
struct SupportMotion {
  std::string group;
  Vec3 direction;                                 ///< unit
  bool by_displacement = false;                   ///< the time function gives m, otherwise m/s2
  signals::TimeFunction function;                 ///< a displacement is smooth: no random, no jump
  std::optional<double> velocity0, displacement0; ///< m/s and m, at t = 0, of an acceleration
};

struct Initial {
  std::string group;
  Vec3 displacement = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 rotation_rate = Vec3::Zero();
  Vec3 centre = Vec3::Zero();
};

enum class Scheme {
  automatic,
  splitting,
  collocation,
  euler,
  devogelaere,
  runge_kutta_54,
  energy_conserving
};
/// At rest where the structure was drawn; or at rest in equilibrium with the loads at t = 0 and the contacts.
enum class Start { rest, equilibrium };

struct Transient {
  double duration = 0.0;
  Start start = Start::rest;
  Scheme scheme = Scheme::automatic;
  double accuracy = 0.01;
  std::optional<double> step;
  double tolerance = 1e-6; ///< of a step's error: adaptive schemes
  bool verify = false;     ///< run again at half the step and compare the statistics
  double max_hours = 24.0; ///< on the clock: a run that would take longer is refused
};

struct Output {
  std::optional<double> every; ///< s; default duration / 5000
  bool modal = true;           ///< keep the series of the modes
  std::vector<std::string> nodes;
  std::vector<std::string> section_forces; ///< groups of beams whose section forces are followed
  std::vector<std::string> reactions;      ///< groups of restrained nodes
  double statistics_from = 0.0;
  std::int64_t impacts = 10000; ///< rows kept of the table of impacts of each contact; 0: no table
  double checkpoint = 60.0;     ///< s on the clock between checkpoints; 0: none. No result depends on it
  double rest_time = 0.0;       ///< s; an opening shorter than this belongs to the impact it interrupts
};

struct Study {
  std::filesystem::path file; ///< absolute; relative paths of the study start from its folder
  std::string text;           ///< as read, overrides written at the end as comments: kept in the results
  std::vector<std::string> overrides;
  bool varied = false; ///< by the [sweep] of its file, whose cases are computed by `fretwork sweep` alone
  std::string title;
  mesh::Source mesh; ///< its file is absolute
  std::map<std::string, fem::Material> materials;
  std::map<std::string, fem::Section> sections;
  std::vector<Beams> beams;
  std::vector<Restraint> restraints;
  std::vector<Mass> masses;
  std::vector<Spring> springs;
  std::vector<Tie> ties;
  Modes modes;
  std::vector<Contact> contacts;
  std::vector<Flow> flows;
  std::vector<Stability> stabilities;
  std::vector<Turbulence> turbulence;
  std::vector<Response> responses;
  std::vector<Load> loads;
  std::optional<Vec3> gravity; ///< m/s2
  std::vector<BaseMotion> base_motions;
  std::vector<SupportMotion> support_motions;
  std::vector<Initial> initial;
  std::optional<Transient> transient; ///< needed by `run` and `transient` only
  Output output;
  std::vector<Wear> wear;
  std::optional<GapOpening> gap_opening;
};

/// Read and check a study file and the files of its load tables; the mesh is not opened. `overrides` are the
/// `key=value` texts of `--set`, as document.hpp says.
/// @throws core::Error naming file, line (or the override), key, value and cure
[[nodiscard]] Study read(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The tables of the study that a stage depends on, as canonical TOML text (keys sorted, overrides applied,
/// 17 digits, load tables of files by their rows): what is hashed to tell whether the stage must be computed
/// again. The mesh appears by its file's name only, output.checkpoint not at all: no result depends on it.
/// @param tables  top-level keys, e.g. {"mesh"}; those that the study does not have are left out
/// @throws        core::Error if a file cannot be read or is not TOML, or an override has no valid address;
///                nothing else is checked
[[nodiscard]] std::string canonical_text(const std::filesystem::path& file,
                                         const std::vector<std::string>& overrides,
                                         const std::vector<std::string>& tables);

} // namespace fretwork::study
