// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All that a run leaves: plain data, gathered by the application, written by the other files of this folder.
#pragma once
#include "fem/beam_point.hpp"
#include "modal/basis.hpp"
#include "post/contact_statistics.hpp"
#include "post/force_statistics.hpp"
#include "post/impact_table.hpp"
#include "post/largest_impact.hpp"
#include "post/node_statistics.hpp"
#include "post/power_balance.hpp"
#include "post/recorder.hpp"
#include "post/verification.hpp"
#include "results/flow_results.hpp"
#include "results/response_results.hpp"
#include "results/wear_results.hpp"
#include "transient/step_choice.hpp"
#include "wear/kwu_epri.hpp"
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::results {

/// Where results come from: carried by every result file.
struct RunRecord {
  std::string version;
  std::string title;
  std::string study_text;                       ///< the study file, overrides appended as comments
  std::string input_sha256;                     ///< of the canonical study and of the files it reads
  std::vector<std::uint64_t> seeds;             ///< of the random loads
  std::map<std::string, std::string> libraries; ///< name -> version
  std::string vector_width;
  int ranks = 1;
  std::vector<std::string> overrides = {}; ///< key=value of --set, in their order
};

struct ModelFacts {
  std::int64_t nodes = 0, elements = 0, dofs = 0;
  std::int64_t different_structures =
      0; ///< structures that are no copy of another: their modes were computed
  double mass_kg = 0.0;
};

/// Along the normal direction of a contact in which the modes lack most, m/N.
struct StaticFlexibility {
  double exact = 0.0, basis = 0.0, missing = 0.0;
};

/// A contact as it was set up.
struct ContactFacts {
  std::string name;
  core::Index node = 0;             ///< of the model
  core::Index other = -1;           ///< the second node; -1: the obstacle is fixed
  fem::BeamPoint point;             ///< that meets the obstacle: the node, or a point of a beam near it
  Eigen::Matrix3d axes;             ///< rows x_loc y_loc z_loc
  std::string obstacle;             ///< as in the study file
  double gap = 0.0;                 ///< m
  std::vector<contact::Side> sides; ///< where the obstacle has several; for summary.json
  core::Vec3 rest;                  ///< m, node at rest from the obstacle's centre, local axes
  Eigen::MatrixXd outline; ///< m, n x 2: contact::outline_of, local y z; empty where the gap tells all
  double normal_stiffness = 0.0, normal_damping = 0.0, tangential_stiffness = 0.0, tangential_damping = 0.0;
  double normal_dissipation = 0.0; ///< s/m, Hunt and Crossley's
  double friction_static = 0.0, friction_dynamic = 0.0;
  std::array<double, 2> friction_along{1.0, 1.0};      ///< 1 where friction acts: along x_loc, across it
  std::optional<StaticFlexibility> static_flexibility; ///< none where there is no static solution
};

/// Where a run follows forces: a section at an end of a beam, or a restrained node.
struct ForceSite {
  std::string name; ///< the group; of a restraint with [i] where its group has several nodes
  core::Index node;
  core::Index beam = -1; ///< of a section; -1: a restraint
  bool at_b = false;     ///< the section is at the end b of the beam
  double s = 0.0;        ///< m, of a section: length of the group's beams from the start of their curve
  std::uint8_t fixed =
      0; ///< of a restraint, the dofs that it holds, or springs and dampers to the ground: bit d set = dof d
  [[nodiscard]] bool is_section() const { return beam >= 0; }
};

/// An imposed motion in figures, within the run.
struct MotionFacts {
  std::string name;
  double largest = 0.0, time = 0.0;          ///< m/s2, of the acceleration, and s, when
  double displacement = 0.0;                 ///< m, the largest from where it starts
  std::int64_t rows = 0;                     ///< of its table; 0: none
  double record_from = 0.0, record_to = 0.0; ///< s, of the table
};

/// How far modes reach for an accuracy of contact forces.
struct ModesLimit {
  double accuracy = 0.0;
  double up_to = 0.0;             ///< Hz
  std::string contact;            ///< that asks for most; empty: none is at a beam with mass
  double contact_frequency = 0.0; ///< Hz, of that contact on its beams
  std::string loads;              ///< what of the loads asks for more than contacts do; empty: nothing
};

/// One independent transient (a connected structure with its contacts).
struct TransientFacts {
  transient::StepChoice choice;
  transient::Report report;
  std::vector<std::size_t> structures = {}; ///< numbers in RunResults::bases
  post::PowerBalance power = {};            ///< of the window, under a fluidelastic law
};

/// The run against the same at half the step (half the tolerance).
struct Verification {
  double step_max = 0.0; ///< s, of the second run
  double factor = 0.0;   ///< of standard errors that agreeing figures of contacts may differ by
  std::vector<std::vector<post::ComparedFigure>> contacts; ///< as `contacts`
  std::vector<post::ComparedFigure> sums;                  ///< over all contacts
  std::string failure;                                     ///< why the second run did not end; empty: it did
};

struct Timings { ///< s
  double read = 0, mesh = 0, assembly = 0, modes = 0, basis = 0, transient = 0, output = 0, total = 0;
};

struct RunResults {
  RunRecord record;
  ModelFacts model;
  std::vector<core::Vec3> nodes;                 ///< m
  std::vector<std::array<core::Index, 2>> lines; ///< beams
  std::vector<fem::Beam> beams;                  ///< as `lines`; empty: not known what they are made of
  std::vector<fem::BeamProperty>
      properties; ///< of the beams, without masses of fluids and added masses; none is there twice
  std::map<std::string, std::vector<core::Index>> groups; ///< nodes of the named groups of the mesh
  std::vector<modal::Basis> bases;                        ///< by structure
  std::vector<double>
      closed_frequencies; ///< Hz, ascending, contacts on fixed obstacles closed; of `modes` only
  std::vector<TubeDamping> flow_damping;      ///< by tubes, where modes.damping = "flow"
  std::vector<StabilityAssessment> stability; ///< by assessments and tubes
  std::vector<LawAtWork> laws;                ///< of fluidelastic forces, of a run
  std::vector<LinearResponse> responses;      ///< to turbulence, on pinned modes
  std::vector<MotionFacts> motions;           ///< of the run
  std::optional<ModesLimit> modes_limit;      ///< where the study asks for an accuracy of them
  std::vector<ContactFacts> contacts;
  std::vector<post::ContactSummary> contact_summaries; ///< as `contacts`; empty without a transient
  post::StandardErrors errors_of_sums; ///< over all contacts: work_rate, friction_power, impact_rate
  std::vector<transient::StepError>
      step_errors; ///< as `contacts`, where replays measure them (transient/splitting/replays.hpp); else empty
  std::optional<Verification> verification;  ///< where the study asks for it
  double accuracy = 0.01;                    ///< what the run aims at
  std::vector<post::ContactImpacts> impacts; ///< as `contacts`; empty without a table
  double rest_time = 0.0;                    ///< s, of the table of impacts
  /// Forces about the largest impact at every step, as `contacts`; empty: not kept.
  std::vector<std::vector<post::ForcePoint>> largest_impacts;
  std::vector<std::vector<double>>
      sector_rates; ///< W, as `contacts`, by angular sector; no sector where nothing wears
  std::vector<std::optional<wear::KwuClasses>> force_speed_classes; ///< as `contacts`, under the law kwu_epri
  std::optional<Wear> wear; ///< where the study asks for it and the run has ended
  std::vector<std::string> node_names;
  std::vector<post::NodeSummary> node_summaries;
  std::vector<ForceSite> force_sites;              ///< sections, group after group, then restraints
  std::vector<post::ForceSummary> force_summaries; ///< as `force_sites`
  std::vector<TransientFacts> transients;          ///< by structure that was run
  double statistics_from = 0.0, duration = 0.0;    ///< s
  post::TimeSeries series; ///< of all structures; modal series stacked in the order of `bases`
  Timings timings;
  std::vector<std::string> warnings; ///< what makes the results doubtful
  std::vector<std::string> notes;    ///< what the user may want to know
};

} // namespace fretwork::results
